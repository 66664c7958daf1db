// Finer meshes of the same surface, to see how cost grows.
#pragma once

#include <array>
#include <map>
#include <utility>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::bench {

// Every triangle in four, by its edges' midpoints: the same surface, the same normals. Points keep their
// numbers; midpoints follow in the order in which the triangles meet their edges. Polygons of another size
// are not expected. Cost: O(faces · log faces).
inline PolygonSoup subdivided(const PolygonSoup& soup) {
  PolygonSoup fine;
  fine.points = soup.points;
  fine.begin.reserve(4 * soup.polygon_count() + 1);
  fine.corners.reserve(4 * soup.corners.size());
  std::map<std::pair<Index, Index>, Index> midpoint;
  const auto between = [&](Index a, Index b) {
    const auto [entry, added] =
        midpoint.try_emplace(std::minmax(a, b), static_cast<Index>(fine.points.size()));
    if (added) fine.points.push_back(0.5 * (soup.points[a] + soup.points[b]));
    return entry->second;
  };
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index* corner = &soup.corners[soup.begin[f]];
    std::array<Index, 3> middle{};
    for (int k = 0; k < 3; ++k) middle[k] = between(corner[k], corner[(k + 1) % 3]);
    for (int k = 0; k < 3; ++k) fine.add_triangle(corner[k], middle[k], middle[(k + 2) % 3]);
    fine.add_triangle(middle[0], middle[1], middle[2]);
  }
  return fine;
}

}  // namespace mspskel::bench
