#pragma once

#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// Grows the polyline at its back, by steps of at most the given length.
inline void grow(std::vector<Vector3>& points, const BoundingVolumeHierarchy& solid,
                 const ExtensionOptions& options, double longest_step) {
  const double radius = solid.distance(points.back());
  const double back = std::max(3 * longest_step, radius);
  double grown = 0;
  while (grown < options.max_length * radius) {
    const Vector3 here = points.back();
    Vector3 along = here - point_before_end(points, back);
    if (along.norm() == 0) return;
    along.normalize();
    const auto ahead = solid.first_hit(here, along);
    if (!ahead) return;
    const double step = std::min(longest_step, ahead->distance - options.tip_clearance * radius);
    if (step < 0.1 * longest_step) return;
    Vector3 goal = here + step * along;
    const VisibleSection section = visible_section(solid, goal, along, options.rays);
    if (section.closed) {
      Vector3 move = section.centre - goal;
      if (move.norm() > 0.3 * step) move *= 0.3 * step / move.norm();
      if (!solid.segment_crosses(here, goal + move)) goal += move;
    }
    if (solid.segment_crosses(here, goal)) return;
    points.push_back(goal);
    grown += step;
  }
}

}  // namespace detail

MSPSKEL_INLINE void extend_ends(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                const ExtensionOptions& options) {
  validate(options);
  const auto at = graph.incidence();
  for (Index h = 0; h < graph.hub_count(); ++h) {
    if (!graph.hub_alive[h] || at[h].size() != 1) continue;
    Arc& arc = graph.arcs[at[h][0]];
    const double own = detail::own_step(arc, solid, options.step);
    const bool reversed = arc.hub[0] == h;
    if (reversed) std::reverse(arc.points.begin(), arc.points.end());
    detail::grow(arc.points, solid, options, own);
    graph.hub_position[h] = arc.points.back();
    if (reversed) std::reverse(arc.points.begin(), arc.points.end());
  }
}

}  // namespace mspskel
