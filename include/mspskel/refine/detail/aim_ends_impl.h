#pragma once

#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/extend_ends.h"
#include "mspskel/base/linkage.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/arc_sections.h"

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

// Cuts the polyline off behind its last point that sees the target, no farther than the one nearest to it,
// and leads it on: to a target inside the solid, or up to where the ball nearly touches one on the surface.
inline bool lead_to_target(std::vector<Vector3>& points, const Vector3& target, bool target_inside,
                           const BoundingVolumeHierarchy& solid, double step) {
  const double share = target_inside ? 1.0 : 0.98;  // the target's own faces are no obstacle
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - target).squaredNorm() <= (points[nearest] - target).squaredNorm()) nearest = i;
  std::size_t count = nearest + 1;
  while (count > 0 &&
         solid.segment_crosses(points[count - 1], points[count - 1] + share * (target - points[count - 1])))
    --count;
  if (count == 0) return false;
  const std::vector<Vector3> before = points;
  points.resize(count);
  if (target_inside)
    points.push_back(target);
  else
    lead_towards(points, target, solid, step);
  if (points.size() < 2) points = before;
  return points != before;
}

}  // namespace detail

MSPSKEL_INLINE Index aim_ends(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, double step, const Execution& execution) {
  const detail::ArcBalls balls(graph, solid, execution);
  const detail::ArcLeaves leaves(graph, graph.incidence());
  Index aimed = 0;
  for (std::size_t i = 0; i < leaves.leaf.size(); ++i) {
    const detail::LeafArc& leaf = leaves.leaf[i];
    const detail::Ball& hub = balls.hub[leaf.joint];
    std::vector<Vector3> points = detail::leaf_points(graph, leaf);
    const double half_width = detail::section_size(
        solid, points.back(), points.back() - detail::point_before_end(points, 3 * step))[0];
    const double own_step = detail::step_for_width(half_width, step);
    // The corners of a flat end are about a half width off, whichever way the arc points.
    const Index v = detail::most_uncovered(surface, balls, leaves.vertices[i], leaf.arc, leaf.tip,
                                           std::max(own_step, 0.75 * half_width));
    if (v == kNone) continue;
    const bool within = std::all_of(points.begin(), points.end(),
                                    [&](const Vector3& x) { return (x - hub.centre).norm() < hub.radius; });
    if (!detail::aim_arc(points, surface.position[v], within, solid, own_step)) continue;
    detail::set_leaf_points(graph, leaf, std::move(points));
    ++aimed;
  }
  return aimed;
}

MSPSKEL_INLINE std::vector<Index> aim_at_tips(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                              const std::vector<LimbTip>& tips, double step, double slack) {
  const detail::ArcLeaves leaves(graph, graph.incidence());
  const std::vector<std::size_t> leaf_of_tip = detail::leaves_of_tips(graph, leaves, tips);
  std::vector<Index> aimed;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    if (leaf_of_tip[t] == detail::kNoLeaf || tips[t].kind == TipKind::kWayEnd) continue;
    const detail::LeafArc& leaf = leaves.leaf[leaf_of_tip[t]];
    std::vector<Vector3> points = detail::leaf_points(graph, leaf);
    const double off = (points.back() - tips[t].target).norm();
    if (slack > 0 && off <= slack * tips[t].measures.half_width) continue;
    if (!detail::lead_to_target(points, tips[t].target, tips[t].target != tips[t].position, solid,
                                detail::step_for_width(tips[t].measures.half_width, step)))
      continue;
    detail::set_leaf_points(graph, leaf, std::move(points));
    aimed.push_back(leaf.tip);
  }
  return aimed;
}

}  // namespace mspskel
