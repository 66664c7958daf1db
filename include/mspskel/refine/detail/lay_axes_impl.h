#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/single_arc.h"
#include "mspskel/base/linkage.h"
#include "mspskel/skeleton/useless_pieces.h"
#include "mspskel/solid/detail/axis_stretch.h"

namespace mspskel {
namespace detail {

// Both ends half the middle ball's radius before the surface. Nothing if that leaves less than `least`.
inline std::optional<std::vector<Vector3>> axis_points(const SolidMoments& moments, double least,
                                                       const BoundingVolumeHierarchy& solid) {
  const auto stretch = axis_stretch(moments, solid);
  if (!stretch) return std::nullopt;
  const auto [from, to] = *stretch;
  const Vector3 centre =
      is_well_inside(moments.centroid(), solid) ? moments.centroid() : Vector3((from + to) / 2);
  if (!((from - centre).norm() > 0 && (to - centre).norm() > 0)) return std::nullopt;
  const double clearance = solid.distance(centre);
  const auto end = [&](const Vector3& surface) -> Vector3 {
    // As far before the surface as a grown end (ExtensionOptions), and at least a tenth of the way off, so
    // that the arc has a length.
    constexpr double kTipClearance = 0.5;
    const double distance = (surface - centre).norm();
    const double reach = std::max(0.1 * distance, distance - kTipClearance * clearance);
    return centre + reach / distance * (surface - centre);
  };
  std::vector<Vector3> points{end(from), centre, end(to)};
  if (!((points.front() - points.back()).norm() >= least)) return std::nullopt;
  return points;
}

}  // namespace detail

MSPSKEL_INLINE Index lay_axes(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const std::vector<LimbTip>& tips) {
  const std::vector<bool> limbed = components_with_limbs(surface, tips);
  if (std::find(limbed.begin(), limbed.end(), false) == limbed.end()) return 0;
  const std::vector<Index> twice_euler = twice_euler_characteristics(surface);
  const std::vector<detail::SolidMoments> moments = detail::solid_moments(surface);
  const std::vector<Index> component = detail::components_of_pieces(graph, surface);
  const std::vector<double> extent = component_extents(surface);
  Index laid = 0;
  for (Index c = 0; c < surface.component_count; ++c) {
    if (limbed[c] || twice_euler[c] != 4) continue;
    auto points = detail::axis_points(moments[c], 1e-6 * extent[c], solid);
    if (!points) continue;
    detail::replace_by_arc(graph, surface, component, c, std::move(*points));
    ++laid;
  }
  return laid;
}

}  // namespace mspskel
