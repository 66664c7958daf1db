#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/arcs/route_inside.h"
#include "mspskel/base/linkage.h"
#include "mspskel/base/value_at_rank.h"
#include "mspskel/solid/detail/axis_stretch.h"

namespace mspskel {
namespace detail {

// Which points of a polyline lie in tubes: where sections are round for some widths on end. Such a stretch
// counts less one radius at either end, where the tube widens into the wall.
inline std::vector<std::uint8_t> in_tubes(const std::vector<Vector3>& points,
                                          const BoundingVolumeHierarchy& solid) {
  constexpr double kTube = 0.45;   // roundness of a tube's section
  constexpr double kLength = 3.0;  // of a tube, in radii of its sections
  const std::size_t n = points.size();
  std::vector<std::uint8_t> inside(n, 0);
  std::vector<double> radius(n, 0.0), walked(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) walked[i] = walked[i - 1] + (points[i] - points[i - 1]).norm();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 along = points[std::min(i + 2, n - 1)] - points[i > 2 ? i - 2 : 0];
    if (along.norm() == 0) continue;
    const VisibleSection section =
        visible_section(solid, points[i], along.normalized(), CenteringOptions().rays);
    if (section.closed && section.roundness >= kTube) radius[i] = section.radius;
  }
  for (std::size_t begin = 0; begin < n; ++begin) {
    if (radius[begin] == 0) continue;
    std::size_t end = begin;
    while (end + 1 < n && radius[end + 1] > 0) ++end;
    std::vector<double> radii(radius.begin() + static_cast<std::ptrdiff_t>(begin),
                              radius.begin() + static_cast<std::ptrdiff_t>(end + 1));
    const double width = value_at_rank(std::move(radii), 0.5);
    if (walked[end] - walked[begin] >= kLength * width)
      for (std::size_t i = begin; i <= end; ++i)
        inside[i] = walked[i] - walked[begin] >= width && walked[end] - walked[i] >= width;
    begin = end;
  }
  return inside;
}

// The polyline without the ways out and back that a straight stretch of at most `reach` points saves.
inline std::vector<Vector3> cut_short(const std::vector<Vector3>& points,
                                      const BoundingVolumeHierarchy& solid, std::size_t reach,
                                      const CrossingLabels& crossings) {
  const auto saves = [&](std::size_t from, std::size_t to) {
    return !solid.segment_crosses(points[from], points[to]) &&
           !crossings.goes_round({points.begin() + static_cast<std::ptrdiff_t>(from),
                                  points.begin() + static_cast<std::ptrdiff_t>(to) + 1});
  };
  std::vector<Vector3> kept{points.front()};
  for (std::size_t i = 0; i + 1 < points.size();) {
    std::size_t next = std::min(i + reach, points.size() - 1);
    while (next > i + 1 && !saves(i, next)) --next;
    kept.push_back(points[next]);
    i = next;
  }
  return kept;
}

// Draws a polyline in a wall tight between its ends, which stay.
class TightLine {
 public:
  TightLine(const BoundingVolumeHierarchy& solid, double step, const CrossingLabels& crossings)
      : solid_(solid), step_(step), crossings_(crossings) {}

  std::vector<Vector3> tighten(std::vector<Vector3> points) const {
    for (const double step : {4 * step_, step_}) {  // few points go far, many follow the wall
      constexpr int kPasses = 12, kRounds = 10;
      constexpr double kReach = 0.1;     // of a cut
      constexpr double kSettled = 0.02;  // steps
      const auto reach = static_cast<std::size_t>(std::max(2.0, kReach / step));
      for (int pass = 0; pass < kPasses; ++pass) {
        ArcGraph line;
        Arc arc;
        arc.points = cut_short(points, solid_, reach, crossings_);
        arc.points = resampled_inside(arc, step, solid_, crossings_);
        if (arc.points.size() < 3) break;
        arc.hub = {line.add_hub(arc.points.front()), line.add_hub(arc.points.back())};
        line.arcs.push_back(std::move(arc));
        ArcPoints moving(line);
        double longest = 0;
        for (int round = 0; round < kRounds; ++round) longest = draw(moving);
        moving.write_back(line);
        points = line.arcs.front().points;
        if (longest < kSettled * step_) break;
      }
    }
    return points;
  }

 private:
  // One round: a step of the heat flow, and back to the middle of the wall. The longest move.
  double draw(ArcPoints& points) const {
    // Steps follow a wall's curve, and its middle is smooth where its sides are rough.
    constexpr double kTime = 16, kOffsetTime = 8;
    constexpr double kReach = 0.5;  // of a step, in thicknesses of the wall
    const std::vector<Vector3> before = points.x;
    std::vector<Vector3> goal = diffused(points, points.x, kTime);
    for (std::size_t i = 0; i < goal.size(); ++i) {
      const Vector3 way = goal[i] - before[i];
      const double reach = kReach * 2 * solid_.distance(before[i]), length = way.norm();
      if (length > reach) goal[i] = before[i] + reach / length * way;
    }
    move_inside(points, solid_, goal, crossings_);
    std::vector<Vector3> offset(points.x.size(), Vector3::Zero());
    for (std::size_t i = 2; i < offset.size(); ++i) {  // the two hubs come first
      const Vector3& x = points.x[i];
      const ClosestPoint nearest = solid_.closest(x);
      if (!(nearest.distance > 0)) continue;
      const Vector3 across = (x - nearest.point) / nearest.distance;
      const auto far = solid_.first_hit(x, across);
      if (far) offset[i] = std::min(nearest.distance, 0.5 * (far->distance - nearest.distance)) * across;
    }
    offset = diffused(points, offset, kOffsetTime);
    for (std::size_t i = 0; i < goal.size(); ++i) goal[i] = points.x[i] + offset[i];
    move_inside(points, solid_, goal, crossings_);
    double longest = 0;
    for (std::size_t i = 0; i < goal.size(); ++i)
      longest = std::max(longest, (points.x[i] - before[i]).norm());
    return longest;
  }

  // Values at the points after a time of heat flow, by one backward Euler step; time is in squares of the
  // points' distance. The ends keep theirs.
  static std::vector<Vector3> diffused(const ArcPoints& points, const std::vector<Vector3>& value,
                                       double time) {
    const std::vector<Index>& chain = points.chains.front();
    const Index n = static_cast<Index>(chain.size()) - 2;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right(n, 3);
    for (Index r = 0; r < n; ++r) {
      entries.emplace_back(r, r, 1 + 2 * time);
      if (r > 0) entries.emplace_back(r, r - 1, -time);
      right.row(r) = value[chain[r + 1]].transpose();
    }
    right.row(0) += time * value[chain.front()].transpose();
    right.row(n - 1) += time * value[chain.back()].transpose();
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
        solver(matrix);
    const Eigen::MatrixX3d solution = solver.solve(right);
    std::vector<Vector3> x(value);
    for (Index r = 0; r < n; ++r) x[chain[r + 1]] = solution.row(r).transpose();
    return x;
  }

  const BoundingVolumeHierarchy& solid_;
  const double step_;
  const CrossingLabels& crossings_;
};

// Lets a loop begin in the middle of its longest tube; false if it has none.
inline bool begin_in_tube(ArcGraph& graph, Index arc, const BoundingVolumeHierarchy& solid) {
  std::vector<Vector3>& points = graph.arcs[arc].points;
  points.pop_back();  // once in the ring
  const std::size_t n = points.size();
  std::vector<Vector3> twice(points);
  twice.insert(twice.end(), points.begin(), points.end());
  const std::vector<std::uint8_t> tube = in_tubes(twice, solid);
  std::size_t longest = 0, middle = 0;
  for (std::size_t i = 0, length = 0; i < tube.size(); ++i) {
    length = tube[i] ? length + 1 : 0;
    if (length > longest) {
      longest = length;
      middle = i - length / 2;
    }
  }
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle % n), points.end());
  points.push_back(points.front());
  graph.hub_position[graph.arcs[arc].hub[0]] = points.front();
  return longest > 0;
}

// The arcs of shells, one after the other.
class WallArcs {
 public:
  WallArcs(ArcGraph& graph, InnerGraph& inner, const std::vector<bool>& shells, double step,
           const CrossingLabels& crossings)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        shells_(shells),
        inner_(inner),
        crossings_(crossings),
        line_(solid_, step, crossings),
        step_(step),
        component_(hub_components(graph, surface_)),
        ends_(shells.size()),
        has_leaf_(shells.size(), false) {}

  Index run() {
    const auto at = graph_.incidence();
    Index drawn = 0;
    for (Index a = 0; a < graph_.arc_count(); ++a) {
      Arc& arc = graph_.arcs[a];
      const Index c = arc.alive ? component_[arc.hub[0]] : kNone;
      if (c == kNone || !shells_[c]) continue;
      for (const Index hub : arc.hub) has_leaf_[c] = has_leaf_[c] || at[hub].size() == 1;
      arc.points = resampled_inside(arc, step_, solid_, crossings_);
      const bool ring = arc.hub[0] == arc.hub[1] && at[arc.hub[0]].size() == 2;
      if (ring && !begin_in_tube(graph_, a, solid_)) continue;
      tighten(a, c);
      ++drawn;
    }
    const std::vector<SolidMoments> moments = solid_moments(surface_);
    for (std::size_t c = 0; c < shells_.size(); ++c)
      if (shells_[c] && !has_leaf_[c] && !ends_[c].empty() && add_floor(moments[c], ends_[c])) ++drawn;
    dissolve_through_hubs(graph_);
    return drawn;
  }

 private:
  struct TubeEnd {
    Index arc;
    std::size_t point;
  };

  void tighten(Index arc, Index component) {
    std::vector<Vector3>& points = graph_.arcs[arc].points;
    const std::vector<std::uint8_t> tube = in_tubes(points, solid_);
    std::vector<Vector3> tight{points.front()};
    for (std::size_t i = 0; i + 1 < points.size();) {
      std::size_t end = i + 1;
      while (end + 1 < points.size() && !tube[end]) ++end;
      std::vector<Vector3> stretch(points.begin() + static_cast<std::ptrdiff_t>(i),
                                   points.begin() + static_cast<std::ptrdiff_t>(end + 1));
      if (end > i + 1) {
        stretch = shortest(std::move(stretch));
        if (tube[i] && i > 0) ends_[component].push_back({arc, tight.size() - 1});
        if (tube[end] && end + 1 < points.size())
          ends_[component].push_back({arc, tight.size() + stretch.size() - 2});
      }
      tight.insert(tight.end(), stretch.begin() + 1, stretch.end());
      i = end;
    }
    points = std::move(tight);
  }

  // Heat flow stops at the nearest of the ways that no small move makes shorter: round the wall, say, where
  // down is nearer. So the shortest way in the middle of the wall is tried as well.
  std::vector<Vector3> shortest(std::vector<Vector3> stretch) {
    const Vector3 from = stretch.front(), to = stretch.back();
    const CocycleLabel label = crossings_.along(stretch);
    std::vector<Vector3> tight = line_.tighten(std::move(stretch)), way{from}, between;
    inner_.prepare();
    if (!inner_.path_of_class(from, to, crossings_, label, between)) return tight;
    way.insert(way.end(), between.begin(), between.end());
    way.push_back(to);
    way = line_.tighten(std::move(way));
    return length_of(way) + step_ < length_of(tight) ? way : tight;
  }

  static double length_of(const std::vector<Vector3>& points) {
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length;
  }

  bool add_floor(const SolidMoments& moments, const std::vector<TubeEnd>& ends) {
    const auto stretch = axis_stretch(moments, solid_);
    if (!stretch) return false;
    const Vector3 floor = ((*stretch)[0] + (*stretch)[1]) / 2;
    inner_.prepare();
    Arc best;
    TubeEnd from{kNone, 0};
    for (const TubeEnd& end : ends) {
      Arc way;
      way.points.push_back(graph_.arcs[end.arc].points[end.point]);
      std::vector<Vector3> between;
      if (!inner_.path(way.points.front(), floor, between)) continue;
      way.points.insert(way.points.end(), between.begin(), between.end());
      way.points.push_back(floor);
      if (from.arc != kNone && arc_length(way) >= arc_length(best)) continue;
      best = std::move(way);
      from = end;
    }
    if (from.arc == kNone) return false;
    best.points = line_.tighten(std::move(best.points));
    if (arc_length(best) <= solid_.distance(best.points.front())) return false;
    const Index parts = graph_.arc_count();
    best.hub = {split_arc(graph_, from.arc, from.point), graph_.add_hub(floor)};
    give_near_vertices(graph_, surface_, from.arc, parts);
    graph_.arcs.push_back(std::move(best));
    for (const Index a : {from.arc, parts}) give_near_vertices(graph_, surface_, a, graph_.arc_count() - 1);
    return true;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const std::vector<bool>& shells_;
  InnerGraph& inner_;
  const CrossingLabels& crossings_;
  const TightLine line_;
  const double step_;
  const std::vector<Index> component_;      // of each hub
  std::vector<std::vector<TubeEnd>> ends_;  // where tubes open into walls, per component
  std::vector<bool> has_leaf_;              // per component
};

}  // namespace detail

MSPSKEL_INLINE Index tighten_in_walls(ArcGraph& graph, detail::InnerGraph& inner,
                                      const std::vector<bool>& shells, double step,
                                      const CrossingLabels& crossings) {
  if (std::find(shells.begin(), shells.end(), true) == shells.end()) return 0;
  return detail::WallArcs(graph, inner, shells, step, crossings).run();
}

}  // namespace mspskel
