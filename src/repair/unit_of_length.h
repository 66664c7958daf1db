// A unit of length in which volumes, and their squares, are numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// The unit's power of two: 0, so that nothing changes, for all usual models.
inline int exponent_of_unit(const PolygonSoup& soup) {
  constexpr int kMost = 100;
  double largest = 0;
  for (const Index v : soup.corners)
    if (v >= 0 && v < static_cast<Index>(soup.points.size()) && soup.points[v].allFinite())
      largest = std::max(largest, soup.points[v].cwiseAbs().maxCoeff());
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  return std::abs(exponent) > kMost ? exponent : 0;
}

// Whether scale_points can be undone.
inline bool scales_exactly(const PolygonSoup& soup, int exponent) {
  return std::all_of(soup.points.begin(), soup.points.end(), [&](const Vector3& p) {
    return std::all_of(p.begin(), p.end(),
                       [&](double x) { return std::scalbn(std::scalbn(x, exponent), -exponent) == x; });
  });
}

inline void scale_points(PolygonSoup& soup, int exponent) {
  for (Vector3& p : soup.points)
    for (double& x : p) x = std::scalbn(x, exponent);
}

}  // namespace mspskel::detail
