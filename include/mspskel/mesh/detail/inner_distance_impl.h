#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace mspskel {
namespace detail {

// The straight way from the origin of h to the vertex across the edge opposite to it, in the plane into which
// the two faces unfold; infinity where that way leaves them.
inline double across_opposite_edge(const SurfaceSnapshot& surface, Index h, Index across) {
  const Vector3& a = surface.position[surface.target(h)];
  const Vector3 v = surface.position[surface.origin[h]] - a, z = surface.position[across] - a;
  Vector3 along = surface.position[surface.apex(h)] - a;
  const double length = along.norm();
  if (length == 0) return std::numeric_limits<double>::infinity();
  along /= length;
  const double v_along = v.dot(along), z_along = z.dot(along);
  const double v_off = (v - v_along * along).norm(), z_off = (z - z_along * along).norm();
  const double at = v_along * z_off + z_along * v_off, whole = v_off + z_off;
  if (!(at > 0 && at < length * whole)) return std::numeric_limits<double>::infinity();
  return std::hypot(z_along - v_along, whole);
}

}  // namespace detail

inline SurfaceWays::SurfaceWays(const SurfaceSnapshot& surface) : surface_(surface) {
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    edge_.push_back((surface.position[surface.target(h)] - surface.position[surface.origin[h]]).norm());
    const Index opposite = surface.twin[SurfaceSnapshot::next(h)];
    across_.push_back(detail::across_opposite_edge(surface, h, surface.apex(opposite)));
  }
}

inline void SurfaceWays::extend(const std::vector<std::uint8_t>& fixed, std::vector<double>& distance) const {
  using Entry = std::pair<double, Index>;
  std::vector<Entry> queue;
  const auto offer = [&](Index v, double value) {
    if (fixed[v] || !(value < distance[v])) return;
    distance[v] = value;
    queue.push_back({value, v});
    std::push_heap(queue.begin(), queue.end(), std::greater<Entry>());
  };
  const auto visit = [&](Index v) {
    const Index first = surface_.vertex_halfedge[v];
    if (first == kNone) return;
    Index h = first;
    do {
      offer(surface_.target(h), distance[v] + edge_[h]);
      offer(surface_.apex(surface_.twin[SurfaceSnapshot::next(h)]), distance[v] + across_[h]);
      h = surface_.next_outgoing(h);
    } while (h != first);
  };
  std::vector<Index> given;
  for (Index v = 0; v < surface_.vertex_count(); ++v)
    if (std::isfinite(distance[v])) given.push_back(v);
  for (const Index v : given) visit(v);
  while (!queue.empty()) {
    std::pop_heap(queue.begin(), queue.end(), std::greater<Entry>());
    const auto [value, v] = queue.back();
    queue.pop_back();
    if (value == distance[v]) visit(v);
  }
}

inline std::vector<double> inner_distances(const SurfaceSnapshot& surface, const SurfaceWays& ways,
                                           const BoundingVolumeHierarchy& solid,
                                           const std::vector<std::optional<Vector3>>& from,
                                           const Execution& execution) {
  constexpr double kShort = 0.995;  // a vertex's own faces are no obstacle
  std::vector<double> distance(surface.position.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> seen(surface.position.size(), 0);
  parallel_for(
      surface.vertex_count(), "arcs", execution, [] { return 0; },
      [&](Index v, int) {
        if (surface.vertex_halfedge[v] == kNone || !from[surface.component[v]]) return;
        const Vector3& start = *from[surface.component[v]];
        const Vector3 way = surface.position[v] - start;
        if (solid.segment_crosses(start, start + kShort * way)) return;
        distance[v] = way.norm();
        seen[v] = 1;
      });
  ways.extend(seen, distance);
  return distance;
}

}  // namespace mspskel
