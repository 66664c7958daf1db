#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/arcs/cut_returns.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/route_by_class.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// The detours of one arc.
class ReturnSearch {
 public:
  // `is_leaf`: whether nothing else ends where the points begin, and where they end.
  ReturnSearch(const std::vector<Vector3>& points, const std::array<bool, 2>& is_leaf,
               const BoundingVolumeHierarchy& solid, const CrossingLabels& crossings)
      : points_(points),
        is_leaf_(is_leaf),
        solid_(solid),
        crossings_(crossings),
        walked_(points.size(), 0.0),
        radius_(points.size(), -1.0) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double step = (points[i] - points[i - 1]).norm();
      walked_[i] = walked_[i - 1] + step;
      longest_ = std::max(longest_, step);
    }
  }

  // The arc's points without its detours, and how many these were.
  std::pair<std::vector<Vector3>, Index> run() {
    std::vector<Vector3> line;
    Index detours = 0;
    const std::size_t end = points_.size();
    for (std::size_t i = 0; i < end; ++i) {
      line.push_back(points_[i]);
      const std::size_t back = last_return(i);
      if (back == i) continue;
      ++detours;
      const std::size_t ball = radius(i) >= radius(back) ? i : back;
      const Reach before = reach(ball, 0, i + 1), detour = reach(ball, i, back + 1),
                  after = reach(ball, back, end);
      const auto is_passed = [&](const Reach& by) {
        return detour.beyond > std::max(0.0, by.beyond) + radius(ball);
      };
      const bool begins = is_leaf_[0] && is_passed(before), ends = is_leaf_[1] && is_passed(after);
      if (ends && (!begins || after.beyond <= before.beyond)) {
        append_points(line, points_, i + 1, detour.farthest + 1);
        break;
      }
      if (begins) {
        line.clear();
        i = detour.farthest - 1;
      } else {
        i = back - 1;
      }
    }
    return {std::move(line), detours};
  }

 private:
  static constexpr double kDetour = 2;  // times the chord

  struct Reach {
    double beyond = 0;  // the ball
    std::size_t farthest = 0;
  };

  double radius(std::size_t i) {
    if (radius_[i] < 0) radius_[i] = solid_.distance(points_[i]);
    return radius_[i];
  }

  // How far the points from `first` up to the one before `end` reach beyond the ball at a point.
  Reach reach(std::size_t ball, std::size_t first, std::size_t end) {
    Reach most{-radius(ball), ball};
    for (std::size_t k = first; k < end; ++k) {
      const double beyond = (points_[k] - points_[ball]).norm() - radius(ball);
      if (beyond > most.beyond) most = {beyond, k};
    }
    return most;
  }

  // The last point to which the way from i is a detour; i where there is none.
  std::size_t last_return(std::size_t i) {
    for (std::size_t j = points_.size() - 1; j > i + 1;) {
      const double way = walked_[j] - walked_[i], chord = (points_[j] - points_[i]).norm();
      // A step changes the way by a step and the chord by no more.
      const double lacking = kDetour * chord - way;
      if (lacking >= 0) {
        const auto steps = static_cast<std::size_t>(lacking / ((kDetour + 1) * longest_)) + 1;
        j -= std::min(steps, j - i - 1);
        continue;
      }
      if (is_return(i, j, way, chord)) return j;
      --j;
    }
    return i;
  }

  bool is_return(std::size_t i, std::size_t j, double way, double chord) {
    const double ball = std::max(radius(i), radius(j));
    if (chord >= ball || way <= ball) return false;
    if (round_.first <= i && i < round_.end && round_.back_first <= j && j < round_.back_end) return false;
    std::vector<Vector3> ring;
    append_points(ring, points_, i, j + 1);
    if (!crossings_.goes_round(ring)) return true;
    note_round(i, j);
    return false;
  }

  // The way from i to j goes round a handle. So do all that begin and end in the same two passages of the arc
  // through the ball at i, in which what they differ by can be filled.
  void note_round(std::size_t i, std::size_t j) {
    const auto is_in_ball = [&](std::size_t k) { return (points_[k] - points_[i]).norm() < radius(i); };
    if (!is_in_ball(j)) return;
    round_ = {i, i + 1, j, j + 1};
    while (round_.end < j && is_in_ball(round_.end)) ++round_.end;
    while (round_.back_first > round_.end && is_in_ball(round_.back_first - 1)) --round_.back_first;
    while (round_.back_end < points_.size() && is_in_ball(round_.back_end)) ++round_.back_end;
  }

  const std::vector<Vector3>& points_;
  const std::array<bool, 2> is_leaf_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::vector<double> walked_;  // along the arc
  std::vector<double> radius_;  // of the ball at a point; negative where it was not asked for
  double longest_ = 0;          // step
  // Points from the first ones to the second ones are known to go round a handle.
  struct {
    std::size_t first = 0, end = 0, back_first = 0, back_end = 0;
  } round_;
};

}  // namespace detail

MSPSKEL_INLINE Index cut_returns(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                 const Execution& execution, const CrossingLabels& crossings) {
  std::vector<Index> detours(graph.arcs.size(), 0);
  const std::vector<std::vector<Index>> incidence = graph.incidence();
  const std::vector<bool> is_kept =
      crossings.rank() == 0 ? arcs_of_cycles(graph) : std::vector<bool>(graph.arcs.size(), false);
  parallel_for(
      graph.arc_count(), "arcs", execution, [] { return 0; },
      [&](Index a, int) {
        Arc& arc = graph.arcs[a];
        if (!arc.alive || is_kept[a] || arc.points.size() < 3) return;
        const auto is_leaf = [&](int end) { return incidence[arc.hub[end]].size() == 1; };
        auto [line, count] =
            detail::ReturnSearch(arc.points, {is_leaf(0), is_leaf(1)}, solid, crossings).run();
        if (count == 0) return;
        arc.points = std::move(line);
        detours[a] = count;
      },
      1);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    if (detours[a] == 0) continue;
    const Arc& arc = graph.arcs[a];
    graph.hub_position[arc.hub[0]] = arc.points.front();
    graph.hub_position[arc.hub[1]] = arc.points.back();
  }
  return std::accumulate(detours.begin(), detours.end(), 0);
}

}  // namespace mspskel
