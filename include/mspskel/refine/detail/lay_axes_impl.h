#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/detail/single_arc.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/component_extents.h"
#include "mspskel/mesh/detail/box_direction.h"
#include "mspskel/skeleton/useless_pieces.h"
#include "mspskel/solid/detail/axis_stretch.h"

namespace mspskel {
namespace detail {

// Of a plate's extent, what its axis has to have of it. A bent one has less, and a way of its own.
inline constexpr double kThrough = 0.5;

// Both ends half the middle ball's radius before the surface. Nothing if that leaves less than `least`.
inline std::optional<std::vector<Vector3>> axis_points(const SolidMoments& moments, const Vector3& axis,
                                                       double least, const BoundingVolumeHierarchy& solid) {
  const auto stretch = axis_stretch(moments, axis, solid);
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

// Whether a component is a prism and has no tips but one at either end.
inline bool is_bare_prism(const SurfaceSnapshot& surface, const SolidMoments& moments,
                          const BoundingVolumeHierarchy& solid, const std::vector<Index>& tips) {
  constexpr double kAtEnd = 0.1;  // of its length
  const auto stretch = prism_stretch(moments, solid);
  if (!stretch) return false;
  const Vector3 along = (*stretch)[1] - (*stretch)[0];
  std::array<int, 2> at_end{0, 0};
  for (const Index v : tips) {
    const double share = (surface.position[v] - (*stretch)[0]).dot(along) / along.squaredNorm();
    if (share > kAtEnd && share < 1 - kAtEnd) return false;
    ++at_end[share > 0.5 ? 1 : 0];
  }
  return at_end[0] <= 1 && at_end[1] <= 1;
}

// Per component whether a limb or a flat end tells more of it than its axis does.
inline std::vector<bool> components_with_arcs_of_limbs(const SurfaceSnapshot& surface,
                                                       const BoundingVolumeHierarchy& solid,
                                                       const std::vector<LimbTip>& tips,
                                                       const std::vector<Index>& handles,
                                                       const std::vector<SolidMoments>& moments) {
  std::vector<bool> limbed = components_with_limbs(surface, tips);
  std::vector<std::vector<Index>> tips_of(limbed.size());
  for (const LimbTip& tip : tips) tips_of[surface.component[tip.vertex]].push_back(tip.vertex);
  for (std::size_t c = 0; c < limbed.size(); ++c)
    if (limbed[c] && handles[c] == 0 && is_bare_prism(surface, moments[c], solid, tips_of[c]))
      limbed[c] = false;
  return limbed;
}

}  // namespace detail

MSPSKEL_INLINE Index lay_axes(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const std::vector<LimbTip>& tips) {
  const std::vector<Index> handles = handles_of_components(surface);
  const std::vector<detail::SolidMoments> moments = detail::solid_moments(surface);
  const std::vector<bool> limbed =
      detail::components_with_arcs_of_limbs(surface, solid, tips, handles, moments);
  if (std::find(limbed.begin(), limbed.end(), false) == limbed.end()) return 0;
  const std::vector<Index> component = detail::components_of_pieces(graph, surface);
  const std::vector<double> extent = component_extents(surface);
  std::vector<std::optional<std::vector<Vector3>>> points(limbed.size());
  std::vector<bool> untold(limbed.size(), false);  // whose principal axes do not tell how they lie
  for (std::size_t c = 0; c < limbed.size(); ++c) {
    if (limbed[c] || handles[c] > 0 || !moments[c].has_volume()) continue;
    if (moments[c].axis_stands_apart())
      points[c] = detail::axis_points(moments[c], moments[c].axis(), 1e-6 * extent[c], solid);
    untold[c] = !points[c] || detail::length_of(*points[c]) < kLeastPieceLength * extent[c];
  }
  const std::vector<detail::FourthMoment> fourth = detail::fourth_moments(surface, moments, untold);
  Index laid = 0;
  for (Index c = 0; c < surface.component_count; ++c) {
    if (untold[c]) {
      const double least = moments[c].axis_stands_apart() ? detail::kThrough : 1e-6;
      auto along = detail::axis_points(moments[c], detail::box_direction(moments[c], fourth[c]),
                                       least * extent[c], solid);
      if (along) points[c] = std::move(along);
    }
    if (!points[c]) continue;
    detail::replace_by_arc(graph, surface, component, c, std::move(*points[c]));
    ++laid;
  }
  return laid;
}

}  // namespace mspskel
