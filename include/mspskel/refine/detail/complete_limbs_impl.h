#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/arc_sections.h"
#include "mspskel/solid/detail/ball_tree.h"

namespace mspskel {
namespace detail {

// What no arc comes near and protrudes less is none, in smallest features.
inline constexpr double kLeastProtrusion = 3.5;

class LimbCompletion {
 public:
  LimbCompletion(ArcGraph& graph, InnerGraph& inner, std::vector<LimbTip>& tips, const LimbOptions& options,
                 double step, const Execution& execution)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        tips_(tips),
        options_(options),
        step_(step),
        inner_(inner) {
    const ArcBalls balls(graph, solid_, execution);
    const BallTree tree(all_balls(graph, balls));
    outside_.assign(surface_.position.size(), 0.0);
    parallel_for(
        surface_.vertex_count(), "arcs", execution, [] { return 0; },
        [&](Index v, int) {
          if (graph.arc_of_vertex[v] == kNone && graph.hub_of_vertex[v] == kNone) return;
          outside_[v] = tree.distance_outside(surface_.position[v]);
        });
    hub_component_ = components_of_pieces(graph, surface_);
  }

  Index run() {
    constexpr int kTries = 64;
    Index added = reach_tips();
    for (int i = 0; i < kTries; ++i) {
      const std::optional<SlenderPart> part = deepest_part();
      if (!part) break;
      const double before = outside_[part->top];
      LimbTip tip = new_tip(*part);
      if (try_limb(part->top)) {
        tips_.push_back(std::move(tip));
        ++added;
      }
      // Tried once, whether or not: an arc may end far from what it was led to.
      if (outside_[part->top] > 0.5 * before) dismiss(part->top);
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
    if (tip.kind != TipKind::kBodyEnd) return try_limb(tip.vertex);
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

  // Of the parts that are limbs, measured beyond the balls, the deepest.
  std::optional<SlenderPart> deepest_part() const {
    std::vector<Index> beyond;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (outside_[v] > 0) beyond.push_back(v);
    const double least = std::max(kLeastProtrusion * options_.smallest, step_);
    const std::vector<SlenderPart> parts = slender_parts(
        surface_, outside_, std::move(beyond), uncovered_slenderness(options_), [&](Index) { return least; });
    const auto deepest =
        std::max_element(parts.begin(), parts.end(), [](const SlenderPart& a, const SlenderPart& b) {
          return a.depth != b.depth ? a.depth < b.depth : a.top > b.top;
        });
    if (deepest == parts.end()) return std::nullopt;
    return *deepest;
  }

  // Its cap and target are as those of limbs, on what hangs together with the top.
  LimbTip new_tip(const SlenderPart& part) const {
    LimbTip tip;
    tip.vertex = part.top;
    tip.position = surface_.position[part.top];
    tip.measures.depth = part.depth;
    tip.measures.half_width = part.radius;
    tip.measures.slenderness = part.slenderness;
    const double cap = std::min(0.5 * part.depth, 1.5 * part.radius), end = std::min(cap, kEnd * part.radius);
    double area = 0;
    std::vector<std::uint8_t> seen(surface_.position.size(), 0);
    tip.cap.assign(1, part.top);
    seen[part.top] = 1;
    for (std::size_t i = 0; i < tip.cap.size(); ++i) {
      const Index v = tip.cap[i];
      if (outside_[part.top] - outside_[v] <= end) {
        tip.target += surface_.vertex_area[v] * surface_.position[v];
        area += surface_.vertex_area[v];
      }
      for_each_neighbour(surface_, v, [&](Index w) {
        if (seen[w] || outside_[part.top] - outside_[w] > cap) return;
        seen[w] = 1;
        tip.cap.push_back(w);
      });
    }
    tip.target /= area;
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
  bool find_way(Index v, GraphPoint& start, std::vector<Vector3>& way) {
    const Vector3& target = surface_.position[v];
    const auto own = [&](Index hub) { return hub_component_[hub] == surface_.component[v]; };
    const auto points =
        nearest_points(graph_, target, own, [&](Index arc) { return own(graph_.arcs[arc].hub[0]); });
    if (points.empty()) return false;
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

  bool try_limb(Index v) {
    GraphPoint start;
    std::vector<Vector3> way;
    if (!find_way(v, start, way)) return false;
    // A few rounds of centring with the start held.
    way = centred_alone(way, solid_, step_);
    if (solid_.segment_crosses(start.position, way.front())) return false;
    way.insert(way.begin(), start.position);
    add(start, way, surface_.component[v]);
    return true;
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
  std::vector<LimbTip>& tips_;
  const LimbOptions& options_;
  double step_;
  InnerGraph& inner_;
  std::vector<Index> hub_component_;
  std::vector<double> outside_;  // per vertex: distance beyond all balls, at most 0 where done with
};

}  // namespace detail

MSPSKEL_INLINE Index complete_limbs(ArcGraph& graph, detail::InnerGraph& inner, std::vector<LimbTip>& tips,
                                    const LimbOptions& options, double step, const Execution& execution) {
  return detail::LimbCompletion(graph, inner, tips, options, step, execution).run();
}

MSPSKEL_INLINE Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                    const BoundingVolumeHierarchy& solid, std::vector<LimbTip>& tips,
                                    const LimbOptions& options, double step) {
  detail::InnerGraph inner(surface, solid);
  return complete_limbs(graph, inner, tips, options, step);
}

}  // namespace mspskel
