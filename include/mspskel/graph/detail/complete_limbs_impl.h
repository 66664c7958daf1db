#pragma once

#include <algorithm>
#include <limits>

#include "mspskel/base/linkage.h"
#include "mspskel/graph/detail/arc_leaves.h"
#include "mspskel/graph/detail/arc_sections.h"
#include "mspskel/graph/detail/graph_points.h"
#include "mspskel/graph/detail/polyline_ends.h"

namespace mspskel {
namespace detail {

// What no arc comes near protrudes by more than this many smallest features.
inline constexpr double kLeastProtrusion = 3.5;

// A sheet lies far outside all balls whatever the arcs, so nothing there tells a limb.
inline constexpr double kMostUncovered = 0.15;  // share of the area

// The rim of a tube's flat end lies up to 0.62 radii outside the balls on its axis, a cube's corner 0.73
// outside the ball in it; neither is a limb.
inline constexpr double kCorner = 0.75;

// What has less than this share of the evidence before its way is centred has too little afterwards as well.
inline constexpr double kDoubt = 0.5;

class LimbCompletion {
 public:
  LimbCompletion(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                 const VertexSlices& slices, std::vector<LimbTip>& tips, const LimbOptions& options,
                 double step, InnerGraph& inner, const Execution& execution)
      : graph_(graph),
        surface_(surface),
        solid_(solid),
        slices_(slices),
        tips_(tips),
        options_(options),
        step_(step),
        inner_(inner) {
    const ArcBalls balls(graph, solid, execution);
    const BallIndex index(graph, balls);
    outside_.assign(surface.position.size(), 0.0);
    std::vector<std::uint8_t> covered(surface.position.size(), 1);
    parallel_for(
        surface.vertex_count(), "arcs", execution, [] { return 0; },
        [&](Index v, int) {
          const Index own = graph.arc_of_vertex[v];
          if (own == kNone && graph.hub_of_vertex[v] == kNone) return;
          const Vector3& x = surface.position[v];
          // The vertex's own arc or hub first: few balls of others are nearer.
          const Ball& hub = balls.hub[own == kNone ? graph.hub_of_vertex[v] : graph.arcs[own].hub[0]];
          double outside = hub.distance_outside(x), radius = hub.radius;
          if (own != kNone) balls.arc[own].find_nearest(x, outside, radius);
          index.find_nearest(x, outside, radius);
          outside_[v] = outside;
          covered[v] = outside <= radius;
        });
    hub_component_ = components_of_pieces(graph, surface);
    find_searched(covered);
  }

  Index run() {
    constexpr int kTries = 64;
    Index added = reach_tips();
    for (std::size_t v = 0; v < outside_.size(); ++v) {
      const Index c = surface_.component[v];
      if (c == kNone || !searched_[c]) outside_[v] = std::min(outside_[v], 0.0);
    }
    for (int i = 0; i < kTries; ++i) {
      const auto farthest = std::max_element(outside_.begin(), outside_.end());
      if (!(*farthest > std::max(kLeastProtrusion * options_.smallest, step_))) break;
      const Index v = static_cast<Index>(farthest - outside_.begin());
      const double before = *farthest;
      if (try_limb(v, false)) {
        tips_.push_back(new_tip(v, before));
        ++added;
      }
      // Tried once, whether or not: an arc may end far from what it was led to.
      if (outside_[v] > 0.5 * before) dismiss(v);
    }
    return added;
  }

 private:
  // Arcs to the tips that no leaf arc stands for. What goes round a handle has a tip too, but lies within the
  // balls of the loop.
  Index reach_tips() {
    const auto at = graph_.incidence();
    std::vector<std::pair<double, Index>> bare;
    const std::vector<std::size_t> leaf = leaves_of_tips(graph_, ArcLeaves(graph_, at), tips_);
    for (std::size_t i = 0; i < tips_.size(); ++i)
      if (leaf[i] == kNoLeaf && tips_[i].kind != TipKind::kWayEnd)
        bare.push_back({-tips_[i].measures.depth, static_cast<Index>(i)});
    std::sort(bare.begin(), bare.end());
    Index added = 0;
    for (const auto& [depth, i] : bare)
      if (outside_[tips_[i].vertex] > -0.5 * depth && reach_tip(tips_[i])) ++added;
    return added;
  }

  // The end of a body lies in its middle, so the way to it is straight or none.
  bool reach_tip(const LimbTip& tip) {
    if (tip.kind != TipKind::kBodyEnd) return try_limb(tip.vertex, true);
    const Index component = surface_.component[tip.vertex];
    const auto own = [&](Index hub) { return hub_component_[hub] == component; };
    for (const auto& [distance, point] :
         nearest_points(graph_, tip.target, own, [&](Index arc) { return own(graph_.arcs[arc].hub[0]); })) {
      if (distance < step_) return false;
      if (solid_.segment_crosses(point.position, tip.target)) continue;
      add(point, resampled({{0, 1}, {point.position, tip.target}, true}, step_), component);
      return true;
    }
    return false;
  }

  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  // Which components of the surface are searched for more limbs than the tips tell.
  void find_searched(const std::vector<std::uint8_t>& covered) {
    const auto count = static_cast<std::size_t>(surface_.component_count);
    std::vector<double> whole(count, 0.0), bare(count, 0.0);
    for (std::size_t v = 0; v < covered.size(); ++v) {
      if (surface_.vertex_halfedge[v] == kNone) continue;
      whole[surface_.component[v]] += surface_.vertex_area[v];
      if (!covered[v]) bare[surface_.component[v]] += surface_.vertex_area[v];
    }
    searched_ = components_with_limbs(surface_, tips_);
    for (std::size_t c = 0; c < count; ++c)
      if (bare[c] > kMostUncovered * whole[c]) searched_[c] = false;
  }

  LimbTip new_tip(Index v, double depth) const {
    LimbTip tip;
    tip.vertex = v;
    tip.position = tip.target = surface_.position[v];
    tip.measures.depth = depth;
    for (Index w = 0; w < surface_.vertex_count(); ++w)
      if (surface_.component[w] == surface_.component[v] &&
          (surface_.position[w] - surface_.position[v]).norm() < 0.5 * depth)
        tip.cap.push_back(w);
    return tip;
  }

  void cover(const BallChain& balls) {
    for (std::size_t v = 0; v < outside_.size(); ++v)
      outside_[v] = balls.distance_outside(surface_.position[v], kNever, outside_[v]);
  }

  // What lies round a vertex whose arc would be insignificant is not tried again.
  void dismiss(Index v) {
    const double reach = outside_[v];
    for (std::size_t w = 0; w < outside_.size(); ++w)
      if ((surface_.position[w] - surface_.position[v]).norm() <= reach) outside_[w] = 0;
  }

  // The way from the skeleton to v: straight from the nearest point that sees v, or through the solid.
  bool find_way(Index v, GraphPoint& start, std::vector<Vector3>& way, bool is_tip) {
    const Vector3& target = surface_.position[v];
    const auto own = [&](Index hub) { return hub_component_[hub] == surface_.component[v]; };
    const auto points =
        nearest_points(graph_, target, own, [&](Index arc) { return own(graph_.arcs[arc].hub[0]); });
    // Centring seldom halves the ball, so what lies that close to it is not worth a way.
    if (points.empty()) return false;
    if (!is_tip && outside_[v] < 0.5 * kCorner * solid_.distance(points.front().second.position))
      return false;
    const auto reaches = [&] {
      return (way.back() - target).norm() <= 2 * std::max(step_, solid_.distance(way.back()));
    };
    for (const auto& [distance, point] : points) {
      const Vector3& x = point.position;
      if (solid_.segment_crosses(x, x + 0.98 * (target - x))) continue;
      start = point;
      way.assign(1, x);
      lead_towards(way, target, solid_, step_);
      // Along a thin limb the straight way may graze the surface.
      if (!reaches()) break;
      return way.size() > 2;
    }
    inner_.prepare();
    if (!inner_.usable(v)) return false;
    start = points.front().second;
    std::vector<Vector3> between;
    if (!inner_.path(start.position, inner_.point(v), between)) return false;
    way.assign(1, start.position);
    way.insert(way.end(), between.begin(), between.end());
    const std::size_t inside = way.size();
    lead_towards(way, target, solid_, step_);
    if (!reaches()) {  // the target's own chord leads there for certain
      way.resize(inside);
      way.push_back(inner_.point(v));
      lead_towards(way, target, solid_, step_);
    }
    return way.size() > 2;
  }

  bool try_limb(Index v, bool is_tip) {
    GraphPoint start;
    std::vector<Vector3> way;
    if (!find_way(v, start, way, is_tip)) return false;
    if (!is_tip && !deserves_arc(way, v, kDoubt)) return false;
    // A few rounds of centring with the start held show the limb's true width.
    way = centred_alone(way, solid_, step_);
    if (!is_tip && !deserves_arc(way, v, 1.0)) return false;
    if (solid_.segment_crosses(start.position, way.front())) return false;
    way.insert(way.begin(), start.position);
    add(start, way, surface_.component[v]);
    return true;
  }

  bool deserves_arc(const std::vector<Vector3>& way, Index v, double share) const {
    const Ball ball{way.front(), solid_.distance(way.front())};
    LimbOptions options = options_;
    options.slenderness *= share;
    return outside_[v] >= share * kCorner * ball.radius && is_missed_limb(measure(way, ball, v), options);
  }

  LimbMeasures measure(const std::vector<Vector3>& way, const Ball& ball, Index v) const {
    LimbMeasures m;
    m.depth = outside_[v];
    // The part of the way that lies in the limb, or the last three of its edges.
    std::size_t first = 0;
    while (first + 3 < way.size() && (way[first + 1] - surface_.position[v]).norm() > 1.2 * m.depth) ++first;
    const std::vector<Vector3> own(way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
    const auto [width, perimeter] = lower_section(own, ball, solid_);
    m.half_width = width;
    std::vector<double> parents;
    for (Index w = 0; w < surface_.vertex_count(); ++w)
      if (slices_.valid[w] && outside_[w] < 0.1 * m.depth &&
          (surface_.position[w] - ball.centre).norm() < 2 * std::max(ball.radius, width))
        parents.push_back(slices_.perimeter[w]);
    if (perimeter > 0) m.msp_ratio = std::max(1.0, value_at_rank(std::move(parents), 0.5) / perimeter);
    return m;
  }

  // Vertices of other components are none of the limb's business, however near they lie.
  void add(const GraphPoint& start, const std::vector<Vector3>& way, Index component) {
    Arc limb;
    limb.hub = {hub_at(graph_, surface_, start), graph_.add_hub(way.back())};
    hub_component_.resize(graph_.hub_position.size(), component);
    limb.points = way;
    const Index added = graph_.arc_count();
    graph_.arcs.push_back(std::move(limb));
    std::vector<Ball> balls;
    for (std::size_t i = 1; i < way.size(); ++i) balls.push_back({way[i], solid_.distance(way[i])});
    const std::vector<double> before = outside_;
    cover(BallChain(std::move(balls)));
    for (std::size_t v = 0; v < outside_.size(); ++v)
      if (surface_.component[v] == component && before[v] > 0 && outside_[v] < before[v]) {
        graph_.arc_of_vertex[v] = added;
        graph_.hub_of_vertex[v] = kNone;
      }
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const VertexSlices& slices_;
  std::vector<LimbTip>& tips_;
  const LimbOptions& options_;
  double step_;
  InnerGraph& inner_;
  std::vector<Index> hub_component_;
  std::vector<bool> searched_;   // per component of the surface
  std::vector<double> outside_;  // per vertex: distance beyond all balls, at most 0 where done with
};

}  // namespace detail

MSPSKEL_INLINE Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                    const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                    std::vector<LimbTip>& tips, const LimbOptions& options, double step,
                                    detail::InnerGraph& inner, const Execution& execution) {
  return detail::LimbCompletion(graph, surface, solid, slices, tips, options, step, inner, execution).run();
}

MSPSKEL_INLINE Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                    const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                    std::vector<LimbTip>& tips, const LimbOptions& options, double step) {
  detail::InnerGraph inner(surface, solid);
  return complete_limbs(graph, surface, solid, slices, tips, options, step, inner);
}

}  // namespace mspskel
