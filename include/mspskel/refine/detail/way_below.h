// The way out of a limb that the middles of its chords do not show.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "mspskel/arcs/detail/chord_points.h"

namespace mspskel {
namespace detail {

// Where a limb has few triangles, or hangs on the rest by a pinch, the middles of the chords from its
// vertices do not see each other. Points just below the surface do, along every edge. So each vertex has two
// points, and what leads by those below costs what it is near the surface: no more of it than must be.
class WayBelow {
 public:
  WayBelow(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid)
      : surface_(surface), solid_(solid), points_(surface, solid, no_loops_) {}

  // Points from the first that `arrives` to the one at the tip, by least length / clearance; empty where
  // there are none within `most` points. Cost: what it comes by.
  template <class Arrives>
  std::vector<Vector3> run(Index tip, Index most, Arrives arrives) {
    records_.clear();
    queue_ = {};
    for (const auto layer : {ChordPoints::kMiddle, ChordPoints::kShallow})
      if (points_(tip, layer).clearance > 0) queue_.push({0.0, key(tip, layer), kStart});
    while (!queue_.empty() && most > 0) {
      const auto [cost, at, before] = queue_.top();
      queue_.pop();
      if (records_.count(at) > 0 ||
          (before != kStart && solid_.segment_crosses(point(before).x, point(at).x)))
        continue;
      records_[at] = before;
      --most;
      if (arrives(point(at).x)) return way_to(at);
      expand(at, cost);
    }
    return {};
  }

 private:
  static constexpr std::int64_t kStart = -1;

  static std::int64_t key(Index v, ChordPoints::Layer layer) { return 2 * std::int64_t{v} + layer; }
  const ChordPoints::Point& point(std::int64_t at) {
    return points_(static_cast<Index>(at / 2), static_cast<ChordPoints::Layer>(at % 2));
  }

  void expand(std::int64_t from, double cost) {
    const ChordPoints::Point& here = point(from);
    const auto step = [&](std::int64_t to) {
      if (records_.count(to) > 0) return;
      const ChordPoints::Point& there = point(to);
      const double clearance = std::min(here.clearance, there.clearance);
      if (clearance > 0) queue_.push({cost + (there.x - here.x).norm() / clearance, to, from});
    };
    step(from ^ 1);
    const auto layer = static_cast<ChordPoints::Layer>(from % 2);
    for_each_neighbour(surface_, static_cast<Index>(from / 2), [&](Index w) { step(key(w, layer)); });
  }

  std::vector<Vector3> way_to(std::int64_t last) {
    std::vector<Vector3> way;
    for (std::int64_t at = last; at != kStart; at = records_[at]) way.push_back(point(at).x);
    return way;
  }

  // Cost of the way to a point, its key, and that of the one before it.
  using Entry = std::tuple<double, std::int64_t, std::int64_t>;

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels no_loops_;
  ChordPoints points_;
  std::unordered_map<std::int64_t, std::int64_t> records_;  // the point before each that was reached
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue_;
};

}  // namespace detail
}  // namespace mspskel
