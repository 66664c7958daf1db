// Shortest paths through the solid near its middle.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/graph/detail/inward_chord.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The mesh's graph with every vertex moved to the middle of its inward chord. Nothing is computed before
// prepare(), and distances to the surface only where a path comes by: many meshes need no path at all.
class InnerGraph {
 public:
  InnerGraph(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
             const Execution& execution = {})
      : surface_(surface), solid_(solid), execution_(execution) {}

  // Once, before anything else. Cost: two rays a vertex.
  void prepare() {
    if (!clearance_.empty()) return;
    point_ = surface_.position;
    clearance_.assign(surface_.position.size(), 0.0);
    parallel_for(
        surface_.vertex_count(), "arcs", execution_, [] { return 0; }, [&](Index v, int) { place(v); });
  }

  const SurfaceSnapshot& surface() const { return surface_; }
  bool usable(Index v) const { return clearance_[v] != 0; }
  const Vector3& point(Index v) const { return point_[v]; }

  // Among the vertices that `allowed` holds for; kNone if none of them has a point.
  template <class Allowed>
  Index nearest(const Vector3& x, Allowed allowed) const {
    Index best = kNone;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (usable(v) && allowed(v) &&
          (best == kNone || (point_[v] - x).squaredNorm() < (point_[best] - x).squaredNorm()))
        best = v;
    return best;
  }

  // Points strictly between a and b along the cheapest path, or false.
  bool path(const Vector3& a, const Vector3& b, std::vector<Vector3>& between) {
    const Index n = surface_.vertex_count();
    std::vector<Index> from(n, kNone);
    std::vector<std::uint8_t> done(n, 0), goal(n, 0);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const auto& [distance, v] : entries(a)) queue.push({step_cost(distance, clearance(v)), v, kNone});
    for (const auto& [distance, v] : entries(b)) goal[v] = 1;
    while (!queue.empty()) {
      const auto [cost, v, before] = queue.top();
      queue.pop();
      // Whether an edge stays inside is asked where it would be the cheapest way, which few edges are.
      if (done[v] || (before != kNone && solid_.segment_crosses(point_[before], point_[v]))) continue;
      done[v] = 1;
      from[v] = before;
      if (goal[v]) {
        between.clear();
        for (Index w = v; w != kNone; w = from[w]) between.push_back(point_[w]);
        std::reverse(between.begin(), between.end());
        return true;
      }
      const Index first = surface_.vertex_halfedge[v];
      Index h = first;
      do {
        const Index w = surface_.target(h);
        h = surface_.next_outgoing(h);
        if (!usable(w) || done[w]) continue;
        const double length = (point_[w] - point_[v]).norm();
        queue.push({cost + step_cost(length, std::min(clearance(v), clearance(w))), w, v});
      } while (h != first);
    }
    return false;
  }

 private:
  static constexpr double kUnknown = -1.0;

  // Cost of the way to a vertex, the vertex, and the one before it.
  using Entry = std::tuple<double, Index, Index>;

  void place(Index v) {
    if (surface_.vertex_halfedge[v] == kNone) return;
    const auto chord = inward_chord(surface_, solid_, v);
    if (!chord) return;
    point_[v] = chord->start - 0.5 * chord->length * surface_.normal[v];
    clearance_[v] = kUnknown;
  }

  double clearance(Index v) {
    if (clearance_[v] == kUnknown) clearance_[v] = solid_.distance(point_[v]);
    return clearance_[v];
  }

  static double step_cost(double length, double clearance) { return length / std::max(clearance, 1e-6); }

  // The nearest inner points that x sees.
  std::vector<std::pair<double, Index>> entries(const Vector3& x) const {
    constexpr std::size_t kWanted = 8, kTried = 64;
    std::vector<std::pair<double, Index>> all;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (usable(v)) all.push_back({(point_[v] - x).norm(), v});
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kTried));
    std::partial_sort(all.begin(), end, all.end());
    std::vector<std::pair<double, Index>> seen;
    for (auto it = all.begin(); it != end && seen.size() < kWanted; ++it)
      if (!solid_.segment_crosses(x, point_[it->second])) seen.push_back(*it);
    return seen;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const Execution execution_;
  std::vector<Vector3> point_;
  std::vector<double> clearance_;  // 0: no chord
};

}  // namespace detail
}  // namespace mspskel
