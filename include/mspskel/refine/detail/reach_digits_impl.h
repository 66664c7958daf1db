#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/base/linkage.h"
#include "mspskel/base/watch.h"
#include "mspskel/refine/detail/arc_leaves.h"

namespace mspskel {
namespace detail {

// Whether a line turns by less than 45 degrees.
inline bool leads_on(const Vector3& from, const Vector3& by, const Vector3& to) {
  const Vector3 first = by - from, next = to - by;
  return first.dot(next) >= std::sqrt(0.5) * first.norm() * next.norm();
}

class DigitArcs {
 public:
  DigitArcs(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
            const std::vector<Digit>& digits, double step, const ProgressCallback& progress)
      : graph_(graph),
        surface_(surface),
        solid_(solid),
        digits_(digits),
        step_(step),
        watch_(progress, "digits"),
        component_(components_of_pieces(graph, surface)) {}

  Index run() {
    const ArcLeaves leaves(graph_, graph_.incidence());
    const std::vector<std::size_t> leaf = leaves_of_digits(leaves);
    for (std::size_t i = 0; i < digits_.size(); ++i) {
      watch_.ask();
      if (leaf[i] == kNoLeaf) continue;
      lead_on(leaves.leaf[leaf[i]], digits_[i]);
      give_vertices(digits_[i], leaves.leaf[leaf[i]].arc);
    }
    Index added = 0;
    for (std::size_t i = 0; i < digits_.size(); ++i)
      if (leaf[i] == kNoLeaf && add_arc(digits_[i])) ++added;
    return added;
  }

 private:
  // Per digit the leaf arc that ends in it or not far before it, or kNoLeaf; where several could have each
  // other, the nearest do.
  std::vector<std::size_t> leaves_of_digits(const ArcLeaves& leaves) const {
    constexpr double kNear = 1.25;  // lengths of the digit
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < digits_.size(); ++i)
      for (std::size_t k = 0; k < leaves.leaf.size(); ++k) {
        const Index tip = leaves.leaf[k].tip;
        const double distance = (graph_.hub_position[tip] - digits_[i].way.back()).norm();
        if (component_[tip] == component(digits_[i]) && distance < kNear * digits_[i].length)
          pairs.emplace_back(distance, i, k);
      }
    return nearest_pairs(std::move(pairs), digits_.size(), leaves.leaf.size());
  }

  // A leaf arc that ends before the digit's end goes there from the last of its points that allow it.
  void lead_on(const LeafArc& leaf, const Digit& digit) {
    constexpr double kShort = 0.75;  // lengths
    std::vector<Vector3> points = leaf_points(graph_, leaf);
    if ((points.back() - digit.way.back()).norm() < kShort * digit.length) return;
    for (std::size_t i = points.size(); i-- > 0;)
      for (std::size_t k = 0; k < digit.way.size(); ++k) {
        if (!leads_on(points[i], digit.way[k], digit.tip)) continue;
        if (i > 0 && !leads_on(points[i - 1], points[i], digit.way[k])) continue;
        const std::vector<Vector3> line = line_into(digit, k, points[i]);
        if (line.empty()) continue;
        points.resize(i);
        points.insert(points.end(), line.begin(), line.end());
        set_leaf_points(graph_, leaf, std::move(points));
        return;
      }
  }

  bool add_arc(const Digit& digit) {
    // Other digits carry none.
    const auto carries = [&](Index hub) {
      return component_[hub] == component(digit) &&
             std::find(digit_tips_.begin(), digit_tips_.end(), hub) == digit_tips_.end();
    };
    const auto starts = nearest_points(graph_, digit.way.front(), carries,
                                       [&](Index arc) { return carries(graph_.arcs[arc].hub[1]); });
    for (const bool behind : {true, false})
      for (std::size_t k = 0; k < digit.way.size(); ++k)
        for (const auto& [distance, start] : starts) {
          if (behind && !leads_on(start.position, digit.way[k], digit.tip)) continue;
          watch_.ask();
          std::vector<Vector3> line = line_into(digit, k, start.position);
          if (line.empty()) continue;
          // Inside that ball it would be a spur.
          if ((line.back() - start.position).norm() < solid_.distance(start.position)) return false;
          add(digit, start, std::move(line));
          return true;
        }
    return false;
  }

  void add(const Digit& digit, const GraphPoint& start, std::vector<Vector3> line) {
    Arc arc;
    arc.hub = {hub_at(graph_, surface_, start), graph_.add_hub(line.back())};
    component_.resize(graph_.hub_position.size(), component(digit));
    arc.points = std::move(line);
    digit_tips_.push_back(arc.hub[1]);
    give_vertices(digit, graph_.arc_count());
    graph_.arcs.push_back(std::move(arc));
  }

  Index component(const Digit& digit) const { return surface_.component[digit.vertices.front()]; }

  void give_vertices(const Digit& digit, Index arc) {
    for (const Index v : digit.vertices) {
      graph_.arc_of_vertex[v] = arc;
      graph_.hub_of_vertex[v] = kNone;
    }
  }

  // From a point of the skeleton to the digit's end by its way from the given point on; empty where the
  // surface is in between.
  std::vector<Vector3> line_into(const Digit& digit, std::size_t first, const Vector3& from) const {
    if (solid_.segment_crosses(from, digit.way[first])) return {};
    std::vector<Vector3> line{from};
    for (std::size_t k = first; k < digit.way.size(); ++k)
      if (!solid_.segment_crosses(line.back(), digit.way[k])) line.push_back(digit.way[k]);
    if (line.back() != digit.way.back()) return {};
    line = centred_alone(line, solid_, step_);
    // The beginning was centred too. Where it leads back from `from`, the line begins farther on.
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size() / 2 && !leads_on(from, line[begin], line[begin + 1]); ++i)
      if (!solid_.segment_crosses(from, line[i + 1])) begin = i + 1;
    if (solid_.segment_crosses(from, line[begin])) return {};
    line.erase(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(begin));
    line.insert(line.begin(), from);
    return with_round_beginning(line);
  }

  // Rounds the corner between the way through what carries the digit and the digit's own, unless the round
  // line would leave the solid.
  std::vector<Vector3> with_round_beginning(const std::vector<Vector3>& line) const {
    constexpr int kRounds = 12;
    std::vector<Vector3> round = resampled({{0, 1}, line, true}, 0.5 * step_);
    const std::size_t end = 2 * round.size() / 3;
    for (int i = 0; i < kRounds; ++i) {
      const std::vector<Vector3> before = round;
      for (std::size_t k = 1; k < end; ++k)
        round[k] = 0.5 * before[k] + 0.25 * (before[k - 1] + before[k + 1]);
    }
    round = resampled({{0, 1}, round, true}, step_);
    for (std::size_t k = 1; k < round.size(); ++k)
      if (solid_.segment_crosses(round[k - 1], round[k])) return line;
    return round;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const std::vector<Digit>& digits_;
  double step_;
  Watch watch_;
  std::vector<Index> component_;   // of each hub
  std::vector<Index> digit_tips_;  // hubs at the ends of the arcs added
};

}  // namespace detail

MSPSKEL_INLINE Index reach_digits(ArcGraph& graph, const SurfaceSnapshot& surface,
                                  const BoundingVolumeHierarchy& solid, const std::vector<Digit>& digits,
                                  double step, double joint_overlap, const Execution& execution) {
  const Index added = detail::DigitArcs(graph, surface, solid, digits, step, execution.progress).run();
  if (added == 0) return 0;
  merge_joints(graph, solid, joint_overlap);
  const Index spurs = remove_spurs(graph, solid);
  subdivide(graph, 1.25 * step);  // arcs that enter a joint's ball do so on one edge
  return added - spurs;
}

}  // namespace mspskel
