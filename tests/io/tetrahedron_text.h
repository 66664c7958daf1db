// What the reader tests share: one tetrahedron, and text to turn into its variants.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include "mspskel/base/error.h"
#include "mspskel/io/read_mesh.h"

namespace mspskel::test {

inline void check_tetrahedron(const PolygonSoup& soup) {
  REQUIRE(soup.points.size() == 4);
  CHECK(soup.points[0] == Vector3(0, 0, 0));
  CHECK(soup.points[1] == Vector3(1, 0, 0));
  CHECK(soup.points[2] == Vector3(0, 1, 0));
  CHECK(soup.points[3] == Vector3(0, 0, 1));
  CHECK(soup.begin == std::vector<Index>{0, 3, 6, 9, 12});
  CHECK(soup.corners == std::vector<Index>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
}

inline std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// The file must be refused with a message that names `where` (a line or byte) and says `what`.
inline void check_refused(MeshFormat format, const std::string& text, const std::string& where,
                          const std::string& what) {
  INFO(text);
  CHECK_THROWS_AS(read_polygon_soup(std::string_view(text), format), ReadError);
  CHECK_THROWS_WITH(read_polygon_soup(std::string_view(text), format),
                    Catch::Contains(where) && Catch::Contains(what));
}

// Bytes of the file are changed, repeated or dropped at random: it is read with indices in range, or refused.
inline void check_edits(MeshFormat format, const std::string& file, int edits = 500) {
  std::mt19937 random(1);
  for (int i = 0; i < edits; ++i) {
    std::string text = file;
    for (std::uint32_t k = 0; k <= random() % 4; ++k) {
      const std::size_t at = random() % text.size();
      if (random() % 4 == 0)
        text.erase(at, random() % 8);
      else if (random() % 4 == 0)
        text.insert(at, text, random() % text.size(), random() % 16);
      else
        text[at] = static_cast<char>(random() % 3 == 0 ? random() % 256 : text[random() % text.size()]);
    }
    try {
      const PolygonSoup soup = read_polygon_soup(std::string_view(text), format);
      for (const Index v : soup.corners) REQUIRE((v >= 0 && v < static_cast<Index>(soup.points.size())));
      REQUIRE(soup.begin.back() == static_cast<Index>(soup.corners.size()));
    } catch (const ReadError&) {
    }
  }
}

// Appends numbers in a chosen byte order.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    const std::uint16_t probe = 1;
    char first;
    std::memcpy(&first, &probe, 1);
    const bool machine_is_big = first == 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      text += raw[machine_is_big == big_endian_ ? i : sizeof(T) - 1 - i];
    return *this;
  }
  std::string text;

 private:
  bool big_endian_;
};

}  // namespace mspskel::test
