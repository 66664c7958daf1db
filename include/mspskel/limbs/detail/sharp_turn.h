// Where a surface turns off sharply.
#pragma once

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Across a half-edge, from a side of unit normal `here` to one of unit normal `beyond`: 1 where it turns
// outward by more than 50 degrees, -1 where inward, else 0.
inline int sharp_turn(const SurfaceSnapshot& surface, Index h, const Vector3& here, const Vector3& beyond) {
  constexpr double kSharp = 0.64;  // the cosine of 50 degrees
  if (!(here.dot(beyond) < kSharp)) return 0;
  const Vector3 along = surface.position[surface.target(h)] - surface.position[surface.origin[h]];
  const double bend = here.cross(beyond).dot(along);
  return bend > 0 ? 1 : bend < 0 ? -1 : 0;
}

}  // namespace detail
}  // namespace mspskel
