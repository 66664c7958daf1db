#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/end_target.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/arc_sections.h"
#include "mspskel/refine/detail/way_below.h"
#include "mspskel/solid/detail/ball_tree.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

// What no arc comes near and protrudes less is none, in smallest features.
inline constexpr double kLeastProtrusion = 3.5;

// A way to a limb that leads by more vertices is no way into a limb.
inline constexpr Index kMostOfWay = 2000;

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
        inner_(inner),
        below_(surface_, solid_) {
    const ArcBalls balls(graph, solid_, execution);
    const BallTree tree(all_balls(graph, balls));
    outside_.assign(surface_.position.size(), 0.0);
    carrier_ = outside_;
    parallel_for(
        surface_.vertex_count(), "arcs", execution, [] { return 0; },
        [&](Index v, int) {
          if (graph.arc_of_vertex[v] == kNone && graph.hub_of_vertex[v] == kNone) return;
          const BallTree::Nearest nearest = tree.nearest(surface_.position[v]);
          outside_[v] = nearest.distance;
          carrier_[v] = nearest.radius;
        });
    hub_component_ = components_of_pieces(graph, surface_);
  }

  Index run() {
    constexpr int kRounds = 8;
    constexpr double kLeft = 0.25;  // of its reach: less is left where another arc stands for the part
    Index added = reach_tips();
    for (int round = 0; round < kRounds; ++round) {
      // All are told before any gets its arc, whose balls may come near the others: equal limbs are told
      // alike.
      const std::vector<LimbTip> found = uncovered_limbs();
      if (found.empty()) break;
      std::vector<double> reach;
      for (const LimbTip& tip : found) reach.push_back(outside_[tip.vertex]);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Index top = found[i].vertex;
        if (outside_[top] < kLeft * reach[i]) continue;
        if (try_limb(top, found[i].measures.half_width)) {
          tips_.push_back(found[i]);
          ++added;
        }
        // Tried once, whether or not: an arc may end far from what it was led to.
        if (outside_[top] > 0.5 * reach[i]) dismiss(top);
      }
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
      if (outside_[tips_[i].vertex] > uncovered(tips_[i]) && reach_tip(tips_[i])) ++added;
    return added;
  }

  // How far the balls stay away from the tip of a limb that has no arc of its own: another one may have led
  // through most of it.
  static double uncovered(const LimbTip& tip) {
    const LimbMeasures& m = tip.measures;
    return tip.kind == TipKind::kBodyEnd ? 0.25 * m.depth : std::min(0.5 * m.depth, m.half_width);
  }

  // The end of a body lies in its middle, so the way to it is straight or none.
  bool reach_tip(const LimbTip& tip) {
    if (tip.kind != TipKind::kBodyEnd) return try_limb(tip.vertex, tip.measures.half_width);
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

  static constexpr double kSlack = 1.2;  // of the corners of slabs: levels bend round the balls of arcs

  // The level at which a part is a limb: slender by itself and no corner, or a bump that is no wider than
  // what carries it.
  std::optional<PartLevel> limb_level(const SlenderPart& part) const {
    const PartLevel& own = part.slenderest;
    if (own.depth > 0 && own.slenderness() >= uncovered_slenderness(options_) &&
        !is_slab_corner(own.depth, own.depth_over_mouth(), own.slenderness(), 2 * carrier_[part.top], kSlack))
      return own;
    if (const std::optional<PartLevel> twig = twig_level(part)) return twig;
    const PartLevel& level = part.narrowest;
    if (level.depth > 0 && is_bump(level, 2 * kPi * carrier_[part.top], options_)) return level;
    return std::nullopt;
  }

  // On an input few triangles are all that there is, so they tell as much as the many of other limbs; on a
  // coarser surface they are what coarsening left. The corner of a slab has a mouth as thin as that but,
  // other than a twig's, about as thick as what carries it. What lies flat between arcs bulges less than a
  // disc.
  std::optional<PartLevel> twig_level(const SlenderPart& part) const {
    constexpr double kThinner = 0.6;
    if (part.slenderest_of_few.depth == 0) return std::nullopt;
    const auto is_corner = [&](const PartLevel& level) {
      const double thickness = level.mouth_thickness();
      return thickness >= kThinner * 2 * carrier_[part.top] &&
             is_slab_corner(level.depth, level.depth_over_mouth(), level.slenderness(), thickness, kSlack);
    };
    const PartLevel& own = part.slenderest_of_few;
    if (own.slenderness() >= options_.slenderness && own.bulge() >= 1 && !is_corner(own)) return own;
    const PartLevel& level = part.narrowest_of_few;
    if (!is_corner(level) && is_bump(level, 2 * kPi * carrier_[part.top], options_)) return level;
    return std::nullopt;
  }

  // The parts that are limbs, measured beyond the balls, the deepest first.
  std::vector<LimbTip> uncovered_limbs() const {
    std::vector<Index> beyond;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (outside_[v] > 0) beyond.push_back(v);
    // On something thin a twig is told by its own scale, which is that of what carries it.
    const double least = std::max(kLeastProtrusion * options_.smallest, step_);
    const double usual = kLeastProtrusion * LimbOptions().smallest;
    const auto least_depth = [&](Index v) { return least * std::min(1.0, 2 * carrier_[v] / usual); };
    std::vector<LimbTip> limbs;
    for (const SlenderPart& part :
         slender_parts(surface_, outside_, std::move(beyond), least_depth, inner_.is_input()))
      if (const std::optional<PartLevel> level = limb_level(part)) limbs.push_back(new_tip(part.top, *level));
    std::sort(limbs.begin(), limbs.end(), [](const LimbTip& a, const LimbTip& b) {
      return a.measures.depth != b.measures.depth ? a.measures.depth > b.measures.depth : a.vertex < b.vertex;
    });
    return limbs;
  }

  // Its cap and target are as those of limbs, on what hangs together with the top.
  LimbTip new_tip(Index top, const PartLevel& level) const {
    LimbTip tip;
    tip.vertex = top;
    tip.position = surface_.position[top];
    tip.measures.depth = level.depth;
    tip.measures.slenderness = level.slenderness();
    const double radius = level.depth / level.slenderness();
    tip.measures.half_width = radius;
    const double cap = std::min(0.5 * level.depth, kTipCap * radius), end = std::min(cap, kEnd * radius);
    PartShapeSum sum(surface_, outside_, outside_[top] - end);
    std::vector<std::uint8_t> seen(surface_.position.size(), 0);
    tip.cap.assign(1, top);
    seen[top] = 1;
    for (std::size_t i = 0; i < tip.cap.size(); ++i) {
      const Index v = tip.cap[i];
      if (outside_[top] - outside_[v] <= end) sum.add_vertex(v);
      for_each_neighbour(surface_, v, [&](Index w) {
        if (seen[w] || outside_[top] - outside_[w] > cap) return;
        seen[w] = 1;
        tip.cap.push_back(w);
      });
    }
    tip.target = sum.shape(outside_[top]).centre;
    keep_target_well_inside(tip, solid_);
    return tip;
  }

  void cover(const BallChain& balls) {
    for (std::size_t v = 0; v < outside_.size(); ++v)
      balls.find_nearest(surface_.position[v], outside_[v], carrier_[v]);
  }

  // What lies round a vertex whose arc would be insignificant is not tried again.
  void dismiss(Index v) {
    const double reach = outside_[v];
    for (std::size_t w = 0; w < outside_.size(); ++w)
      if ((surface_.position[w] - surface_.position[v]).norm() <= reach) outside_[w] = 0;
  }

  using NearPoints = std::vector<std::pair<double, GraphPoint>>;

  // The points of the skeleton nearest to x, of a vertex's component.
  NearPoints own_points(Index v, const Vector3& x) const {
    const auto own = [&](Index hub) { return hub_component_[hub] == surface_.component[v]; };
    return nearest_points(graph_, x, own, [&](Index arc) { return own(graph_.arcs[arc].hub[0]); });
  }

  // The way from the skeleton to v in steps.
  bool find_way(Index v, double half_width, GraphPoint& start, std::vector<Vector3>& way) {
    const double step = step_for_width(half_width, step_);
    const NearPoints points = own_points(v, surface_.position[v]);
    if (points.empty()) return false;
    if (!find_short_way(v, step, points, start, way) && !find_way_below(v, step, points, start, way))
      return false;
    lead_into_tip(way, surface_.position[v], step, half_width);
    return way.size() > 2;
  }

  bool reaches(const std::vector<Vector3>& way, const Vector3& target, double step) const {
    return (way.back() - target).norm() <= 2 * std::max(step, solid_.distance(way.back()));
  }

  // Where a limb is thinner than steps are long, they end far from its tip, though that is in sight.
  void lead_into_tip(std::vector<Vector3>& way, const Vector3& target, double step, double half_width) const {
    const Vector3 left = target - way.back();
    const double length = left.norm();
    if (length <= half_width || reaches(way, target, std::min(step, half_width)) ||
        solid_.segment_crosses(way.back(), way.back() + 0.98 * left))
      return;
    Arc straight;
    straight.points = {way.back(), target - half_width / length * left};
    const std::vector<Vector3> points = resampled(straight, step);
    way.insert(way.end(), points.begin() + 1, points.end());
  }

  // For a limb of so few triangles that no path leads out of it, or behind a pinch.
  bool find_way_below(Index v, double step, const NearPoints& points, GraphPoint& start,
                      std::vector<Vector3>& way) {
    constexpr std::size_t kTried = 8;
    const auto sees_skeleton = [&](const Vector3& x) {
      NearPoints near = points;
      for (auto& [distance, point] : near) distance = (point.position - x).norm();
      const auto end = near.begin() + static_cast<std::ptrdiff_t>(std::min(kTried, near.size()));
      std::partial_sort(near.begin(), end, near.end(),
                        [](const auto& a, const auto& b) { return a.first < b.first; });
      const auto seen = std::find_if(near.begin(), end, [&](const auto& at) {
        return !solid_.segment_crosses(at.second.position, x) && solid_.inside(at.second.position);
      });
      if (seen == end) return false;
      start = seen->second;
      return true;
    };
    Arc line;
    line.points = below_.run(v, kMostOfWay, sees_skeleton);
    if (line.points.empty()) return false;
    line.points.insert(line.points.begin(), start.position);
    way = resampled_inside(line, step, solid_, {});
    lead_towards(way, surface_.position[v], solid_, step);
    return true;
  }

  // Straight from the nearest point that sees v, or through the solid.
  bool find_short_way(Index v, double step, const NearPoints& points, GraphPoint& start,
                      std::vector<Vector3>& way) {
    const Vector3& target = surface_.position[v];
    for (const auto& [distance, point] : points) {
      const Vector3& x = point.position;
      // From outside, where the skeleton could not be led inside, the surface is in sight as well.
      if (solid_.segment_crosses(x, x + 0.98 * (target - x)) || !solid_.inside(x)) continue;
      start = point;
      way.assign(1, x);
      lead_towards(way, target, solid_, step);
      // Along a thin limb the straight way may graze the surface.
      if (!reaches(way, target, step)) break;
      return way.size() > 2;
    }
    inner_.prepare();
    if (!inner_.usable(v) || !solid_.inside(inner_.point(v))) return false;
    start = points.front().second;
    // What is nearest across a gap is far through the solid.
    if (const Index arc = graph_.arc_of_vertex[v]; arc != kNone && graph_.arcs[arc].alive) {
      const auto on_arc = [&](const auto& p) { return p.second.arc == arc; };
      const auto nearest = std::find_if(points.begin(), points.end(), on_arc);
      if (nearest != points.end()) start = nearest->second;
    }
    std::vector<Vector3> between;
    // From the limb, which leads to the body by few vertices; from the body all of it comes first.
    if (!inner_.path(inner_.point(v), start.position, between, kMostOfWay)) return false;
    std::reverse(between.begin(), between.end());
    way.assign(1, start.position);
    way.insert(way.end(), between.begin(), between.end());
    const std::size_t inside = way.size();
    lead_towards(way, target, solid_, step);
    if (!reaches(way, target, step)) {  // the target's own chord leads there for certain
      way.resize(inside);
      way.push_back(inner_.point(v));
      lead_towards(way, target, solid_, step);
    }
    return way.size() > 2;
  }

  bool try_limb(Index v, double half_width) {
    GraphPoint start;
    std::vector<Vector3> way;
    if (!find_way(v, half_width, start, way)) return false;
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
  WayBelow below_;
  std::vector<Index> hub_component_;
  std::vector<double> outside_;  // per vertex: distance beyond all balls, at most 0 where done with
  std::vector<double> carrier_;  // per vertex: radius of the ball that it is least beyond
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
