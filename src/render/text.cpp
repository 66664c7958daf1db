#include "mspskel/render/text.h"

#include "font.h"

namespace mspskel {
namespace {

constexpr int kAdvance = 6, kRows = 9, kColumns = 5;  // font pixels

const render_detail::Glyph& glyph(char c) {
  const int code = static_cast<unsigned char>(c);
  return render_detail::kFont[(code >= 32 && code < 127 ? code : '?') - 32];
}

void fill_square(Image& image, int x, int y, int side, Color color) {
  for (int v = y; v < y + side; ++v) {
    for (int u = x; u < x + side; ++u) {
      if (u >= 0 && u < image.width && v >= 0 && v < image.height) image.set(u, v, color);
    }
  }
}

}  // namespace

int text_length(const std::string& text, int scale) {
  return text.empty() ? 0 : scale * (kAdvance * static_cast<int>(text.size()) - (kAdvance - kColumns));
}

void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style) {
  const int length = text_length(text, style.scale);
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        if ((glyph(text[i])[static_cast<std::size_t>(row)] >> (kColumns - 1 - column) & 1) == 0) continue;
        const int along = style.scale * (kAdvance * static_cast<int>(i) + column), across = style.scale * row;
        if (style.upwards) {
          fill_square(image, x + across, y + length - style.scale - along, style.scale, style.color);
        } else {
          fill_square(image, x + along, y + across, style.scale, style.color);
        }
      }
    }
  }
}

}  // namespace mspskel
