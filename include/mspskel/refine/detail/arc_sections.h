// How wide the solid is round an arc, by its visible sections.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/arcs/detail/arc_balls.h"
#include "mspskel/limbs/limb_measures.h"

namespace mspskel {
namespace detail {

// Half width and perimeter of the visible section across a direction; zeros where there is none.
inline std::array<double, 2> section_size(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                          const Vector3& along) {
  constexpr int kRays = 16;
  if (along.norm() == 0) return {0.0, 0.0};
  const VisibleSection section = visible_section(solid, x, along.normalized(), kRays);
  if (!section.closed) return {0.0, 0.0};
  const double area = kPi * section.radius * section.radius;
  const double perimeter = std::sqrt(4 * kPi * area / std::max(section.roundness, 1e-6));
  return {section.half_width, perimeter};
}

}  // namespace detail
}  // namespace mspskel
