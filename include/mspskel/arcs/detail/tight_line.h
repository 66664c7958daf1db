// The shortest way between two points in the middle of a wall.
#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

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
    move_inside(points, solid_, goal, crossings_, alone_);
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
    move_inside(points, solid_, goal, crossings_, alone_);
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

  const Execution alone_{1, {}};  // a line is too short for more threads
  const BoundingVolumeHierarchy& solid_;
  const double step_;
  const CrossingLabels& crossings_;
};

// The way through the middle of the wall with a label, from end to end; nothing where none is found.
inline std::optional<std::vector<Vector3>> way_of_class(InnerGraph& inner, const CrossingLabels& crossings,
                                                        const Vector3& from, const Vector3& to,
                                                        const CocycleLabel& label) {
  std::vector<Vector3> between;
  const auto whole = [&] {
    std::vector<Vector3> way{from};
    way.insert(way.end(), between.begin(), between.end());
    way.push_back(to);
    return way;
  };
  inner.prepare();
  // Mostly the shortest way of all is of that class, and it is found without the labels of all others.
  if (!inner.path(from, to, between)) return std::nullopt;
  std::vector<Vector3> way = whole();
  if (crossings.along(way) == label) return way;
  if (!inner.path_of_class(from, to, crossings, label, between)) return std::nullopt;
  return whole();
}

}  // namespace detail
}  // namespace mspskel
