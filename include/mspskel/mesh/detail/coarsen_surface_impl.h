#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "mspskel/base/clones.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/collapsing_surface.h"

namespace mspskel {

MSPSKEL_INLINE void validate(const CoarseningOptions& o) {
  if (o.vertices < 4) throw UsageError("coarsening vertices must be at least 4");
  if (o.component_vertices < 4) throw UsageError("coarsening component_vertices must be at least 4");
  if (!(o.spread >= 1e-6 && o.spread <= 1)) throw UsageError("coarsening spread must be from 1e-6 to 1");
  if (!(o.most_turn > 0 && o.most_turn <= 90))
    throw UsageError("coarsening most_turn must be above 0 and at most 90 degrees");
  if (!(o.most_dihedral > 0 && o.most_dihedral <= 180))
    throw UsageError("coarsening most_dihedral must be above 0 and at most 180 degrees");
  if (!(o.least_shape >= 0 && o.least_shape < 1))
    throw UsageError("coarsening least_shape must be at least 0 and below 1");
  if (o.most_valence < 6 || o.most_valence > 32)
    throw UsageError("coarsening most_valence must be from 6 to 32");
}

namespace detail {

using CostedEdge = std::pair<double, Index>;

// The cheapest share of the edges that are not blocked, in the order of their cost.
MSPSKEL_AVX_CLONES inline void cheapest_edges(CollapsingSurface& mesh, Index target,
                                              std::vector<CostedEdge>& edges) {
  // More passes follow the costs more closely, which matters little far from the target.
  const double of_edges = mesh.vertex_count() > 8.0 * target ? 0.3 : 0.15;
  constexpr std::size_t kLeast = 64;  // so that the last few take no pass each
  edges.clear();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (!mesh.is_edge(h)) continue;
    if (const double cost = mesh.cost(h); std::isfinite(cost)) edges.emplace_back(cost, h);
  }
  const auto share = static_cast<std::size_t>(of_edges * static_cast<double>(edges.size()));
  const std::size_t wanted = std::min(edges.size(), std::max(share, kLeast));
  const auto end = edges.begin() + static_cast<std::ptrdiff_t>(wanted);
  if (end != edges.end()) std::nth_element(edges.begin(), end, edges.end());
  edges.erase(end, edges.end());
  std::sort(edges.begin(), edges.end());
}

// One pass over the cheapest edges; false if there were none.
inline bool coarsening_pass(CollapsingSurface& mesh, Index target, std::vector<CostedEdge>& edges,
                            CoarseSurface& result) {
  cheapest_edges(mesh, target, edges);
  mesh.start_pass();
  ++result.passes;
  for (const auto& [cost, h] : edges) {
    if (mesh.vertex_count() <= target) break;
    if (!mesh.is_edge(h) || mesh.moved(h)) continue;
    const CollapseOutcome outcome = mesh.collapse(h);
    if (outcome == CollapseOutcome::kDone) ++result.collapses;
    if (outcome == CollapseOutcome::kRefusedTopology) ++result.refused_topology;
    if (outcome == CollapseOutcome::kRefusedShape) ++result.refused_shape;
  }
  return !edges.empty();
}

}  // namespace detail

MSPSKEL_INLINE CoarseSurface coarsen_surface(const SurfaceSnapshot& input, const CoarseningOptions& options,
                                             const Execution& execution) {
  validate(options);
  CoarseSurface result;
  if (input.vertex_count() <= options.vertices) {
    result.surface = input;
    result.coarse_vertex.resize(input.position.size());
    for (Index v = 0; v < input.vertex_count(); ++v)
      result.coarse_vertex[v] = input.vertex_halfedge[v] == kNone ? kNone : v;
    return result;
  }
  detail::CollapsingSurface mesh(input, options);
  const double surplus = std::max(1.0, static_cast<double>(mesh.vertex_count() - options.vertices));
  std::vector<detail::CostedEdge> edges;
  while (mesh.vertex_count() > options.vertices) {
    report_progress(execution.progress, "coarsening", result.collapses / surplus);
    if (!detail::coarsening_pass(mesh, options.vertices, edges, result)) break;
    if (mesh.sparse()) mesh.compact();
  }
  result.surface.frame = input.frame;
  mesh.finish(result);
  return result;
}

}  // namespace mspskel
