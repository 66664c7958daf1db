#include "mspskel/render/image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mspskel/base/error.h"

namespace mspskel {

namespace {
std::size_t offset(const Image& image, int x, int y) {
  return 3 *
         (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}
std::uint8_t mix(std::uint8_t under, std::uint8_t over, double share) {
  return static_cast<std::uint8_t>(std::lround(under + share * (over - under)));
}
}  // namespace

Image::Image(int image_width, int image_height, Color fill) : width(image_width), height(image_height) {
  constexpr int kMaxSide = 32768;
  constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide ||
      std::int64_t{width} * std::int64_t{height} > kMaxPixels) {
    throw UsageError("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels is out of range");
  }
  pixels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    pixels[i] = fill.red;
    pixels[i + 1] = fill.green;
    pixels[i + 2] = fill.blue;
  }
}

Color Image::at(int x, int y) const {
  const std::size_t i = offset(*this, x, y);
  return {pixels[i], pixels[i + 1], pixels[i + 2]};
}

void Image::set(int x, int y, Color color) {
  const std::size_t i = offset(*this, x, y);
  pixels[i] = color.red;
  pixels[i + 1] = color.green;
  pixels[i + 2] = color.blue;
}

Color blend(Color under, Color over, double share) {
  share = std::clamp(share, 0.0, 1.0);
  return {mix(under.red, over.red, share), mix(under.green, over.green, share),
          mix(under.blue, over.blue, share)};
}

std::string encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      image.pixels.size() !=
          3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw UsageError("encode_png: the image is empty or its pixels do not fit its size");
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  const int done =
      png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
  const std::string message = header.message;
  png_image_free(&header);
  if (done == 0) throw WriteError("cannot encode a PNG image: " + message);
  bytes.resize(size);
  return bytes;
}

Color blue_to_red(double value) {
  if (std::isnan(value)) return {128, 128, 128};
  static constexpr std::array<Color, 5> kStops{
      {{30, 40, 200}, {20, 170, 220}, {40, 180, 60}, {250, 215, 40}, {215, 25, 30}}};
  const double t = std::clamp(value, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(t), kStops.size() - 2);
  return blend(kStops[i], kStops[i + 1], t - static_cast<double>(i));
}

}  // namespace mspskel
