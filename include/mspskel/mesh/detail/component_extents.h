#pragma once

#include <vector>

#include "mspskel/mesh/detail/extent.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The extent of each component's vertices; it turns with the model. O(vertices).
inline std::vector<double> component_extents(const SurfaceSnapshot& surface) {
  std::vector<std::vector<Vector3>> points(static_cast<std::size_t>(surface.component_count));
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone) points[surface.component[v]].push_back(surface.position[v]);
  std::vector<double> extents;
  for (const std::vector<Vector3>& own : points) {
    Vector3 middle = Vector3::Zero();
    for (const Vector3& p : own) middle += p / static_cast<double>(own.size());
    extents.push_back(own.empty() ? 0.0 : extent(own, middle));
  }
  return extents;
}

}  // namespace detail
}  // namespace mspskel
