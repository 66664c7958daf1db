#pragma once

#include "mspskel/graph/extend_ends.h"

namespace mspskel {
namespace detail {

// The vertex farthest outside all balls among those whose nearest ball of the arc is that of its tip; kNone
// if none is outside by more than `least`.
inline Index most_uncovered(const SurfaceSnapshot& surface, const ArcBalls& balls,
                            const std::vector<Index>& vertices, Index arc, Index tip, double least) {
  Index best = kNone;
  double farthest = least;
  for (const Index v : vertices) {
    const Vector3& x = surface.position[v];
    const double outside_tip = balls.hub[tip].distance_outside(x);
    if (outside_tip <= farthest || balls.arc[arc].distance_outside(x, outside_tip) < outside_tip) continue;
    double outside = outside_tip;
    for (const Ball& hub : balls.hub) outside = std::min(outside, hub.distance_outside(x));
    for (std::size_t b = 0; b < balls.arc.size() && outside > farthest; ++b)
      outside = balls.arc[b].distance_outside(x, farthest, outside);
    if (outside > farthest) {
      farthest = outside;
      best = v;
    }
  }
  return best;
}

// Points from `from` straight towards `target` until the maximal ball nearly touches it.
inline void lead_towards(std::vector<Vector3>& points, const Vector3& target,
                         const BoundingVolumeHierarchy& solid, double step) {
  const Vector3 from = points.back(), way = target - from;
  const double length = way.norm();
  for (double walked = step; walked < length; walked += step) {
    const Vector3 x = from + way * (walked / length);
    const double clearance = solid.distance(x);
    if (clearance > 0.9 * (length - walked) || clearance < 0.25 * step) break;
    points.push_back(x);
  }
}

// Leads the polyline on from its last point, or, if that does not see the target, from the start.
inline bool aim_arc(std::vector<Vector3>& points, const Vector3& target, bool within_joint,
                    const BoundingVolumeHierarchy& solid, double step) {
  // A little before the surface, so that the target's own faces are no obstacle.
  const auto sees = [&](const Vector3& x) { return !solid.segment_crosses(x, x + 0.98 * (target - x)); };
  if (within_joint && sees(points.front()))
    points.resize(1);
  else if (!sees(points.back()))
    return false;
  const std::size_t before = points.size();
  lead_towards(points, target, solid, step);
  return points.size() > before;
}

}  // namespace detail

inline Index aim_ends(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                      double step, const Execution& execution) {
  const auto at = graph.incidence();
  const detail::ArcBalls balls(graph, solid, execution);
  const detail::ArcParts parts(graph, at);
  Index aimed = 0;
  for (const auto& [a, joint] : parts.leaves) {
    Arc& arc = graph.arcs[a];
    const bool reversed = arc.hub[1] == joint;
    const Index tip = arc.hub[reversed ? 0 : 1];
    const detail::Ball& hub = balls.hub[joint];
    std::vector<Vector3> points = points_from(arc, reversed ? 1 : 0);
    const double half_width = detail::section_size(
        solid, points.back(), points.back() - detail::point_before_end(points, 3 * step))[0];
    // The corners of a flat end are about a half width off, whichever way the arc points.
    const Index v =
        detail::most_uncovered(surface, balls, parts.vertices[a], a, tip, std::max(step, 0.75 * half_width));
    if (v == kNone) continue;
    const bool within = std::all_of(arc.points.begin(), arc.points.end(),
                                    [&](const Vector3& x) { return (x - hub.centre).norm() < hub.radius; });
    if (!detail::aim_arc(points, surface.position[v], within, solid, step)) continue;
    graph.hub_position[tip] = points.back();
    if (reversed) std::reverse(points.begin(), points.end());
    arc.points = std::move(points);
    ++aimed;
  }
  return aimed;
}

}  // namespace mspskel
