// One parser a format, each in its own file. All of them throw ReadError without the path.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

PolygonSoup parse_off(std::string_view bytes);
PolygonSoup parse_obj(std::string_view bytes);
PolygonSoup parse_ply(std::string_view bytes);
PolygonSoup parse_stl(std::string_view bytes);
PolygonSoup parse_vtk(std::string_view bytes);
PolygonSoup parse_vtp(std::string_view bytes);
// `folder`: where the files are that it names; null: they are refused.
PolygonSoup parse_gltf(std::string_view bytes, const std::string* folder);
PolygonSoup parse_3mf(std::string_view bytes);

// What a PLY file holds of a skeleton; nothing of it is checked but that the numbers are finite.
struct PlyGraph {
  std::vector<Vector3> points;
  std::vector<double> radius;  // one a point, or empty
  std::vector<std::array<std::int64_t, 2>> edges;
};
PlyGraph parse_ply_graph(std::string_view bytes);

// Points, polygons and corners are counted in Index.
inline constexpr std::uint64_t kMostElements = std::numeric_limits<Index>::max();

inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// `keyword` is in lower case.
inline bool equals_ignoring_case(std::string_view text, std::string_view keyword) {
  if (text.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (lower(text[i]) != keyword[i]) return false;
  return true;
}
inline bool starts_ignoring_case(std::string_view text, std::string_view keyword) {
  return equals_ignoring_case(text.substr(0, keyword.size()), keyword);
}

}  // namespace mspskel::detail
