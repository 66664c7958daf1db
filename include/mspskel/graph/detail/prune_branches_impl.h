#pragma once

#include <algorithm>
#include <limits>
#include <queue>

namespace mspskel {
namespace detail {

struct Ball {
  Vector3 centre;
  double radius;
};

// The balls of every arc's points, and of every hub.
struct ArcBalls {
  std::vector<std::vector<Ball>> arc;
  std::vector<Ball> hub;

  ArcBalls(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) : arc(graph.arcs.size()) {
    for (Index h = 0; h < graph.hub_count(); ++h)
      hub.push_back(
          {graph.hub_position[h], graph.hub_alive[h] ? solid.distance(graph.hub_position[h]) : 0.0});
    for (std::size_t a = 0; a < arc.size(); ++a)
      if (graph.arcs[a].alive)
        for (std::size_t i = 1; i + 1 < graph.arcs[a].points.size(); ++i)
          arc[a].push_back({graph.arcs[a].points[i], solid.distance(graph.arcs[a].points[i])});
  }
};

inline double distance_outside(const std::vector<Ball>& balls, const Vector3& x, double stop) {
  double best = std::numeric_limits<double>::infinity();
  for (const Ball& ball : balls) {
    best = std::min(best, (x - ball.centre).norm() - ball.radius);
    if (best < stop) break;
  }
  return best;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Depth over the vertices of the arc and its tip against the balls of all other arcs and of the joint; width
// from the joint's ball and the slices of the vertices nearest to the joint.
inline LeafSignificance leaf_significance(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                          const ArcBalls& balls,
                                          const std::vector<std::vector<Index>>& vertices, Index a,
                                          Index joint, const std::vector<double>& perimeter) {
  LeafSignificance s;
  const Ball& hub = balls.hub[joint];
  std::vector<double> base;
  for (const Index v : vertices[a]) {
    const Vector3& x = surface.position[v];
    double outside = (x - hub.centre).norm() - hub.radius;
    for (std::size_t b = 0; b < balls.arc.size() && outside > s.depth; ++b)
      if (static_cast<Index>(b) != a && graph.arcs[b].alive)
        outside = std::min(outside, distance_outside(balls.arc[b], x, s.depth));
    s.depth = std::max(s.depth, outside);
    if (perimeter[v] > 0) base.push_back(perimeter[v] / (2 * kPi));
  }
  s.width = std::max(1e-12, median(std::move(base)));
  return s;
}

}  // namespace detail

inline Index prune_branches(ArcGraph& graph, const SurfaceSnapshot& surface,
                            const BoundingVolumeHierarchy& solid, const std::vector<double>& perimeter,
                            const PruningOptions& options) {
  validate(options);
  Index removed = 0;
  while (true) {
    dissolve_through_hubs(graph);
    const auto at = graph.incidence();
    const detail::ArcBalls balls(graph, solid);
    std::vector<std::vector<Index>> vertices(graph.arcs.size());
    std::vector<Index> leaf_arc_of_hub(graph.hub_position.size(), kNone);
    std::vector<std::array<Index, 2>> leaves;  // {arc, joint}
    for (Index a = 0; a < graph.arc_count(); ++a) {
      if (!graph.arcs[a].alive) continue;
      for (const int end : {0, 1}) {
        const Index tip = graph.arcs[a].hub[end], joint = graph.arcs[a].hub[1 - end];
        if (at[tip].size() != 1 || at[joint].size() < 3) continue;
        leaves.push_back({a, joint});
        leaf_arc_of_hub[tip] = a;
      }
    }
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      const Index a = graph.arc_of_vertex[v] != kNone   ? graph.arc_of_vertex[v]
                      : graph.hub_of_vertex[v] != kNone ? leaf_arc_of_hub[graph.hub_of_vertex[v]]
                                                        : kNone;
      if (a != kNone) vertices[a].push_back(v);
    }
    // The weakest leaf of each joint goes in one sweep: those of different joints hardly depend on one
    // another.
    std::vector<std::pair<double, Index>> weakest(graph.hub_position.size(), {1.0, kNone});
    for (const auto& [a, joint] : leaves) {
      const LeafSignificance s =
          detail::leaf_significance(graph, surface, balls, vertices, a, joint, perimeter);
      const double need = std::max(options.protrusion * s.width, options.smallest);
      const double score = need > 0 ? s.depth / need : 1.0;
      if (score < weakest[joint].first) weakest[joint] = {score, a};
    }
    Index before = removed;
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (weakest[h].second != kNone) {
        remove_leaf_arc(graph, weakest[h].second, h);
        ++removed;
      }
    if (removed == before) return removed;
  }
}

}  // namespace mspskel
