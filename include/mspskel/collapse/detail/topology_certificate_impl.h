#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/complex_topology.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/mesh/self_intersection.h"

namespace mspskel {
namespace detail {

inline void check_graph(const SurfaceSnapshot& surface, const PolylineGraph& graph) {
  const auto n = static_cast<Index>(graph.position.size());
  for (const auto& edge : graph.edges)
    for (const Index v : edge)
      if (v < 0 || v >= n) throw UsageError("an edge of the skeleton names node " + std::to_string(v));
  if (!graph.component.empty() && graph.component.size() != graph.position.size())
    throw UsageError("the skeleton's components must be given for all nodes or none");
  for (const Index c : graph.component)
    if (c < kNone || c >= surface.component_count)
      throw UsageError("a node of the skeleton names component " + std::to_string(c));
}

// Per node the smallest node of its piece.
inline std::vector<Index> pieces(const PolylineGraph& graph) {
  generators::UnionFind forest(static_cast<Index>(graph.position.size()));
  for (const auto& [a, b] : graph.edges) {
    const Index u = forest.find(a), v = forest.find(b);
    forest.unite(std::min(u, v), std::max(u, v));
  }
  std::vector<Index> piece(graph.position.size());
  for (std::size_t v = 0; v < piece.size(); ++v) piece[v] = forest.find(static_cast<Index>(v));
  return piece;
}

struct CycleCrossings {
  Index cycles = 0, rank = 0;
  Index dependent = 0;  // cycles of edges inside the solid, beyond their rank
  bool clear = true;    // false: rounding left a doubt
};

// A piece counts for the cocycles of its own component only: a disc of an outer shell reaches through the
// shells inside it.
inline CycleCrossings cross_cycles_along(const CrossingLabels& crossings, const PolylineGraph& graph,
                                         Index edges_inside, const std::vector<Index>& component) {
  CycleCrossings result;
  LabelledForest above(static_cast<Index>(graph.position.size())), below = above;
  LabelRank rank;
  CocycleLabel loop, check;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto [a, b] = graph.edges[e];
    const Vector3 &p = graph.position[a], &q = graph.position[b];
    const CocycleLabel label = crossings(p, q, result.clear);
    below.join(a, b, crossings.from_below(p, q, result.clear), check);
    if (above.join(a, b, label, loop)) continue;
    ++result.cycles;
    CocycleLabel own;
    for (const auto& [row, value] : loop.entries())
      if (crossings.component(row) == component[a]) own += CocycleLabel::unit(row, value);
    const CocycleLabel doubt = loop - check;
    for (const auto& entry : doubt.entries())
      if (crossings.component(entry.index) == component[a]) result.clear = false;
    rank.insert(own);
    if (static_cast<Index>(e) < edges_inside) result.dependent = result.cycles - rank.rank();
  }
  result.rank = rank.rank();
  return result;
}

// The first `edges_inside` edges of the graph lie inside the solid.
inline CycleCrossings cross_cycles(const VolumeCocycles& cocycles, const PolylineGraph& graph,
                                   Index edges_inside, const std::vector<Index>& component) {
  constexpr int kDirections = 12;
  CycleCrossings result;
  for (int attempt = 0; attempt < kDirections; ++attempt) {
    result = cross_cycles_along(CrossingLabels(cocycles, attempt), graph, edges_inside, component);
    if (result.clear) break;
  }
  return result;
}

// The hierarchy that says what is inside for a component: the whole surface's where no component lies inside
// another (a segment that starts inside one component and meets no surface stays there), else its own.
class SolidHierarchies {
 public:
  SolidHierarchies(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& whole, bool nested)
      : whole_(whole) {
    if (!nested) return;
    for (const ComponentElements& component : component_elements(surface))
      own_.emplace_back(surface, component.faces);
  }
  const BoundingVolumeHierarchy& operator()(Index component) const {
    return own_.empty() || component == kNone ? whole_ : own_[component];
  }

 private:
  const BoundingVolumeHierarchy& whole_;
  std::vector<BoundingVolumeHierarchy> own_;
};

// Per node. Nodes that no vertex maps to have the component of their piece; where nothing is given, a piece
// has the component nearest to its first node: the way there stays inside, if the piece is inside.
inline std::vector<Index> components_of_pieces(const SurfaceSnapshot& surface,
                                               const BoundingVolumeHierarchy& hierarchy,
                                               const PolylineGraph& graph, const std::vector<Index>& piece) {
  std::vector<Index> of_piece(piece.size(), kNone);
  for (std::size_t v = 0; v < graph.component.size(); ++v) {
    Index& known = of_piece[static_cast<std::size_t>(piece[v])];
    if (known == kNone) known = graph.component[v];
  }
  std::vector<Index> component(piece.size(), kNone);
  for (std::size_t v = 0; v < piece.size(); ++v) {
    const auto root = static_cast<std::size_t>(piece[v]);
    if (of_piece[root] == kNone) {
      const Index face = hierarchy.closest(graph.position[root]).face;
      if (face != kNone) of_piece[root] = surface.component[surface.origin[3 * face]];
    }
    const bool given = !graph.component.empty() && graph.component[v] != kNone;
    component[v] = given ? graph.component[v] : of_piece[root];
  }
  return component;
}

// One piece for each component and each piece within one component.
inline bool pieces_match_components(const SurfaceSnapshot& surface, const std::vector<Index>& piece,
                                    const std::vector<Index>& component) {
  std::vector<Index> piece_of(surface.component_count, kNone);
  for (std::size_t v = 0; v < piece.size(); ++v) {
    if (component[v] == kNone) return false;
    Index& p = piece_of[component[v]];
    if (p != kNone && p != piece[v]) return false;
    p = piece[v];
    if (component[v] != component[static_cast<std::size_t>(piece[v])]) return false;
  }
  return std::find(piece_of.begin(), piece_of.end(), kNone) == piece_of.end();
}

// Fills in the certificate's share inside and count of edges not inside. Pieces without edges count by their
// nodes. Returns the graph with the edges first that are inside from end to end.
inline PolylineGraph measure_inside(const SolidHierarchies& solid, const PolylineGraph& graph,
                                    const std::vector<Index>& component, TopologyCertificate& certificate) {
  constexpr int kSamples = 16;  // on an edge that meets the surface
  double total = 0, inside = 0;
  PolylineGraph sorted{graph.position, {}, graph.component};
  std::vector<std::array<Index, 2>> others;
  std::vector<bool> has_edge(graph.position.size(), false);
  for (const auto& [a, b] : graph.edges) {
    has_edge[a] = has_edge[b] = true;
    const BoundingVolumeHierarchy& hierarchy = solid(component[a]);
    const Vector3 &p = graph.position[a], &q = graph.position[b];
    const double length = (q - p).norm();
    total += length;
    if (!hierarchy.segment_crosses(p, q) && hierarchy.inside(p) && hierarchy.inside(q)) {
      inside += length;
      sorted.edges.push_back({a, b});
      continue;
    }
    others.push_back({a, b});
    ++certificate.edges_not_inside;
    for (int k = 0; k < kSamples; ++k) {
      const Vector3 x = p + (k + 0.5) / kSamples * (q - p);
      if (hierarchy.inside(x))
        inside += length / kSamples;
      else if (!certificate.outside_at)
        certificate.outside_at = x;
    }
  }
  bool lone_outside = false;
  for (std::size_t v = 0; v < has_edge.size(); ++v)
    if (!has_edge[v] && !solid(component[v]).inside(graph.position[v])) {
      lone_outside = true;
      if (!certificate.outside_at) certificate.outside_at = graph.position[v];
    }
  if (lone_outside) ++certificate.edges_not_inside;
  certificate.inside = total > 0 ? std::min(1.0, inside / total) : (lone_outside ? 0.0 : 1.0);
  certificate.edges_inside = static_cast<Index>(sorted.edges.size());
  sorted.edges.insert(sorted.edges.end(), others.begin(), others.end());
  return sorted;
}

// What stands in the way of a proof, most serious first; empty if nothing does.
inline std::string obstacle(const TopologyCertificate& certificate, bool clear, bool matched,
                            bool known_shells) {
  if (certificate.self_intersecting) return "the surface intersects itself";
  if (certificate.completions > 0) return "not all cocycles come from the solid";
  if (!known_shells) return "components lie inside others and the map from surface to skeleton is not given";
  if (certificate.edges_not_inside > 0)
    return std::to_string(certificate.edges_not_inside) + " edges are not inside the solid from end to end";
  if (!matched) return "the pieces do not lie one in each component";
  if (!clear) return "rounding hides a linking number";
  return {};
}

// Sets verdict and reason; `obstacle` as above, `dependent` of the cycles as far as they are known.
inline void judge(const std::string& obstacle, Index dependent, TopologyCertificate& c) {
  const auto wrong = [&](const char* what, Index is, Index should_be) {
    c.verdict = TopologyVerdict::kFailed;
    c.reason = what + std::to_string(is) + ", not " + std::to_string(should_be);
  };
  c.verdict = obstacle.empty() ? TopologyVerdict::kProved : TopologyVerdict::kKept;
  c.reason = obstacle;
  const Index cycles = c.total_genus - c.small_handles;
  if (c.b0 != c.components)
    wrong("b0 is ", c.b0, c.components);
  else if (c.b1 != cycles)
    wrong("b1 is ", c.b1, cycles);
  else if (dependent > 0)
    wrong("the cycles cross the discs with rank ", c.crossing_rank, cycles);
}

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

MSPSKEL_INLINE TopologyCertificate certify_topology(const SurfaceSnapshot& surface,
                                                    const VolumeCocycles& cocycles,
                                                    const BoundingVolumeHierarchy& hierarchy,
                                                    const PolylineGraph& graph,
                                                    const CertificateOptions& options) {
  detail::check_graph(surface, graph);
  TopologyCertificate c;
  c.components = surface.component_count;
  if (surface.component_count > 1)  // one alone lies in no other
    for (const ComponentReport& component : report_mesh(surface, hierarchy, {0}).components)
      c.nested_components += component.depth > 0;
  c.self_intersecting = options.self_intersecting ? *options.self_intersecting
                                                  : count_self_intersections(surface, hierarchy, 1) > 0;
  c.genus = cocycles.genus;
  c.total_genus = std::accumulate(c.genus.begin(), c.genus.end(), Index{0});
  c.small_handles = static_cast<Index>(cocycles.small_handles.size());
  c.discs = cocycles.discs;
  c.holed_regions = cocycles.holed_regions;
  c.linking = cocycles.linking;
  c.completions = cocycles.completions;
  c.cocycle_rank = cocycles.rank;

  const std::vector<Index> piece = detail::pieces(graph);
  for (std::size_t v = 0; v < piece.size(); ++v) c.b0 += piece[v] == static_cast<Index>(v);
  const std::vector<Index> component = detail::components_of_pieces(surface, hierarchy, graph, piece);
  const bool nested = c.nested_components > 0, known_shells = !nested || !graph.component.empty();
  const PolylineGraph sorted = detail::measure_inside(
      detail::SolidHierarchies(surface, hierarchy, nested && known_shells), graph, component, c);
  const detail::CycleCrossings crossings = detail::cross_cycles(cocycles, sorted, c.edges_inside, component);
  c.b1 = crossings.cycles;
  c.crossing_rank = crossings.rank;
  const bool matched = detail::pieces_match_components(surface, piece, component);
  // What excuses a proof does not excuse cycles inside the solid that cross the discs with too low a rank. It
  // says nothing where an edge goes outside, past the discs, or if it is not known which component's they
  // are.
  const bool known = known_shells && crossings.clear;
  detail::judge(detail::obstacle(c, crossings.clear, matched, known_shells),
                known ? crossings.dependent - c.completions : 0, c);
  return c;
}

}  // namespace mspskel
