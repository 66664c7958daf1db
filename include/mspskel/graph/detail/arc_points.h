// The points of all arcs under one numbering, and moves of them that stay in the solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/graph/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {
namespace detail {

// All points of an arc graph under one numbering: hubs first, then the inner points of the arcs.
struct ArcPoints {
  enum class Kind : std::uint8_t { kInner, kJoint, kLeaf, kDead };

  std::vector<Vector3> x;
  std::vector<Kind> kind;
  std::vector<std::vector<Index>> next;  // neighbours
  std::vector<std::vector<Index>>
      chains;  // the points of each arc in order, hubs included; empty for dead arcs

  explicit ArcPoints(const ArcGraph& graph) : x(graph.hub_position), chains(graph.arcs.size()) {
    kind.assign(x.size(), Kind::kDead);
    const auto at = graph.incidence();
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h]) kind[h] = at[h].size() == 1 ? Kind::kLeaf : Kind::kJoint;
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const Arc& arc = graph.arcs[a];
      if (!arc.alive) continue;
      chains[a].push_back(arc.hub[0]);
      for (std::size_t i = 1; i + 1 < arc.points.size(); ++i) {
        chains[a].push_back(static_cast<Index>(x.size()));
        x.push_back(arc.points[i]);
        kind.push_back(Kind::kInner);
      }
      chains[a].push_back(arc.hub[1]);
    }
    next.resize(x.size());
    for (const auto& chain : chains)
      for (std::size_t i = 1; i < chain.size(); ++i) {
        next[chain[i]].push_back(chain[i - 1]);
        next[chain[i - 1]].push_back(chain[i]);
      }
  }

  void write_back(ArcGraph& graph) const {
    for (Index h = 0; h < graph.hub_count(); ++h) graph.hub_position[h] = x[h];
    for (std::size_t a = 0; a < chains.size(); ++a)
      for (std::size_t i = 0; i < chains[a].size(); ++i) graph.arcs[a].points[i] = x[chains[a][i]];
  }

  Index count() const { return static_cast<Index>(x.size()); }
};

// The arc at even steps; where a step would cut a corner through the surface or round a handle, the corner
// stays between.
inline std::vector<Vector3> resampled_inside(const Arc& arc, double step,
                                             const BoundingVolumeHierarchy& solid,
                                             const CrossingLabels& crossings) {
  const std::vector<Vector3> even = resampled(arc, step);
  const double share = arc_length(arc) / static_cast<double>(even.size() - 1);
  std::vector<Vector3> points{even.front()}, cut;
  std::size_t corner = 0;
  double walked = 0;  // from the start to the corner
  const auto pass = [&] {
    ++corner;
    walked += (arc.points[corner] - arc.points[corner - 1]).norm();
  };
  for (std::size_t k = 1; k < even.size(); ++k) {
    const double from = share * static_cast<double>(k - 1), to = share * static_cast<double>(k);
    while (corner + 1 < arc.points.size() && walked <= from) pass();
    cut.assign(1, even[k - 1]);
    for (; corner + 1 < arc.points.size() && walked < to; pass()) cut.push_back(arc.points[corner]);
    cut.push_back(even[k]);
    if (solid.segment_crosses(even[k - 1], even[k]) || crossings.goes_round(cut))
      points.insert(points.end(), cut.begin() + 1, cut.end() - 1);
    points.push_back(even[k]);
  }
  return points;
}

// The move of every point towards its goal, shortened until no edge of the graph meets the surface that did
// not before, and none goes round a handle on its way. Each attempt after the first ones stops a point for
// good, so this ends.
inline void move_inside(ArcPoints& points, const BoundingVolumeHierarchy& solid,
                        const std::vector<Vector3>& goal, const CrossingLabels& crossings) {
  std::vector<double> share(points.x.size(), 1.0);
  const auto moved = [&](Index i) -> Vector3 { return points.x[i] + share[i] * (goal[i] - points.x[i]); };
  std::vector<std::array<Index, 2>> edges;
  for (const auto& chain : points.chains)
    for (std::size_t i = 1; i < chain.size(); ++i) edges.push_back({chain[i - 1], chain[i]});
  // How often a point's share was cut: an edge that crossed nothing is asked again if one of its ends' was.
  std::vector<int> cuts(points.x.size(), 0), asked(edges.size(), -1);
  bool changed = true;
  for (int attempt = 0; changed; ++attempt) {
    changed = false;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [a, b] = edges[e];
      if (share[a] == 0 && share[b] == 0) continue;
      if (asked[e] == cuts[a] + cuts[b]) continue;
      asked[e] = cuts[a] + cuts[b];
      if (!solid.segment_crosses(moved(a), moved(b)) &&
          !crossings.goes_round({points.x[a], points.x[b], moved(b), moved(a)}))
        continue;
      for (const Index i : {a, b}) {
        share[i] = attempt < 4 ? 0.5 * share[i] : 0.0;
        ++cuts[i];
      }
      changed = true;
    }
  }
  for (Index i = 0; i < points.count(); ++i) points.x[i] = moved(i);
}

}  // namespace detail
}  // namespace mspskel
