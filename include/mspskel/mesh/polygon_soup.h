// Polygons that share points by index: what a mesh file holds before anyone knows whether it is a surface.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

struct PolygonSoup {
  std::vector<Vector3> points;
  // Polygon f has the corners corners[begin[f]] .. corners[begin[f + 1] - 1], each an index into points.
  std::vector<Index> begin{0};
  std::vector<Index> corners;
  std::vector<std::string> warnings;  // what the reader of the file left out

  std::size_t polygon_count() const { return begin.size() - 1; }
  void add_triangle(Index a, Index b, Index c) {
    corners.insert(corners.end(), {a, b, c});
    begin.push_back(static_cast<Index>(corners.size()));
  }
};

}  // namespace mspskel
