#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/arc_balls.h"
#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/base/linkage.h"
#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/bare_plates.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/arc_sections.h"
#include "mspskel/refine/detail/equal_limbs.h"
#include "mspskel/refine/detail/limb_ways.h"
#include "mspskel/refine/detail/uncovered_surface.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

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
        watch_(execution.progress, "arcs"),
        execution_(execution),
        ways_(graph, inner, step),
        uncovered_(graph, surface_, all_balls(graph, ArcBalls(graph, solid_, execution)), execution),
        hub_component_(components_of_pieces(graph, surface_)) {}

  Index run() {
    constexpr int kRounds = 8;
    constexpr double kLeft = 0.25;  // of its reach: less is left where another arc stands for the part
    mark_ends();
    Index added = reach_tips();
    added += reach_plates();
    mark_whole_ends();
    for (int round = 0; round < kRounds; ++round) {
      // All are told before any gets its arc, whose balls may come near the others: equal limbs are told
      // alike.
      const std::vector<LimbTip> found = uncovered_limbs();
      if (found.empty()) break;
      std::vector<double> reach;
      for (const LimbTip& tip : found) reach.push_back(uncovered_.distance(tip.vertex));
      for (std::size_t i = 0; i < found.size(); ++i) {
        watch_.ask();
        const Index top = found[i].vertex;
        if (uncovered_.distance(top) < kLeft * reach[i]) continue;
        if (try_limb(top, found[i].measures.half_width)) {
          tips_.push_back(found[i]);
          ++added;
        }
        // Tried once, whether or not: an arc may end far from what it was led to.
        if (uncovered_.distance(top) > 0.5 * reach[i]) uncovered_.dismiss(top);
      }
    }
    return added + reach_equals();
  }

 private:
  // Arcs to the tips that no leaf arc stands for. What goes round a handle has a tip too, but lies within the
  // balls of the loop.
  Index reach_tips() {
    const auto at = graph_.incidence();
    // The deepest first. Of those as deep but for rounding the nearest: ways to what lies beyond it would
    // start at its end, across the gap.
    constexpr double kPerFold = 100;  // depths that differ by less than a hundredth
    std::vector<std::tuple<double, double, Index>> bare;
    const std::vector<std::size_t> leaf = leaves_of_tips(graph_, ArcLeaves(graph_, at), tips_);
    for (std::size_t i = 0; i < tips_.size(); ++i)
      if (leaf[i] == kNoLeaf && tips_[i].kind != TipKind::kWayEnd)
        bare.emplace_back(-std::round(kPerFold * std::log(tips_[i].measures.depth)),
                          uncovered_.distance(tips_[i].vertex), static_cast<Index>(i));
    std::sort(bare.begin(), bare.end());
    Index added = 0;
    for (const auto& [depth, distance, i] : bare)
      if (uncovered_.distance(tips_[i].vertex) > uncovered(tips_[i]) && reach_tip(tips_[i])) ++added;
    return added;
  }

  // Arcs to the plates that none leads into. Where a limb was told before, reach_tips has done what it can.
  Index reach_plates() {
    std::vector<Vector3> points;
    for (Index h = 0; h < graph_.hub_count(); ++h)
      if (graph_.hub_alive[h]) points.push_back(graph_.hub_position[h]);
    for (const Arc& arc : graph_.arcs) points.insert(points.end(), arc.points.begin(), arc.points.end());
    Index added = 0;
    for (const Plate& plate : bare_plates(surface_, solid_, options_, uncovered_.distances(), points,
                                          least_protrusion(), execution_.progress)) {
      const std::vector<Index>& part = plate.limb.part;
      const auto ends_there = [&](const LimbTip& tip) {
        return (tip.kind == TipKind::kLimb || tip.kind == TipKind::kEar) &&
               std::binary_search(part.begin(), part.end(), tip.vertex);
      };
      if (std::any_of(tips_.begin(), tips_.end(), ends_there)) continue;
      LimbTip tip = plate.limb.tip;
      tip.plate = plate.limb.part;
      tip.position = surface_.position[tip.vertex];
      keep_target_well_inside(tip, solid_);
      if (!reach_tip(tip)) continue;
      tips_.push_back(std::move(tip));
      ++added;
    }
    return added;
  }

  // The balls of an arc leave most of a plate or a head uncovered, and what ends there is a corner of it.
  void mark_whole_ends() {
    in_whole_end_.assign(surface_.position.size(), false);
    const std::vector<std::size_t> leaf =
        leaves_of_tips(graph_, ArcLeaves(graph_, graph_.incidence()), tips_);
    for (std::size_t i = 0; i < tips_.size(); ++i) {
      // A head may have the end of an arc that no joint makes a leaf.
      for (const Index v : tips_[i].head) in_whole_end_[v] = true;
      if (leaf[i] == kNoLeaf) continue;
      for (const Index v : tips_[i].plate) in_whole_end_[v] = true;
    }
  }

  // How far the balls stay away from the tip of a limb that has no arc of its own: another one may have led
  // through most of it. The ball in the middle of a tube that was cut off short comes near its end.
  static double uncovered(const LimbTip& tip) {
    const LimbMeasures& m = tip.measures;
    if (tip.flat_end > 0) return 0;
    return tip.kind == TipKind::kBodyEnd ? 0.25 * m.depth : std::min(0.5 * m.depth, m.half_width);
  }

  // The ends of bodies and tubes lie in their middles, so the way to one is straight or none.
  bool reach_tip(const LimbTip& tip) {
    watch_.ask();
    if (tip.kind == TipKind::kBodyEnd || tip.kind == TipKind::kFlatEnd) return reach_straight(tip);
    return (tip.flat_end > 0 && reach_straight(tip)) || try_limb(tip.vertex, tip.measures.half_width);
  }

  bool reach_straight(const LimbTip& tip) {
    const Index component = surface_.component[tip.vertex];
    const auto own = [&](Index hub) { return hub_component_[hub] == component; };
    for (const auto& [distance, point] :
         nearest_points(graph_, tip.target, own, [&](Index arc) { return own(graph_.arcs[arc].hub[0]); })) {
      if (distance < step_) return false;
      if (solid_.segment_crosses(point.position, tip.target)) continue;
      const Index arc = add(point, resampled({{0, 1}, {point.position, tip.target}, true}, step_), component);
      // A ball behind a flat end may touch it in the middle and yet not stand for it.
      if (tip.flat_end > 0)
        for (const Index v : tip.cap) give(v, arc);
      return true;
    }
    return false;
  }

  // What is as a limb that has its arc.
  Index reach_equals() {
    Index added = 0;
    for (const LimbTip& tip :
         equal_limbs(graph_, surface_, solid_, tips_, least_protrusion(), inner_.is_input(), execution_)) {
      if (in_whole_end_[tip.vertex] || uncovered_.distance(tip.vertex) <= uncovered(tip) || !reach_tip(tip))
        continue;
      tips_.push_back(tip);
      ++added;
    }
    return added;
  }

  double least_protrusion() const { return std::max(kLeastProtrusion * options_.smallest, step_); }

  // The level at which a part is a limb: slender by itself and no corner, or a bump that is no wider than
  // what carries it.
  std::optional<PartLevel> limb_level(const SlenderPart& part) {
    const PartLevel& own = part.slenderest;
    if (own.depth > 0 && own.slenderness() >= uncovered_slenderness(own.depth_over_mouth(), options_) &&
        !is_slab_corner(own.depth, own.depth_over_mouth(), own.slenderness(),
                        2 * uncovered_.carrier(part.top), kSlabSlack))
      return own;
    if (const std::optional<PartLevel> twig = twig_level(part)) return twig;
    const PartLevel& level = part.narrowest;
    if (level.depth > 0 && is_bump(level, 2 * kPi * uncovered_.carrier(part.top), options_)) return level;
    return std::nullopt;
  }

  // On an input few triangles are all that there is, so they tell as much as the many of other limbs; on a
  // coarser surface they are what coarsening left. The corner of a slab has a mouth as thin as that but,
  // other than a twig's, about as thick as what is beside it. What lies flat between arcs bulges less than a
  // disc.
  std::optional<PartLevel> twig_level(const SlenderPart& part) {
    constexpr double kThinner = 0.6;
    if (part.slenderest_of_few.depth == 0) return std::nullopt;
    const auto is_corner = [&](const PartLevel& level) {
      const double thickness = level.mouth_thickness();
      return is_slab_corner(level.depth, level.depth_over_mouth(), level.slenderness(), thickness,
                            kSlabSlack) &&
             thickness >= kThinner * uncovered_.thickness_beside(part.top, level, solid_);
    };
    const PartLevel& own = part.slenderest_of_few;
    if (own.slenderness() >= options_.slenderness && own.bulge() >= 1 && !is_corner(own)) return own;
    const PartLevel& level = part.narrowest_of_few;
    if (is_bump(level, 2 * kPi * uncovered_.carrier(part.top), options_) && !is_corner(level)) return level;
    return std::nullopt;
  }

  // The parts that are limbs, measured beyond the balls, and what is as one of them, the deepest first.
  std::vector<LimbTip> uncovered_limbs() {
    const std::vector<SlenderPart> parts = uncovered_.parts(least_protrusion(), inner_.is_input());
    std::vector<std::optional<PartLevel>> levels;
    for (const SlenderPart& part : parts) {
      watch_.ask();
      levels.push_back(limb_level(part));
    }
    const std::vector<bool> limb = equal_answers(
        parts.size(), [&](std::size_t i) { return levels[i].has_value(); },
        [&](std::size_t i, std::size_t j) { return are_alike(uncovered_, parts[i], parts[j]); },
        [&](std::size_t i) { return is_block_corner(parts[i].narrowest.depth_over_mouth()); });
    std::vector<LimbTip> limbs;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (limb[i] && !in_whole_end_[parts[i].top])
        limbs.push_back(uncovered_.limb(parts[i].top, levels[i].value_or(parts[i].slenderest), solid_));
    std::sort(limbs.begin(), limbs.end(), [](const LimbTip& a, const LimbTip& b) {
      return a.measures.depth != b.measures.depth ? a.measures.depth > b.measures.depth : a.vertex < b.vertex;
    });
    return limbs;
  }

  // The points of the skeleton nearest to a vertex, of its component.
  LimbWays::NearPoints own_points(Index v) const {
    const auto own = [&](Index hub) { return hub_component_[hub] == surface_.component[v]; };
    return nearest_points(graph_, surface_.position[v], own,
                          [&](Index arc) { return own(graph_.arcs[arc].hub[0]); });
  }

  // Without those in the ends of other limbs: an arc that began there would take the leaf from its limb. What
  // goes on from the end of a limb's own arc does begin there.
  LimbWays::NearPoints without_ends(LimbWays::NearPoints points, Index v) const {
    const auto ends_other_limb = [&](const std::pair<double, GraphPoint>& near) {
      const GraphPoint& point = near.second;
      const auto is_near = [&](Index hub) {
        return hub < static_cast<Index>(reach_of_end_.size()) && graph_.hub_of_vertex[v] != hub &&
               (point.position - graph_.hub_position[hub]).norm() < reach_of_end_[hub];
      };
      if (point.hub != kNone) return is_near(point.hub);
      const auto& hub = graph_.arcs[point.arc].hub;
      return graph_.arc_of_vertex[v] != point.arc && (is_near(hub[0]) || is_near(hub[1]));
    };
    points.erase(std::remove_if(points.begin(), points.end(), ends_other_limb), points.end());
    return points;
  }

  // How far from each hub a limb ends that was told before and has its leaf arc there.
  void mark_ends() {
    constexpr double kEndOfLimb = 3;  // half widths
    reach_of_end_.assign(graph_.hub_position.size(), 0.0);
    const ArcLeaves leaves(graph_, graph_.incidence());
    const std::vector<std::size_t> leaf = leaves_of_tips(graph_, leaves, tips_);
    for (std::size_t t = 0; t < tips_.size(); ++t)
      if (leaf[t] != kNoLeaf)
        reach_of_end_[leaves.leaf[leaf[t]].tip] = kEndOfLimb * tips_[t].measures.half_width;
  }

  bool try_limb(Index v, double half_width) {
    GraphPoint start;
    std::vector<Vector3> way;
    const LimbWays::NearPoints points = own_points(v);
    if (!ways_.find(v, half_width, without_ends(points, v), start, way) &&
        !ways_.find(v, half_width, points, start, way))
      return false;
    // A few rounds of centring with the start held.
    way = centred_alone(way, solid_, step_);
    if (solid_.segment_crosses(start.position, way.front())) return false;
    way.insert(way.begin(), start.position);
    add(start, way, surface_.component[v]);
    return true;
  }

  // Vertices of other components are none of the limb's business, however near they lie.
  // Returns the arc.
  Index add(const GraphPoint& start, const std::vector<Vector3>& way, Index component) {
    Arc limb;
    limb.hub = {hub_at(graph_, surface_, start), graph_.add_hub(way.back())};
    hub_component_.resize(graph_.hub_position.size(), component);
    limb.points = way;
    const Index added = graph_.arc_count();
    graph_.arcs.push_back(std::move(limb));
    std::vector<Ball> balls;
    for (std::size_t i = 1; i < way.size(); ++i) balls.push_back({way[i], solid_.distance(way[i])});
    uncovered_.cover(BallChain(std::move(balls)), [&](Index v) {
      if (surface_.component[v] == component) give(v, added);
    });
    return added;
  }

  void give(Index v, Index arc) {
    graph_.arc_of_vertex[v] = arc;
    graph_.hub_of_vertex[v] = kNone;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<LimbTip>& tips_;
  const LimbOptions& options_;
  double step_;
  InnerGraph& inner_;
  Watch watch_;
  const Execution& execution_;
  LimbWays ways_;
  UncoveredSurface uncovered_;
  std::vector<bool> in_whole_end_;  // per vertex, of a plate or a head that has its arc
  std::vector<Index> hub_component_;
  std::vector<double> reach_of_end_;  // per hub that was there before
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
