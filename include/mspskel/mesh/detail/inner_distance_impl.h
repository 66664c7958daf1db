#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "mspskel/base/linkage.h"

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

// The way that begins at a half-edge and goes across the edge opposite to its origin.
inline double way_across(const SurfaceSnapshot& surface, Index h) {
  return across_opposite_edge(surface, h, surface.apex(surface.twin[SurfaceSnapshot::next(h)]));
}

// Dijkstra from the given vertices, whose distances are known, over those that are open; edge(h) and
// across(h) are the lengths of the ways that begin at the half-edge h.
template <class Edge, class Across, class Open>
void extend_ways(const SurfaceSnapshot& surface, const Edge& edge, const Across& across, const Open& open,
                 const std::vector<Index>& given, std::vector<double>& distance) {
  using Entry = std::pair<double, Index>;
  std::vector<Entry> queue;
  const auto offer = [&](Index v, double value) {
    if (!open(v) || !(value < distance[v])) return;
    distance[v] = value;
    queue.push_back({value, v});
    std::push_heap(queue.begin(), queue.end(), std::greater<Entry>());
  };
  const auto visit = [&](Index v) {
    const Index first = surface.vertex_halfedge[v];
    if (first == kNone) return;
    Index h = first;
    do {
      offer(surface.target(h), distance[v] + edge(h));
      offer(surface.apex(surface.twin[SurfaceSnapshot::next(h)]), distance[v] + across(h));
      h = surface.next_outgoing(h);
    } while (h != first);
  };
  for (const Index v : given) visit(v);
  while (!queue.empty()) {
    std::pop_heap(queue.begin(), queue.end(), std::greater<Entry>());
    const auto [value, v] = queue.back();
    queue.pop_back();
    if (value == distance[v]) visit(v);
  }
}

// Whether the straight way is free, but for the target's own faces.
inline bool straight_way_is_free(const BoundingVolumeHierarchy& solid, const Vector3& from,
                                 const Vector3& to) {
  constexpr double kShort = 0.995;
  return !solid.segment_crosses(from, from + kShort * (to - from));
}

}  // namespace detail

MSPSKEL_INLINE SurfaceWays::SurfaceWays(const SurfaceSnapshot& surface) : surface_(surface) {
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    edge_.push_back(surface.edge_length(h));
    across_.push_back(detail::way_across(surface, h));
  }
}

MSPSKEL_INLINE void SurfaceWays::extend(const std::vector<std::uint8_t>& fixed,
                                        std::vector<double>& distance) const {
  std::vector<Index> given;
  for (Index v = 0; v < surface_.vertex_count(); ++v)
    if (std::isfinite(distance[v])) given.push_back(v);
  detail::extend_ways(
      surface_, [&](Index h) { return edge_[h]; }, [&](Index h) { return across_[h]; },
      [&](Index v) { return !fixed[v]; }, given, distance);
}

MSPSKEL_INLINE std::vector<double> inner_distances(const SurfaceSnapshot& surface, const SurfaceWays& ways,
                                                   const BoundingVolumeHierarchy& solid,
                                                   const std::vector<std::optional<Vector3>>& from,
                                                   const Execution& execution) {
  std::vector<double> distance(surface.position.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> seen(surface.position.size(), 0);
  parallel_for(
      surface.vertex_count(), "arcs", execution, [] { return 0; },
      [&](Index v, int) {
        if (surface.vertex_halfedge[v] == kNone || !from[surface.component[v]]) return;
        const Vector3& start = *from[surface.component[v]];
        if (!detail::straight_way_is_free(solid, start, surface.position[v])) return;
        distance[v] = (surface.position[v] - start).norm();
        seen[v] = 1;
      });
  ways.extend(seen, distance);
  return distance;
}

MSPSKEL_INLINE void inner_distances(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                    const Vector3& from, const std::vector<Index>& vertices,
                                    std::vector<double>& distance) {
  std::vector<Index> seen;
  for (const Index v : vertices) {
    const bool free = detail::straight_way_is_free(solid, from, surface.position[v]);
    distance[v] = free ? (surface.position[v] - from).norm() : std::numeric_limits<double>::infinity();
    if (free) seen.push_back(v);
  }
  detail::extend_ways(
      surface, [&](Index h) { return surface.edge_length(h); },
      [&](Index h) { return detail::way_across(surface, h); }, [](Index) { return true; }, seen, distance);
}

}  // namespace mspskel
