// A picture in memory and its PNG bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mspskel {

struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;

  friend bool operator==(Color a, Color b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
  }
  friend bool operator!=(Color a, Color b) { return !(a == b); }
};
inline constexpr Color kWhite{255, 255, 255};
inline constexpr Color kBlack{0, 0, 0};

// Rows from top to bottom, pixels from left to right, three bytes a pixel: red, green, blue (sRGB).
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  Image() = default;
  // Throws UsageError unless both sides are 1 to 32768 pixels and the whole is at most 2^28 pixels.
  Image(int image_width, int image_height, Color fill = kWhite);

  // Precondition: 0 <= x < width, 0 <= y < height.
  Color at(int x, int y) const;
  void set(int x, int y, Color color);
};

// `over` on top of `under`; share is the opacity of `over`, 0 to 1.
Color blend(Color under, Color over, double share);

// The image as a PNG file (8 bits, RGB). Same pixels give the same bytes.
// Throws UsageError for an empty image, WriteError if libpng fails.
std::string encode_png(const Image& image);

// Blue (0) over cyan, green and yellow to red (1): the thesis's colouring of MSP and slice error
// (figures 3.2, 3.5). Values outside [0, 1] are clamped; one that is not a number is grey.
Color blue_to_red(double value);

}  // namespace mspskel
