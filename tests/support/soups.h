// Small shapes as soups, which need not be closed or connected.
#pragma once

#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/samples/shapes.h"

namespace mspskel {
namespace test {

// A box with its sides along the axes, of twelve triangles turned outward.
inline PolygonSoup box(const Vector3& low, const Vector3& high) {
  PolygonSoup soup;
  for (int k = 0; k < 8; ++k)
    soup.points.emplace_back((k & 1 ? high : low)[0], (k & 2 ? high : low)[1], (k & 4 ? high : low)[2]);
  constexpr Index kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& [a, b, c] : kFaces) soup.add_triangle(a, b, c);
  return soup;
}

inline PolygonSoup together(const std::vector<PolygonSoup>& soups) {
  PolygonSoup all;
  for (const PolygonSoup& soup : soups) append(all, soup);
  return all;
}

}  // namespace test
}  // namespace mspskel
