// STL: triangles by coordinates, as text or as 50-byte records. Equal coordinates become one point.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "byte_reader.h"
#include "mesh_parsers.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

constexpr std::size_t kHeaderSize = 80, kRecordSize = 50;

// Numbers points in order of first appearance; open addressing over the bits of the coordinates.
class PointWelder {
 public:
  explicit PointWelder(std::vector<Vector3>& points) : points_(points), slots_(64, kNone) {}

  Index index_of(Vector3 p) {
    p += Vector3::Zero();  // -0 + 0 is 0
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    const std::size_t slot = find_slot(p);
    if (slots_[slot] == kNone) {
      slots_[slot] = static_cast<Index>(points_.size());
      points_.push_back(p);
    }
    return slots_[slot];
  }

 private:
  static std::uint64_t hash(const Vector3& p) {
    std::uint64_t bits[3], h = 0;
    std::memcpy(bits, p.data(), sizeof bits);
    for (const std::uint64_t b : bits) {
      h = (h ^ b) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return h;
  }
  std::size_t find_slot(const Vector3& p) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash(p)) & mask;
    while (slots_[slot] != kNone && points_[slots_[slot]] != p) slot = (slot + 1) & mask;
    return slot;
  }
  void grow() {
    slots_.assign(4 * slots_.size(), kNone);
    for (std::size_t i = 0; i < points_.size(); ++i) slots_[find_slot(points_[i])] = static_cast<Index>(i);
  }

  std::vector<Vector3>& points_;
  std::vector<Index> slots_;  // a power of two
};

// Adds the polygon of the corners without repeats of neighbours, if that leaves three.
void add_polygon(PolygonSoup& soup, std::vector<Index>& polygon) {
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  if (polygon.size() < 3) return;
  soup.corners.insert(soup.corners.end(), polygon.begin(), polygon.end());
  soup.begin.push_back(static_cast<Index>(soup.corners.size()));
}

class StlText {
 public:
  explicit StlText(std::string_view bytes) : scan_(bytes, Syntax::kPlain), weld_(soup_.points) {}

  PolygonSoup read() {
    bool any = false;
    while (scan_.skip_blank()) {
      expect("solid");
      scan_.skip_line();
      read_solid();
      any = true;
    }
    if (!any) scan_.fail_expected("'solid'");
    return std::move(soup_);
  }

 private:
  std::string_view next() {
    if (!scan_.skip_blank()) scan_.fail(scan_.position(), "the file ends before 'endsolid'");
    return scan_.word();
  }
  void expect(std::string_view keyword) {
    const std::string_view word = next();
    if (equals_ignoring_case(word, keyword)) return;
    scan_.fail(word.data(), "expected '" + std::string(keyword) + "', found " + scan_.quoted(word.data()));
  }

  void read_solid() {
    for (;;) {
      const std::string_view word = next();
      if (equals_ignoring_case(word, "endsolid")) return scan_.skip_line();
      if (!equals_ignoring_case(word, "facet"))
        scan_.fail(word.data(), "expected 'facet' or 'endsolid', found " + scan_.quoted(word.data()));
      scan_.skip_line();  // its normal follows from the corners
      read_facet();
    }
  }
  void read_facet() {
    expect("outer");
    expect("loop");
    polygon_.clear();
    std::string_view word = next();
    for (; equals_ignoring_case(word, "vertex"); word = next()) {
      Vector3 p;
      for (int k = 0; k < 3; ++k) p[k] = scan_.coordinate("a coordinate");
      polygon_.push_back(weld_.index_of(p));
    }
    if (!equals_ignoring_case(word, "endloop"))
      scan_.fail(word.data(), "expected 'vertex' or 'endloop', found " + scan_.quoted(word.data()));
    if (polygon_.size() < 3)
      scan_.fail(word.data(), "a facet has " + std::to_string(polygon_.size()) + " corners");
    expect("endfacet");
    if (soup_.corners.size() + polygon_.size() > kMostElements)
      scan_.fail(word.data(), "there are too many corners");
    add_polygon(soup_, polygon_);
  }

  TextScanner scan_;
  PolygonSoup soup_;
  PointWelder weld_;
  std::vector<Index> polygon_;
};

PolygonSoup parse_binary(std::string_view bytes) {
  ByteReader reader(bytes, 0, ByteOrder::kLittle);
  reader.skip(kHeaderSize, "the header");
  const std::uint64_t count = reader.read<std::uint32_t>("the number of triangles");
  if (count > reader.bytes_left() / kRecordSize)
    reader.fail("the header announces " + std::to_string(count) + " triangles, but only " +
                std::to_string(reader.bytes_left() / kRecordSize) + " follow");
  if (3 * count > kMostElements) reader.fail("there are too many triangles");
  PolygonSoup soup;
  soup.begin.reserve(count + 1);
  soup.corners.reserve(3 * count);
  PointWelder weld(soup.points);
  std::vector<Index> corners;
  for (std::uint64_t f = 0; f < count; ++f) {
    reader.skip(12, "a triangle");  // its normal follows from the corners
    corners.clear();
    for (int i = 0; i < 3; ++i) {
      Vector3 p;
      for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(reader.read<float>("a triangle"));
      if (!p.allFinite())
        reader.fail("a coordinate of the corner before is not finite (triangle " + std::to_string(f) + ")");
      corners.push_back(weld.index_of(p));
    }
    reader.skip(2, "a triangle");
    add_polygon(soup, corners);
  }
  return soup;
}

// A size that fits the record count exactly is binary, even after "solid", with which many binary headers
// start.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize + 4) {
    const auto count = ByteReader(bytes, kHeaderSize, ByteOrder::kLittle).peek<std::uint32_t>(0);
    if (bytes.size() == kHeaderSize + 4 + kRecordSize * std::uint64_t{count}) return false;
  }
  const std::size_t start = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string_view::npos || !starts_ignoring_case(bytes.substr(start), "solid"))
    return bytes.size() < kHeaderSize + 4;
  return bytes.substr(0, 512).find('\0') == std::string_view::npos;
}

}  // namespace

PolygonSoup parse_stl(std::string_view bytes) {
  return is_text(bytes) ? StlText(bytes).read() : parse_binary(bytes);
}

}  // namespace mspskel::detail
