#pragma once

#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/extend_ends.h"
#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/end_target.h"
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

// The place of the last point that sees the target, no farther along than the one nearest to it; kNoLeaf if
// none does.
inline std::size_t last_in_sight(const std::vector<Vector3>& points, const LimbTip& tip,
                                 const BoundingVolumeHierarchy& solid) {
  const double share = ends_inside(tip) ? 1.0 : 0.98;  // the target's own faces are no obstacle
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - tip.target).squaredNorm() <= (points[nearest] - tip.target).squaredNorm()) nearest = i;
  for (std::size_t i = nearest + 1; i-- > 0;)
    if (!solid.segment_crosses(points[i], points[i] + share * (tip.target - points[i]))) return i;
  return kNoLeaf;
}

// Leads a leaf arc to the target of its tip: straight from its last point that sees it, else along the middle
// of the solid from the joint. Up to a target inside the solid, or to where the ball nearly touches one on
// the surface.
inline bool lead_to_target(std::vector<Vector3>& points, const LimbTip& tip, InnerGraph& inner, double step) {
  constexpr Index kMostOfWay = 2000;  // vertices; a way that comes by more is none into a limb
  constexpr double kNear = 2;         // half widths; what ends so near its target needs no other way
  const BoundingVolumeHierarchy& solid = inner.solid();
  const std::vector<Vector3> before = points;
  const std::size_t seeing = last_in_sight(points, tip, solid);
  if (seeing != kNoLeaf) {
    points.resize(seeing + 1);
  } else {
    if ((points.back() - tip.target).norm() <= kNear * tip.measures.half_width) return false;
    inner.prepare();
    std::vector<Vector3> between;
    if (!inner.usable(tip.vertex) || !solid.inside(inner.point(tip.vertex)) ||
        !inner.path(inner.point(tip.vertex), points.front(), between, kMostOfWay))
      return false;
    points.resize(1);
    points.insert(points.end(), between.rbegin(), between.rend());
    points.push_back(inner.point(tip.vertex));
    const std::size_t sight = last_in_sight(points, tip, solid);
    if (sight == kNoLeaf) {
      points = before;
      return false;
    }
    points.resize(sight + 1);
  }
  if (ends_inside(tip))
    points.push_back(tip.target);
  else
    lead_towards(points, tip.target, solid, step);
  if (points.size() < 2) points = before;
  return points != before;
}

// How far an arc may end from its target, times the slack: a cap has its middle where it is, however wide the
// limb is.
inline double width_of_end(const LimbTip& tip) {
  constexpr double kOfFlatEnd = 0.25;  // of its radius
  const double half_width = tip.measures.half_width;
  return tip.flat_end > 0 ? std::min(half_width, kOfFlatEnd * tip.flat_end) : half_width;
}

// Half of a lone arc, from its middle to the given end.
inline std::vector<Vector3> half_of(const Arc& arc, int end) {
  std::vector<Vector3> whole = points_from(arc, 1 - end);
  whole.erase(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2));
  return whole;
}

// The tip on a lone arc that one of its ends is to be led to: the nearest of those that only this half sees,
// or that are no nearer to the other end. Nothing if there is none.
inline const LimbTip* tip_of_end(const ArcGraph& graph, Index a, int end, const std::vector<LimbTip>& tips,
                                 const BoundingVolumeHierarchy& solid) {
  const Arc& arc = graph.arcs[a];
  const Vector3 &here = graph.hub_position[arc.hub[end]], &there = graph.hub_position[arc.hub[1 - end]];
  const std::vector<Vector3> own = half_of(arc, end), other = half_of(arc, 1 - end);
  const LimbTip* nearest = nullptr;
  for (const LimbTip& tip : tips) {
    const Index hub = graph.hub_of_vertex[tip.vertex];
    const bool on_arc =
        graph.arc_of_vertex[tip.vertex] == a || (hub != kNone && (hub == arc.hub[0] || hub == arc.hub[1]));
    if (tip.kind == TipKind::kWayEnd || !on_arc) continue;
    const auto seen_from = [&](const std::vector<Vector3>& half) {
      return last_in_sight(half, tip, solid) != kNoLeaf;
    };
    const double distance = (tip.target - here).norm();
    const bool by_own = seen_from(own), by_other = seen_from(other);
    if (by_own != by_other ? by_other : distance > (tip.target - there).norm()) continue;
    if (nearest == nullptr || distance < (nearest->target - here).norm()) nearest = &tip;
  }
  return nearest;
}

// The ends of arcs without a joint: each half of one is led to the target of its tip, if it ends farther than
// a quarter of `slack` half widths from it.
inline void aim_lone_arcs(ArcGraph& graph, InnerGraph& inner, const std::vector<LimbTip>& tips, double step,
                          double slack, std::vector<Index>& aimed) {
  constexpr double kStricter = 0.25;  // no joint holds them: in flat bars centring swings them about
  const auto at = graph.incidence();
  for (Index a = 0; a < graph.arc_count(); ++a) {
    Arc& arc = graph.arcs[a];
    if (!arc.alive || at[arc.hub[0]].size() != 1 || at[arc.hub[1]].size() != 1) continue;
    for (const int end : {0, 1}) {
      const LimbTip* tip = tip_of_end(graph, a, end, tips, inner.solid());
      if (tip == nullptr) continue;
      const double half_width = tip->measures.half_width;
      if ((graph.hub_position[arc.hub[end]] - tip->target).norm() <= kStricter * slack * half_width) continue;
      std::vector<Vector3> half = half_of(arc, end);
      if (half.size() < 2 || !lead_to_target(half, *tip, inner, step_for_width(half_width, step))) continue;
      std::vector<Vector3> whole = points_from(arc, 1 - end);
      whole.resize(whole.size() / 2);
      whole.insert(whole.end(), half.begin(), half.end());
      graph.hub_position[arc.hub[end]] = whole.back();
      if (end == 0) std::reverse(whole.begin(), whole.end());
      arc.points = std::move(whole);
      aimed.push_back(arc.hub[end]);
    }
  }
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
    const double own = detail::own_step(graph.arcs[leaf.arc], solid, step);
    const double half_width = detail::section_size(
        solid, points.back(), points.back() - detail::point_before_end(points, 3 * own))[0];
    // The corners of a flat end are about a half width off, whichever way the arc points.
    const Index v = detail::most_uncovered(surface, balls, leaves.vertices[i], leaf.arc, leaf.tip,
                                           std::max(own, 0.75 * half_width));
    if (v == kNone) continue;
    const bool within = std::all_of(points.begin(), points.end(),
                                    [&](const Vector3& x) { return (x - hub.centre).norm() < hub.radius; });
    if (!detail::aim_arc(points, surface.position[v], within, solid, own)) continue;
    detail::set_leaf_points(graph, leaf, std::move(points));
    ++aimed;
  }
  return aimed;
}

MSPSKEL_INLINE std::vector<Index> aim_at_tips(ArcGraph& graph, detail::InnerGraph& inner,
                                              const std::vector<LimbTip>& tips, double step, double slack) {
  const detail::ArcLeaves leaves(graph, graph.incidence());
  const std::vector<std::size_t> leaf_of_tip = detail::leaves_of_tips(graph, leaves, tips);
  std::vector<Index> aimed;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    if (leaf_of_tip[t] == detail::kNoLeaf || tips[t].kind == TipKind::kWayEnd) continue;
    const detail::LeafArc& leaf = leaves.leaf[leaf_of_tip[t]];
    std::vector<Vector3> points = detail::leaf_points(graph, leaf);
    const double half_width = tips[t].measures.half_width;
    if (slack > 0 && (points.back() - tips[t].target).norm() <= slack * detail::width_of_end(tips[t])) continue;
    if (!detail::lead_to_target(points, tips[t], inner, detail::step_for_width(half_width, step))) continue;
    detail::set_leaf_points(graph, leaf, std::move(points));
    aimed.push_back(leaf.tip);
  }
  if (slack > 0) detail::aim_lone_arcs(graph, inner, tips, step, slack, aimed);
  return aimed;
}

}  // namespace mspskel
