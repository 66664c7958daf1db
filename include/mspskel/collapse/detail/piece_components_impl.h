#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "mspskel/base/error.h"
#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/homology_generators.h"

namespace mspskel {
namespace detail {

// Finds components for pieces of which nothing is known, one after the other.
class ComponentSearch {
 public:
  ComponentSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& whole,
                  const SolidHierarchies& solids)
      : surface_(surface), whole_(whole), solids_(solids), taken_(surface.component_count, 0) {}

  void take(Index component) {
    if (component != kNone) taken_[static_cast<std::size_t>(component)] = 1;
  }

  // For the piece with these nodes, which takes it.
  Index find(const std::vector<Vector3>& nodes) {
    std::map<Index, Index> held;  // nodes by component
    for (const Vector3& p : nodes)
      for (const Index c : solids_.around(p)) ++held[c];
    Index best = kNone;
    for (const auto& [c, count] : held)
      if (best == kNone || fitness(c, count) < fitness(best, held[best])) best = c;
    if (best == kNone) {
      const Index face = whole_.closest(nodes.front()).face;
      if (face != kNone) best = surface_.component[surface_.origin[3 * face]];
    }
    take(best);
    return best;
  }

 private:
  // Less is better.
  std::tuple<Index, std::uint8_t, double> fitness(Index c, Index count) const {
    return {-count, taken_[static_cast<std::size_t>(c)], std::abs(solids_.components().signed_volume[c])};
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& whole_;
  const SolidHierarchies& solids_;
  std::vector<std::uint8_t> taken_;  // per component: a piece stands for it
};

}  // namespace detail

MSPSKEL_INLINE std::vector<Index> component_of_nodes(const SurfaceSnapshot& surface, Index node_count,
                                                     const std::vector<Index>& node_of_vertex) {
  std::vector<Index> component(node_count, kNone);
  for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
    const Index node = node_of_vertex[v];
    if (node == kNone) continue;
    if (node < 0 || node >= node_count || v >= surface.component.size())
      throw UsageError("the surface map sends vertex " + std::to_string(v) + " to node " +
                       std::to_string(node));
    component[node] = surface.component[v];
  }
  return component;
}

MSPSKEL_INLINE std::vector<Index> pieces_of(const PolylineGraph& graph) {
  detail::generators::UnionFind forest(static_cast<Index>(graph.position.size()));
  for (const auto& [a, b] : graph.edges) {
    const Index u = forest.find(a), v = forest.find(b);
    forest.unite(std::min(u, v), std::max(u, v));
  }
  std::vector<Index> piece(graph.position.size());
  for (std::size_t v = 0; v < piece.size(); ++v) piece[v] = forest.find(static_cast<Index>(v));
  return piece;
}

MSPSKEL_INLINE std::vector<Index> find_components(const SurfaceSnapshot& surface,
                                                  const BoundingVolumeHierarchy& whole,
                                                  const SolidHierarchies& solids, const PolylineGraph& graph,
                                                  const std::vector<Index>& piece) {
  const std::size_t n = piece.size();
  std::vector<Index> component = graph.component, of_piece(n, kNone);
  component.resize(n, kNone);
  detail::ComponentSearch search(surface, whole, solids);
  std::vector<std::vector<Vector3>> nodes(n);  // per piece, at its first node
  for (std::size_t v = 0; v < n; ++v) {
    const auto root = static_cast<std::size_t>(piece[v]);
    nodes[root].push_back(graph.position[v]);
    if (of_piece[root] == kNone) of_piece[root] = component[v];
    search.take(component[v]);
  }
  for (std::size_t v = 0; v < n; ++v) {
    const auto root = static_cast<std::size_t>(piece[v]);
    if (of_piece[root] == kNone) of_piece[root] = surface.component_count == 1 ? 0 : search.find(nodes[root]);
    if (component[v] == kNone) component[v] = of_piece[root];
  }
  return component;
}

}  // namespace mspskel
