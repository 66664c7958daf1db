// Text in pictures with a bitmap font of our own: printable ASCII, 5 x 7 pixels a glyph and two
// rows for what hangs below the baseline.
#pragma once

#include <string>

#include "mspskel/render/image.h"

namespace mspskel {

struct TextStyle {
  int scale = 2;  // pixels a font pixel, 1 to 16
  Color color = kBlack;
  bool upwards = false;  // turned by a quarter, running from bottom to top
};

// Pixels along the text, without the gap after the last glyph; 9 * scale across. Other bytes count as '?'.
int text_length(const std::string& text, int scale);

// Draws text whose box has its top left corner at (x, y); pixels outside the image are left out.
void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style = {});

}  // namespace mspskel
