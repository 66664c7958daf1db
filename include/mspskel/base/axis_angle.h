// The angle between two axes.
#pragma once

#include <cmath>

#include "mspskel/base/types.h"

namespace mspskel {

// 0 to π/2 radians, accurate near both ends: axes, such as the normals of planes, have no sign. Both have
// unit length, or are zero (unknown), which gives 0.
inline double axis_angle(const Vector3& a, const Vector3& b) {
  const double cosine = std::abs(a.dot(b)), square = a.cross(b).squaredNorm();
  return cosine * cosine < square ? std::acos(cosine) : std::asin(std::sqrt(square));
}

}  // namespace mspskel
