// PNG bytes read back by libpng, contact sheets, text and charts.
#include "mspskel/render/image.h"

#include <png.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mspskel/base/error.h"
#include "mspskel/render/chart.h"
#include "mspskel/render/text.h"
#include "mspskel/render/tile.h"

using namespace mspskel;

namespace {

Image decode(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0);
  CHECK(header.format == PNG_FORMAT_RGB);
  header.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  REQUIRE(png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) != 0);
  return image;
}

int count(const Image& image, Color color) {
  int sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y) == color ? 1 : 0;
  }
  return sum;
}

}  // namespace

TEST_CASE("a PNG decodes to the same pixels") {
  Image image(37, 23);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.set(x, y,
                {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(11 * y),
                 static_cast<std::uint8_t>(x * y)});
    }
  }
  const Image back = decode(encode_png(image));
  CHECK(back.width == 37);
  CHECK(back.height == 23);
  CHECK(back.pixels == image.pixels);
  CHECK(encode_png(image) == encode_png(image));
}

TEST_CASE("images without pixels are refused") {
  CHECK_THROWS_AS(encode_png(Image{}), UsageError);
  CHECK_THROWS_AS(Image(0, 5), UsageError);
  CHECK_THROWS_AS(Image(5, -1), UsageError);
  CHECK_THROWS_AS(Image(32768, 32768), UsageError);
  Image torn(4, 4);
  torn.pixels.pop_back();
  CHECK_THROWS_AS(encode_png(torn), UsageError);
}

TEST_CASE("every glyph but the space is drawn inside its box, and no two look alike") {
  std::vector<std::vector<std::uint8_t>> seen;
  for (char c = 33; c < 127; ++c) {
    Image image(7, 11);
    draw_text(image, 1, 1, std::string(1, c), {1, kBlack, false});
    CHECK(count(image, kBlack) > 0);
    Image inner(5, 9);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 5; ++x) inner.set(x, y, image.at(x + 1, y + 1));
    }
    CHECK(count(inner, kBlack) == count(image, kBlack));
    CHECK(std::find(seen.begin(), seen.end(), image.pixels) == seen.end());
    seen.push_back(image.pixels);
  }
}

TEST_CASE("text that runs upwards is the same text turned, and what is off the image is left out") {
  const std::string text = "Slice 7";
  const int length = text_length(text, 2);
  CHECK(length == 2 * (6 * 7 - 1));
  Image level(length, 18), upright(18, length);
  draw_text(level, 0, 0, text, {2, kBlack, false});
  draw_text(upright, 0, 0, text, {2, kBlack, true});
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < length; ++x) CHECK((level.at(x, y) == upright.at(y, length - 1 - x)));
  }
  CHECK_NOTHROW(draw_text(level, -50, -5, text));
  CHECK(text_length("", 3) == 0);
}

TEST_CASE("a contact sheet holds every image and its label") {
  const Color a{200, 0, 0}, b{0, 200, 0}, c{0, 0, 200};
  const std::vector<Image> images{Image(40, 30, a), Image(20, 30, b), Image(40, 10, c)};
  TileOptions options;
  options.columns = 2;
  const Image sheet = tile(images, {"one", "a label far too long for its cell", ""}, options);
  CHECK(sheet.width == 8 + 2 * 48);
  CHECK(count(sheet, a) == 1200);
  CHECK(count(sheet, b) == 600);
  CHECK(count(sheet, c) == 400);
  CHECK(count(sheet, kBlack) > 20);
  CHECK(tile(images, {}).width == 8 + 3 * 48);
  CHECK_THROWS_AS(tile({}, {}), UsageError);
  CHECK_THROWS_AS(tile(images, {"one"}), UsageError);
  options.columns = 0;
  CHECK_THROWS_AS(tile(images, {}, options), UsageError);
}

TEST_CASE("a chart draws its series within its axes") {
  ChartSeries line, dots;
  line.name = "refined";
  line.color = {200, 0, 0};
  for (int i = 0; i < 50; ++i) line.y.push_back(std::sin(0.2 * i));
  line.y[20] = std::numeric_limits<double>::quiet_NaN();
  dots.scatter = true;
  dots.color = {0, 0, 200};
  dots.x = {0, 10, 49};
  dots.y = {0.5, -0.5, 1};
  ChartOptions options;
  options.title = "MSP of horse";
  options.x_label = "vertex";
  options.y_label = "perimeter";
  const Image image = chart({line, dots}, options);
  CHECK(count(image, line.color) > 300);
  CHECK(count(image, dots.color) > 15);
  CHECK_NOTHROW(chart({}));
  ChartSeries flat;
  flat.y = {3, 3, 3};
  ChartOptions wide;
  wide.line_width = 4;
  CHECK(count(chart({flat}, wide), flat.color) > 300);
  dots.x.pop_back();
  CHECK_THROWS_AS(chart({dots}), UsageError);
  options.line_width = 0;
  CHECK_THROWS_AS(chart({line}, options), UsageError);
}

TEST_CASE("the colour scale runs from blue to red") {
  CHECK(blue_to_red(0).blue > 150);
  CHECK(blue_to_red(0).red < 60);
  CHECK(blue_to_red(1).red > 150);
  CHECK(blue_to_red(1).blue < 60);
  CHECK((blue_to_red(-5) == blue_to_red(0)));
  CHECK((blue_to_red(7) == blue_to_red(1)));
  const Color none = blue_to_red(std::numeric_limits<double>::quiet_NaN());
  CHECK(none.red == none.blue);
}
