#pragma once

#include <algorithm>
#include <limits>
#include <queue>

namespace mspskel {
namespace detail {

// The mesh's graph with every vertex moved to the middle of its inward chord.
class InnerGraph {
 public:
  InnerGraph(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid)
      : surface_(surface), solid_(solid), point_(surface.position), clearance_(surface.position.size(), 0.0) {
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (surface.vertex_halfedge[v] == kNone) continue;
      const Vector3 inward = -surface.normal[v];
      // The start lies off the surface by far less than a chord and far more than rounding.
      Vector3 start = surface.position[v] + 1e-7 * inward;
      // A vertex of a coarser surface may lie outside the solid: the chord starts where the ray enters.
      if (!solid.inside(start)) {
        const auto entry = solid.first_hit(start, inward);
        if (!entry) continue;
        start += (entry->distance + 1e-7) * inward;
      }
      const auto hit = solid.first_hit(start, inward);
      if (!hit || hit->distance <= 0) continue;
      const Vector3 middle = start + 0.5 * hit->distance * inward;
      if (!solid.inside(middle)) continue;
      point_[v] = middle;
      clearance_[v] = solid.distance(middle);
    }
  }

  bool usable(Index v) const { return clearance_[v] > 0; }
  const Vector3& point(Index v) const { return point_[v]; }

  // Of one component's points, or of all if that is kNone.
  Index nearest(const Vector3& x, Index component) const {
    Index best = kNone;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (usable(v) && (component == kNone || surface_.component[v] == component) &&
          (best == kNone || (point_[v] - x).squaredNorm() < (point_[best] - x).squaredNorm()))
        best = v;
    return best;
  }

  // Points strictly between a and b along the cheapest path, or false.
  bool path(const Vector3& a, const Vector3& b, std::vector<Vector3>& between) const {
    const Index n = surface_.vertex_count();
    std::vector<double> cost(n, std::numeric_limits<double>::infinity());
    std::vector<Index> from(n, kNone);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const auto& [distance, v] : entries(a)) {
      cost[v] = step_cost(distance, clearance_[v]);
      queue.push({cost[v], v});
    }
    std::vector<std::uint8_t> goal(n, 0);
    for (const auto& [distance, v] : entries(b)) goal[v] = 1;
    while (!queue.empty()) {
      const auto [c, v] = queue.top();
      queue.pop();
      if (c > cost[v]) continue;
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
        if (!usable(w)) continue;
        const double next =
            c + step_cost((point_[w] - point_[v]).norm(), std::min(clearance_[v], clearance_[w]));
        if (next >= cost[w] || solid_.segment_crosses(point_[v], point_[w])) continue;
        cost[w] = next;
        from[w] = v;
        queue.push({next, w});
      } while (h != first);
    }
    return false;
  }

 private:
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
  std::vector<Vector3> point_;
  std::vector<double> clearance_;
};

inline void route_arc(Arc& arc, const BoundingVolumeHierarchy& solid, const InnerGraph& inner,
                      RoutingResult& result) {
  std::vector<Vector3> kept{arc.points.front()};
  for (std::size_t i = 1; i + 1 < arc.points.size(); ++i)
    if (solid.inside(arc.points[i])) kept.push_back(arc.points[i]);
  kept.push_back(arc.points.back());
  std::vector<Vector3> points{kept.front()}, between;
  for (std::size_t i = 1; i < kept.size(); ++i) {
    if (solid.segment_crosses(points.back(), kept[i])) {
      if (inner.path(points.back(), kept[i], between)) {
        points.insert(points.end(), between.begin(), between.end());
        ++result.routed;
      } else {
        ++result.unroutable;
      }
    }
    points.push_back(kept[i]);
  }
  arc.points = std::move(points);
}

// The component of the surface that each hub stands for; kNone where no vertex maps to it or its arcs.
inline std::vector<Index> hub_components(const ArcGraph& graph, const SurfaceSnapshot& surface) {
  std::vector<Index> component(graph.hub_position.size(), kNone);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (graph.hub_of_vertex[v] != kNone) component[graph.hub_of_vertex[v]] = surface.component[v];
    if (graph.arc_of_vertex[v] == kNone) continue;
    for (const Index h : graph.arcs[graph.arc_of_vertex[v]].hub) component[h] = surface.component[v];
  }
  return component;
}

}  // namespace detail

inline RoutingResult route_inside(ArcGraph& graph, const SurfaceSnapshot& surface,
                                  const BoundingVolumeHierarchy& solid) {
  RoutingResult result;
  std::vector<Index> hubs, arcs;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h] && !solid.inside(graph.hub_position[h])) hubs.push_back(h);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const Arc& arc = graph.arcs[a];
    bool crosses = false;
    for (const Index h : hubs) crosses = crosses || (arc.alive && (arc.hub[0] == h || arc.hub[1] == h));
    for (std::size_t i = 1; i < arc.points.size() && arc.alive && !crosses; ++i)
      crosses = solid.segment_crosses(arc.points[i - 1], arc.points[i]);
    if (crosses) arcs.push_back(a);
  }
  if (hubs.empty() && arcs.empty()) return result;
  const detail::InnerGraph inner(surface, solid);
  const std::vector<Index> component = detail::hub_components(graph, surface);
  for (const Index h : hubs) {
    const Index v = inner.nearest(graph.hub_position[h], component[h]);
    if (v == kNone) continue;
    graph.move_hub(h, inner.point(v));
    ++result.hubs_moved;
  }
  for (const Index a : arcs) detail::route_arc(graph.arcs[a], solid, inner, result);
  return result;
}

}  // namespace mspskel
