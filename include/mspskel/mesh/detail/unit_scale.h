// Coordinates of any size at the size of 1: areas and volumes of very small or large ones are no numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// The power of two that brings the largest coordinate to between 1 and 2, as far as a factor can: multiplying
// by it is exact, so nothing but the size changes. 1 if all coordinates are 0. Coordinates must be finite.
inline double unit_scale(const std::vector<Vector3>& points) {
  double most = 0;
  for (const Vector3& p : points) most = std::max(most, p.cwiseAbs().maxCoeff());
  constexpr int kMost = 1000;  // so that the factor and its inverse are numbers
  return most > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(most), -kMost, kMost)) : 1.0;
}

}  // namespace mspskel::detail
