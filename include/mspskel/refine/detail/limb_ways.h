// The way from the skeleton to a limb that no arc comes near.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/refine/detail/way_below.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

// A way to a limb that leads by more vertices is no way into a limb.
inline constexpr Index kMostOfWay = 2000;

// Straight where that is free, else along the middle of the solid, else below the surface.
class LimbWays {
 public:
  // Points of the skeleton, the nearest first, with their distances.
  using NearPoints = std::vector<std::pair<double, GraphPoint>>;

  LimbWays(const ArcGraph& graph, InnerGraph& inner, double step)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        inner_(inner),
        step_(step),
        below_(surface_, solid_) {}

  // The way from the skeleton, of which the points nearest to v are given, to v in steps for a limb of that
  // half width. False where there is none of more than two points.
  bool find(Index v, double half_width, const NearPoints& points, GraphPoint& start,
            std::vector<Vector3>& way) {
    if (points.empty()) return false;
    const double step = step_for_width(half_width, step_);
    if (!find_short_way(v, step, points, start, way) && !find_way_below(v, step, points, start, way))
      return false;
    lead_into_tip(way, surface_.position[v], step, half_width);
    return way.size() > 2;
  }

 private:
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
    std::vector<Vector3> between;
    if (!find_way_through(v, points, start, between)) return false;
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

  // From the middle below v to the skeleton, where that is nearest on the arc that v belongs to or of all.
  // False where that lies across a gap: the way to it through the solid is long, and may come by other arcs.
  bool find_way_through(Index v, const NearPoints& points, GraphPoint& start, std::vector<Vector3>& way) {
    constexpr double kStraight = 2;  // distances
    start = points.front().second;
    if (const Index arc = graph_.arc_of_vertex[v]; arc != kNone && graph_.arcs[arc].alive) {
      const auto on_arc = [&](const auto& p) { return p.second.arc == arc; };
      const auto nearest = std::find_if(points.begin(), points.end(), on_arc);
      if (nearest != points.end()) start = nearest->second;
    }
    const Vector3& from = inner_.point(v);
    // From the limb, which leads to the body by few vertices; from the body all of it comes first.
    return inner_.path(from, start.position, way, kMostOfWay) &&
           length_of(way) <= kStraight * (start.position - from).norm();
  }

  const ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  InnerGraph& inner_;
  double step_;
  WayBelow below_;
};

}  // namespace detail
}  // namespace mspskel
