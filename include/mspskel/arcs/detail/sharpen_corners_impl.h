#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// The corners of one arc.
class CornerSearch {
 public:
  CornerSearch(std::vector<Vector3> points, const BoundingVolumeHierarchy& solid,
               const CrossingLabels& crossings)
      : points_(std::move(points)),
        solid_(solid),
        crossings_(crossings),
        edges_(points_.size() - 1),
        section_(edges_) {
    for (std::size_t k = 0; k < edges_; ++k) spacing_ += (points_[k + 1] - points_[k]).norm();
    spacing_ /= static_cast<double>(edges_);
  }

  // The arc's points with its corners, and how many these are.
  std::pair<std::vector<Vector3>, Index> run() {
    std::vector<Vector3> line;
    Index corners = 0;
    std::size_t done = 0;  // points that the line has
    for (std::size_t k = 1; k + 1 < edges_; ++k) {
      if (!bends(k) || off_centre(k) < kOff) continue;
      const Stretch stretch = stretch_round(k);
      k = stretch.to;
      const std::optional<Vector3> corner = corner_of(stretch);
      if (!corner) continue;
      append_points(line, points_, done, stretch.from + 1);
      append_straight(line, *corner);
      append_straight(line, points_[stretch.to]);
      done = stretch.to + 1;
      ++corners;
    }
    append_points(line, points_, done, points_.size());
    return {std::move(line), corners};
  }

 private:
  static constexpr double kOff = 0.1;    // so far from the middle a way may be better
  static constexpr double kNear = 0.06;  // and up to here it is what the better one begins with

  struct Section {
    double off_centre = 0, clearance = 0;
  };
  struct Stretch {
    std::size_t from, to;  // points
  };
  struct Line {
    Vector3 start = Vector3::Zero(), along = Vector3::Zero();  // a unit vector
    double radius = 0;                                         // the clearance where it starts
  };

  // At the steps of the arc.
  void append_straight(std::vector<Vector3>& line, const Vector3& to) const {
    const Vector3 from = line.back();
    const std::size_t steps = steps_of(from, to);
    for (std::size_t i = 1; i <= steps; ++i)
      line.push_back(from + static_cast<double>(i) / static_cast<double>(steps) * (to - from));
  }
  std::size_t steps_of(const Vector3& from, const Vector3& to) const {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround((to - from).norm() / spacing_)));
  }

  // Whether the arc turns by 20 degrees or more over four radii on both sides of a point.
  bool bends(std::size_t k) {
    constexpr double kReach = 4, kCosine = 0.94;
    constexpr std::size_t kEvery = 4;  // points that get a distance to the surface of their own
    if (k >= next_radius_) {
      radius_ = solid_.distance(points_[k]);
      next_radius_ = k + kEvery;
    }
    const auto reach = static_cast<std::size_t>(
        std::clamp(std::ceil(kReach * radius_ / spacing_), 1.0, static_cast<double>(edges_)));
    const Vector3 before = points_[k] - points_[k - std::min(k, reach)];
    const Vector3 after = points_[std::min(k + reach, edges_)] - points_[k];
    return before.dot(after) < kCosine * before.norm() * after.norm();
  }

  // Of the way from a to b in its middle.
  Section section_between(const Vector3& a, const Vector3& b) const {
    constexpr int kRays = 24;
    const double length = (b - a).norm();
    if (!(length > 0)) return {1.0, 0.0};
    const Vector3 x = 0.5 * (a + b);
    const VisibleSection section = visible_section(solid_, x, (b - a) / length, kRays);
    if (!section.closed || !(section.mean_ray > 0)) return {1.0, 0.0};
    return {0.5 * (section.centre - x).norm() / section.mean_ray, section.clearance};
  }
  const Section& section(std::size_t edge) {
    if (!section_[edge]) section_[edge] = section_between(points_[edge], points_[edge + 1]);
    return *section_[edge];
  }
  double off_centre(std::size_t edge) { return section(edge).off_centre; }

  // The way off the middle that an edge belongs to.
  Stretch stretch_round(std::size_t edge) {
    std::size_t first = edge, last = edge;
    while (first > 0 && off_centre(first - 1) > kNear) --first;
    while (last + 1 < edges_ && off_centre(last + 1) > kNear) ++last;
    return {first, last + 1};
  }

  // The line that the well centred way up to a point leads on along: the way from the arc's start, or that
  // from its end if `back`.
  Line leading_to(std::size_t point, bool back) {
    constexpr double kReach = 2;  // radii
    const auto edge_at = [&](std::size_t at) { return back ? at : at - 1; };
    const std::size_t end = back ? edges_ : 0;
    Line line;
    line.start = points_[point];
    line.radius = section(edge_at(point)).clearance;
    std::size_t at = point;
    for (double walked = 0; at != end && walked < kReach * line.radius; at = back ? at + 1 : at - 1) {
      const std::size_t edge = edge_at(at);
      if (off_centre(edge) > kNear) break;
      walked += (points_[edge + 1] - points_[edge]).norm();
    }
    line.along = (line.start - points_[at]).normalized();
    return line;
  }

  // Where the arc leads on to from both sides, if the way by it is the better one.
  std::optional<Vector3> corner_of(const Stretch& stretch) {
    constexpr double kStraight = 0.9;  // the cosine of 25 degrees
    constexpr double kApart = 0.3;     // radii
    if (stretch.from == 0 || stretch.to == edges_) return std::nullopt;
    const Line before = leading_to(stretch.from, false), behind = leading_to(stretch.to, true);
    const double cosine = before.along.dot(behind.along);
    if (!(std::abs(cosine) <= kStraight)) return std::nullopt;
    const Vector3 between = behind.start - before.start;
    const double fall = 1 - cosine * cosine;
    const double on = (between.dot(before.along) - cosine * between.dot(behind.along)) / fall;
    const double back = (cosine * between.dot(before.along) - between.dot(behind.along)) / fall;
    if (on <= 0 || back <= 0) return std::nullopt;
    const Vector3 first = before.start + on * before.along, second = behind.start + back * behind.along;
    if ((second - first).norm() > kApart * std::min(before.radius, behind.radius)) return std::nullopt;
    const Vector3 corner = 0.5 * (first + second);
    if (!is_better(stretch, corner) || !is_allowed(stretch, corner)) return std::nullopt;
    return corner;
  }

  bool is_better(const Stretch& stretch, const Vector3& corner) {
    constexpr double kGain = 0.75;
    double old_sum = 0, new_sum = 0;
    for (std::size_t k = stretch.from; k < stretch.to; ++k) old_sum += off_centre(k);
    std::size_t steps = 0;
    Vector3 from = points_[stretch.from];
    for (const Vector3& to : {corner, points_[stretch.to]}) {
      const std::size_t count = steps_of(from, to);
      const Vector3 step = (to - from) / static_cast<double>(count);
      for (std::size_t i = 0; i < count; ++i)
        new_sum +=
            section_between(from + static_cast<double>(i) * step, from + static_cast<double>(i + 1) * step)
                .off_centre;
      steps += count;
      from = to;
    }
    const double old_mean = old_sum / static_cast<double>(stretch.to - stretch.from);
    return new_sum < old_sum && new_sum < kGain * old_mean * static_cast<double>(steps);
  }

  bool is_allowed(const Stretch& stretch, const Vector3& corner) const {
    if (solid_.segment_crosses(points_[stretch.from], corner) ||
        solid_.segment_crosses(corner, points_[stretch.to]))
      return false;
    std::vector<Vector3> ring{corner};
    append_points(ring, points_, stretch.from, stretch.to + 1);
    return !crossings_.goes_round(ring);
  }

  const std::vector<Vector3> points_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  const std::size_t edges_;
  std::vector<std::optional<Section>> section_;  // per edge, once it is asked for
  double spacing_ = 0;
  double radius_ = 0;  // about where the search is
  std::size_t next_radius_ = 0;
};

}  // namespace detail

MSPSKEL_INLINE Index sharpen_corners(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                     const Execution& execution, const CrossingLabels& crossings) {
  std::vector<Index> corners(graph.arcs.size(), 0);
  parallel_for(
      graph.arc_count(), "arcs", execution, [] { return 0; },
      [&](Index a, int) {
        Arc& arc = graph.arcs[a];
        if (!arc.alive || arc.points.size() < 4) return;
        std::tie(arc.points, corners[a]) = detail::CornerSearch(arc.points, solid, crossings).run();
      },
      1);
  return std::accumulate(corners.begin(), corners.end(), Index{0});
}

}  // namespace mspskel
