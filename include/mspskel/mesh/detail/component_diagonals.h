#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The diagonal of each component's axis-parallel box.
inline std::vector<double> component_diagonals(const SurfaceSnapshot& surface) {
  std::vector<Eigen::AlignedBox3d> box(static_cast<std::size_t>(surface.component_count));
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone) box[surface.component[v]].extend(surface.position[v]);
  std::vector<double> diagonal;
  for (const Eigen::AlignedBox3d& b : box) diagonal.push_back(b.isEmpty() ? 0.0 : b.diagonal().norm());
  return diagonal;
}

}  // namespace detail
}  // namespace mspskel
