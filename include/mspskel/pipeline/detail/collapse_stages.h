// From skeletal points to the collapsed graph, which has the cycles of the solid.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/pipeline/detail/stage_clock.h"

namespace mspskel {
namespace detail {

// Planes to look for cocycles with: the slices, each at the first vertex of its class.
inline std::vector<SliceCandidate> cocycle_candidates(const ExtractResult& result) {
  std::vector<SliceCandidate> candidates = slice_candidates(result.slices);
  if (!result.coarse) return candidates;
  const std::vector<Index>& coarse_vertex = result.coarse->coarse_vertex;
  std::vector<Index> first(result.slices.valid.size(), kNone);
  for (std::size_t v = coarse_vertex.size(); v-- > 0;)
    if (coarse_vertex[v] != kNone) first[coarse_vertex[v]] = static_cast<Index>(v);
  for (SliceCandidate& candidate : candidates) candidate.vertex = first[candidate.vertex];
  return candidates;
}

// Where the collapse has its arcs run, on the surface that was coarsened.
inline CollapseTubes collapse_tubes(const ExtractResult& result, const CoarseLabels& coarse_labels,
                                    ArcTubes arcs) {
  CollapseTubes tubes;
  tubes.arcs = std::move(arcs);
  tubes.halfedge = result.cocycles.label;
  tubes.node_of_vertex = result.collapsed.node_of_vertex;
  tubes.to_vertex = result.collapsed.label_of_vertex;
  if (!result.coarse) return tubes;
  const std::vector<Index>& from = result.coarse->coarse_vertex;
  tubes.node_of_vertex = carried_over(tubes.node_of_vertex, from, kNone);
  tubes.to_vertex = carried_over(tubes.to_vertex, from, CocycleLabel{});
  for (std::size_t v = 0; v < coarse_labels.within.size(); ++v) tubes.to_vertex[v] += coarse_labels.within[v];
  return tubes;
}

// From skeletal points to the collapsed graph, on the same surface and one thread. `shells` is what `surface`
// was coarsened from.
inline void run_collapse_stages(const SurfaceSnapshot& shells, const SurfaceSnapshot& surface,
                                const ExtractOptions& options, ExtractResult& result,
                                CoarseLabels& coarse_labels, StageClock& clock) {
  if (options.coherence.enabled) {
    apply_spatial_coherence(surface, options.coherence, result.skeleton_mesh);
    clock.lap("coherence");
  }
  result.cocycles = compute_volume_cocycles(shells, cocycle_candidates(result), options.cocycles,
                                            options.execution.progress);
  if (result.coarse)
    coarse_labels = carry_labels_over(shells, result.cocycles.label, surface, result.coarse->coarse_vertex);
  clock.lap("cocycles");
  result.collapsed = collapse_skeleton_mesh(surface, result.skeleton_mesh,
                                            result.coarse ? coarse_labels.halfedge : result.cocycles.label,
                                            options.collapse, options.execution);
  clock.lap("collapse");
  if (!options.filter_branches) return;
  result.filter = filter_branches(result.collapsed, options.filter);
  result.collapsed = std::move(result.filter.skeleton);
  clock.lap("filter");
}

}  // namespace detail
}  // namespace mspskel
