// What is known of one surface's vertices, as of those of another.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mspskel/extract_skeleton.h"
#include "mspskel/skeleton/surface_map.h"

namespace mspskel {
namespace detail {

// Skeletal points of another surface for the vertices of this one, each from its vertex there.
inline void carry_over(SkeletonMesh& mesh, const SurfaceSnapshot& surface, const std::vector<Index>& from) {
  mesh.position = carried_over(mesh.position, from, Vector3(Vector3::Zero()));
  mesh.perimeter = carried_over(mesh.perimeter, from, 0.0);
  mesh.normal = carried_over(mesh.normal, from, Vector3(Vector3::Zero()));
  mesh.error = carried_over(mesh.error, from, 1.0);
  mesh.valid = carried_over(mesh.valid, from, std::uint8_t{0});
  mesh.area = surface.vertex_area;
}

inline void carry_over(CollapsedSkeleton& collapsed, const std::vector<Index>& from) {
  collapsed.node_of_vertex = carried_over(collapsed.node_of_vertex, from, kNone);
  std::vector<CocycleLabel>& label = collapsed.label_of_vertex;
  if (!label.empty()) label = carried_over(label, from, CocycleLabel{});  // filtered skeletons have none
}

// What is known of the coarse vertices holds for the input vertices that merged into them.
inline void carry_over(ExtractResult& result, ArcGraph& arcs) {
  const std::vector<Index>& from = result.coarse->coarse_vertex;
  result.initial_slices = carried_over(result.initial_slices, from);
  result.slices = carried_over(result.slices, from);
  carry_over(result.skeleton_mesh, result.surface, from);
  carry_over(result.collapsed, from);
  if (arcs.arc_of_vertex.empty()) return;
  arcs.arc_of_vertex = carried_over(arcs.arc_of_vertex, from, kNone);
  arcs.hub_of_vertex = carried_over(arcs.hub_of_vertex, from, kNone);
}

// What was found on a surface that subdivides the input, as of the input, whose vertices have the numbers
// `own` there.
inline void restrict_to_input(SurfaceSnapshot input, const std::vector<Index>& own,
                              const ExtractOptions& options, ExtractResult& result) {
  result.surface = std::move(input);
  result.solid.reset();
  result.coarse.reset();  // the other surface's vertices merged into its own, not the input's alone
  result.initial_slices = carried_over(result.initial_slices, own);
  result.slices = carried_over(result.slices, own);
  carry_over(result.skeleton_mesh, result.surface, own);
  carry_over(result.collapsed, own);
  result.cocycles = compute_volume_cocycles(result.surface, slice_candidates(result.slices), options.cocycles,
                                            options.execution.progress);
  result.skeleton.node_of_vertex = carried_over(result.skeleton.node_of_vertex, own, kNone);
  make_patches_connected(result.surface, result.skeleton);
}

}  // namespace detail
}  // namespace mspskel
