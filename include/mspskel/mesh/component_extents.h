// How large the components of a surface are.
#pragma once

#include <vector>

#include "mspskel/mesh/detail/extent.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// Per component the greatest distance of a vertex from the one that is farthest from the mean of all: at
// least half the greatest distance between two; it turns with the model. Normalised units. O(vertices).
inline std::vector<double> component_extents(const SurfaceSnapshot& surface) {
  std::vector<std::vector<Vector3>> points(static_cast<std::size_t>(surface.component_count));
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone) points[surface.component[v]].push_back(surface.position[v]);
  std::vector<double> extents;
  for (const std::vector<Vector3>& own : points) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& p : own) sum += p;
    extents.push_back(own.empty() ? 0.0 : detail::extent(own, sum / static_cast<double>(own.size())));
  }
  return extents;
}

}  // namespace mspskel
