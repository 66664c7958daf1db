#include "mspskel/render/tile.h"

#include <algorithm>

#include "mspskel/base/error.h"
#include "mspskel/render/text.h"

namespace mspskel {
namespace {

void copy_into(Image& sheet, const Image& image, int left, int top) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sheet.set(left + x, top + y, image.at(x, y));
  }
}

void validate_tiles(const std::vector<Image>& images, const std::vector<std::string>& labels,
                    const TileOptions& options) {
  if (options.columns < 1) throw UsageError("tile option columns must be at least 1");
  if (options.gap < 0 || options.gap > 1000) throw UsageError("tile option gap must be 0 to 1000");
  if (options.text_scale < 1 || options.text_scale > 16)
    throw UsageError("tile option text_scale must be 1 to 16");
  if (images.empty()) throw UsageError("tile: there is no image");
  if (!labels.empty() && labels.size() != images.size()) {
    throw UsageError("tile: " + std::to_string(labels.size()) + " labels for " +
                     std::to_string(images.size()) + " images");
  }
}

}  // namespace

Image tile(const std::vector<Image>& images, const std::vector<std::string>& labels,
           const TileOptions& options) {
  validate_tiles(images, labels, options);
  int width = 1, height = 1;
  for (const Image& image : images) {
    width = std::max(width, image.width);
    height = std::max(height, image.height);
  }
  const int count = static_cast<int>(images.size());
  const int columns = std::min(options.columns, count), rows = (count + columns - 1) / columns;
  const int label_height = labels.empty() ? 0 : 12 * options.text_scale;
  const int cell_width = width + options.gap, cell_height = height + label_height + options.gap;
  Image sheet(options.gap + columns * cell_width, options.gap + rows * cell_height, options.background);
  for (int i = 0; i < count; ++i) {
    const int left = options.gap + i % columns * cell_width, top = options.gap + i / columns * cell_height;
    if (!labels.empty()) {
      const auto fits = static_cast<std::size_t>((width / options.text_scale + 1) / 6);
      const std::string label = labels[i].substr(0, fits);
      const int indent = (width - text_length(label, options.text_scale)) / 2;
      draw_text(sheet, left + indent, top + 2 * options.text_scale, label,
                {options.text_scale, kBlack, false});
    }
    copy_into(sheet, images[i], left + (width - images[i].width) / 2,
              top + label_height + (height - images[i].height) / 2);
  }
  return sheet;
}

}  // namespace mspskel
