#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mspskel/base/linkage.h"
#include "mspskel/graph/detail/axis_stretch.h"
#include "mspskel/graph/detail/hub_components.h"

namespace mspskel {
namespace detail {

// Both ends half the middle ball's radius before the surface.
inline std::optional<std::vector<Vector3>> axis_points(const SolidMoments& moments,
                                                       const BoundingVolumeHierarchy& solid) {
  const auto stretch = axis_stretch(moments, solid);
  if (!stretch) return std::nullopt;
  const auto [from, to] = *stretch;
  const Vector3 centre = solid.inside(moments.centroid()) ? moments.centroid() : Vector3((from + to) / 2);
  const double clearance = solid.distance(centre);
  const auto end = [&](const Vector3& surface) -> Vector3 {
    // As far before the surface as a grown end (ExtensionOptions), and at least a tenth of the way off, so
    // that the arc has a length.
    constexpr double kTipClearance = 0.5;
    const double distance = (surface - centre).norm();
    const double reach = std::max(0.1 * distance, distance - kTipClearance * clearance);
    return centre + reach / distance * (surface - centre);
  };
  return std::vector<Vector3>{end(from), centre, end(to)};
}

}  // namespace detail

MSPSKEL_INLINE Index lay_axes(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const std::vector<LimbTip>& tips) {
  const std::vector<bool> limbed = components_with_limbs(surface, tips);
  if (std::find(limbed.begin(), limbed.end(), false) == limbed.end()) return 0;
  const std::vector<Index> twice_euler = twice_euler_characteristics(surface);
  const std::vector<detail::SolidMoments> moments = detail::solid_moments(surface);
  const std::vector<Index> component = detail::hub_components(graph, surface);
  const std::size_t collapsed_arcs = graph.arcs.size();
  Index laid = 0;
  for (Index c = 0; c < surface.component_count; ++c) {
    if (limbed[c] || twice_euler[c] != 4) continue;
    const auto points = detail::axis_points(moments[c], solid);
    if (!points) continue;
    for (std::size_t i = 0; i < collapsed_arcs; ++i)
      if (component[graph.arcs[i].hub[0]] == c) graph.arcs[i].alive = false;
    for (Index h = 0; h < static_cast<Index>(component.size()); ++h)
      if (component[h] == c) graph.hub_alive[h] = false;
    Arc axis;
    axis.hub = {graph.add_hub(points->front()), graph.add_hub(points->back())};
    axis.points = *points;
    graph.arcs.push_back(std::move(axis));
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (surface.vertex_halfedge[v] == kNone || surface.component[v] != c) continue;
      graph.arc_of_vertex[v] = graph.arc_count() - 1;
      graph.hub_of_vertex[v] = kNone;
    }
    ++laid;
  }
  return laid;
}

}  // namespace mspskel
