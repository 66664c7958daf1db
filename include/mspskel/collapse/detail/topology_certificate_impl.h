#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/complex_topology.h"
#include "mspskel/collapse/crossing_labels.h"
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

inline void poll(const ProgressCallback& progress, std::size_t done, std::size_t all) {
  if (done % 64 == 0)
    report_progress(progress, "certificate", static_cast<double>(done) / static_cast<double>(all));
}

struct CycleCrossings {
  Index cycles = 0, rank = 0;
  Index dependent = 0;  // cycles of edges inside the solid, beyond their rank
  bool clear = true;    // false: rounding left a doubt
};

// A piece counts for the cocycles of its own component only: a disc of an outer shell reaches through the
// shells inside it.
inline CycleCrossings cross_cycles_along(const CrossingLabels& crossings, const PolylineGraph& graph,
                                         Index edges_inside, const std::vector<Index>& component,
                                         const ProgressCallback& progress) {
  CycleCrossings result;
  std::vector<CocycleLabel> label(graph.edges.size());
  std::vector<std::size_t> order(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    poll(progress, e, graph.edges.size());
    const auto [a, b] = graph.edges[e];
    label[e] = crossings(graph.position[a], graph.position[b], result.clear);
    order[e] = e;
  }
  const auto fewer = [&](std::size_t e, std::size_t f) { return has_fewer_crossings(label[e], label[f]); };
  std::stable_sort(order.begin(), order.begin() + edges_inside, fewer);
  std::stable_sort(order.begin() + edges_inside, order.end(), fewer);
  LabelledForest forest(static_cast<Index>(graph.position.size())), other = forest;
  LabelRank rank;
  CocycleLabel loop, check;
  for (std::size_t i = 0; i < order.size(); ++i) {
    poll(progress, i, order.size());
    const std::size_t e = order[i];
    const auto [a, b] = graph.edges[e];
    other.join(a, b, crossings.by_other_surfaces(graph.position[a], graph.position[b], result.clear), check);
    if (forest.join(a, b, label[e], loop)) continue;
    ++result.cycles;
    CocycleLabel own;
    for (const auto& [row, value] : loop.entries())
      if (crossings.component(row) == component[a]) own += CocycleLabel::unit(row, value);
    const CocycleLabel doubt = loop - check;
    for (const auto& entry : doubt.entries())
      if (crossings.component(entry.index) == component[a]) result.clear = false;
    rank.insert(own);
    if (static_cast<Index>(i) < edges_inside) result.dependent = result.cycles - rank.rank();
  }
  result.rank = rank.rank();
  return result;
}

// The first `edges_inside` edges of the graph lie inside the solid.
inline CycleCrossings cross_cycles(const VolumeCocycles& cocycles, const PolylineGraph& graph,
                                   Index edges_inside, const std::vector<Index>& component,
                                   const ProgressCallback& progress) {
  constexpr int kAttempts = 12;
  CycleCrossings result;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    result = cross_cycles_along(CrossingLabels(cocycles, attempt), graph, edges_inside, component, progress);
    if (result.clear) break;
  }
  return result;
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
                                    const std::vector<Index>& component, const ProgressCallback& progress,
                                    TopologyCertificate& certificate) {
  constexpr int kSamples = 16;  // on an edge that meets the surface
  double total = 0, inside = 0;
  PolylineGraph sorted{graph.position, {}, graph.component};
  std::vector<std::array<Index, 2>> others;
  std::vector<bool> has_edge(graph.position.size(), false);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    poll(progress, e, graph.edges.size());
    const auto [a, b] = graph.edges[e];
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
inline std::string obstacle(const TopologyCertificate& certificate, bool clear, bool matched) {
  if (certificate.self_intersecting) return "the surface intersects itself";
  if (certificate.completions > 0) return "not all cocycles come from the solid";
  if (certificate.edges_not_inside > 0)
    return std::to_string(certificate.edges_not_inside) + " edges are not inside the solid from end to end";
  if (!matched) return "the pieces do not lie one in each component";
  if (!clear) return "rounding hides a linking number";
  return {};
}

// What the certificate says of the surface and its cocycles.
inline TopologyCertificate facts_of(const VolumeCocycles& cocycles) {
  TopologyCertificate c;
  c.genus = cocycles.genus;
  c.total_genus = std::accumulate(c.genus.begin(), c.genus.end(), Index{0});
  c.small_handles = static_cast<Index>(cocycles.small_handles.size());
  c.discs = cocycles.discs;
  c.holed_regions = cocycles.holed_regions;
  c.linking = cocycles.linking;
  c.completions = cocycles.completions;
  c.cocycle_rank = cocycles.rank;
  return c;
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

MSPSKEL_INLINE TopologyCertificate certify_topology(
    const SurfaceSnapshot& surface, const VolumeCocycles& cocycles, const BoundingVolumeHierarchy& hierarchy,
    const PolylineGraph& graph, const CertificateOptions& options, const Execution& execution) {
  return certify_topology(surface, cocycles, SolidHierarchies(surface, hierarchy, execution.progress), graph,
                          options, execution);
}

MSPSKEL_INLINE TopologyCertificate certify_topology(
    const SurfaceSnapshot& surface, const VolumeCocycles& cocycles, const SolidHierarchies& solids,
    const PolylineGraph& graph, const CertificateOptions& options, const Execution& execution) {
  detail::check_graph(surface, graph);
  TopologyCertificate c = detail::facts_of(cocycles);
  c.components = surface.component_count;
  for (const Index around : solids.components().around) c.nested_components += around != kNone;
  c.self_intersecting = options.self_intersecting
                            ? *options.self_intersecting
                            : count_self_intersections(surface, solids.whole(), 1, execution) > 0;
  const std::vector<Index> piece = pieces_of(graph);
  for (std::size_t v = 0; v < piece.size(); ++v) c.b0 += piece[v] == static_cast<Index>(v);
  const std::vector<Index> component = find_components(surface, solids.whole(), solids, graph, piece);
  const PolylineGraph sorted = detail::measure_inside(solids, graph, component, execution.progress, c);
  const detail::CycleCrossings crossings =
      detail::cross_cycles(cocycles, sorted, c.edges_inside, component, execution.progress);
  c.b1 = crossings.cycles;
  c.crossing_rank = crossings.rank;
  c.clear = crossings.clear;
  const bool matched = detail::pieces_match_components(surface, piece, component);
  // What excuses a proof does not excuse cycles inside the solid that cross the discs with too low a rank. It
  // says nothing where an edge goes outside, past the discs.
  detail::judge(detail::obstacle(c, crossings.clear, matched),
                crossings.clear ? crossings.dependent - c.completions : 0, c);
  return c;
}

}  // namespace mspskel
