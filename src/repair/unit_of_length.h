// A unit of length in which volumes, and their squares, are numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

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

// Whether points of a model near one stay where they are when they are scaled. At the least numbers that
// there are, places a little apart become the same; at the greatest, what lies outside of all becomes no
// number.
inline bool survives_scaling(const PolygonSoup& near_one, int exponent) {
  constexpr double kLeastLength = 1e-18;
  return std::all_of(near_one.points.begin(), near_one.points.end(), [&](const Vector3& p) {
    return std::all_of(p.begin(), p.end(), [&](double x) {
      return std::abs(std::scalbn(std::scalbn(x, exponent), -exponent) - x) <= kLeastLength;
    });
  });
}

// Why points do not survive scaling, and the remedy.
inline std::string refusal_to_scale(int exponent, const std::string& verb) {
  return exponent < 0
             ? "the mesh is too small to be " + verb + ", at the least numbers that there are: scale it up"
             : "the mesh is too large to be " + verb +
                   ", at the greatest numbers that there are: scale it down";
}

inline void scale_points(PolygonSoup& soup, int exponent) {
  for (Vector3& p : soup.points)
    for (double& x : p) x = std::scalbn(x, exponent);
}

}  // namespace mspskel::detail
