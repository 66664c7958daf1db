#pragma once

#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

struct Triangulation {
  std::vector<Index> corners;              // three a triangle
  std::vector<Index> polygon_of_triangle;  // empty if every polygon is a triangle
  Index cut_polygons = 0;

  Index count() const { return static_cast<Index>(corners.size() / 3); }
  Index polygon(Index triangle) const {
    return polygon_of_triangle.empty() ? triangle : polygon_of_triangle[triangle];
  }
};

// Precondition: every polygon has at least three corners, all different and in range.
Triangulation triangulate(const PolygonSoup& soup);

}  // namespace mspskel::detail
