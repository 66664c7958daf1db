// Contact sheets.
#pragma once

#include <string>
#include <vector>

#include "mspskel/render/image.h"

namespace mspskel {

struct TileOptions {
  int columns = 3;     // at least 1
  int gap = 8;         // pixels between and round the cells, 0 to 1000
  int text_scale = 2;  // of the labels, 1 to 16
  Color background = kWhite;
};

// Images in rows of `columns` cells, each as large as the largest image, centred, its label above (cut to the
// cell). labels: one per image, or none at all. Throws UsageError if options or labels do not fit or there is
// no image.
Image tile(const std::vector<Image>& images, const std::vector<std::string>& labels,
           const TileOptions& options = {});

}  // namespace mspskel
