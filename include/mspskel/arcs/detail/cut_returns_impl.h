#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/arcs/cut_returns.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// The detours of one arc.
class ReturnSearch {
 public:
  ReturnSearch(const std::vector<Vector3>& points, const BoundingVolumeHierarchy& solid,
               const CrossingLabels& crossings)
      : points_(points),
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
    for (std::size_t i = 0; i < points_.size(); ++i) {
      line.push_back(points_[i]);
      const std::size_t back = last_return(i);
      if (back == i) continue;
      ++detours;
      i = back - 1;
    }
    return {std::move(line), detours};
  }

 private:
  static constexpr double kDetour = 2;  // times the chord

  double radius(std::size_t i) {
    if (radius_[i] < 0) radius_[i] = solid_.distance(points_[i]);
    return radius_[i];
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
    return !crossings_.goes_round({points_.begin() + static_cast<std::ptrdiff_t>(i),
                                   points_.begin() + static_cast<std::ptrdiff_t>(j) + 1});
  }

  const std::vector<Vector3>& points_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::vector<double> walked_;  // along the arc
  std::vector<double> radius_;  // of the ball at a point; negative where it was not asked for
  double longest_ = 0;          // step
};

}  // namespace detail

MSPSKEL_INLINE Index cut_returns(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                 const Execution& execution, const CrossingLabels& crossings) {
  std::vector<Index> detours(graph.arcs.size(), 0);
  parallel_for(
      graph.arc_count(), "arcs", execution, [] { return 0; },
      [&](Index a, int) {
        Arc& arc = graph.arcs[a];
        if (!arc.alive || arc.points.size() < 3) return;
        auto [line, count] = detail::ReturnSearch(arc.points, solid, crossings).run();
        if (count == 0) return;
        arc.points = std::move(line);
        detours[a] = count;
      },
      1);
  return std::accumulate(detours.begin(), detours.end(), 0);
}

}  // namespace mspskel
