// The collapse of a skeleton mesh, as a stage: surface, skeletal points and labels in, skeleton out.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mspskel/center/skeleton_mesh.h"
#include "mspskel/collapse/skeleton_decimater.h"

namespace mspskel {

// One merging set a vertex.
inline std::vector<MergingSet> make_merging_sets(const SkeletonMesh& mesh) {
  std::vector<MergingSet> sets;
  sets.reserve(mesh.position.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v)
    sets.emplace_back(MergingVertex{mesh.position[v], mesh.perimeter[v], mesh.normal[v], mesh.error[v],
                                    mesh.area[v], mesh.valid[v] != 0});
  return sets;
}

// Collapses the skeleton mesh, whose connectivity is the surface's, to a graph (thesis 4.3, Fig. 4.5).
// `labels`: one a half-edge of the surface, VolumeCocycles::label, or empty: then every loop counts as
// null-homologous and goes. With labels and keep_topology, b0 of the result is the surface's and b1 is the
// labels' rank. Throws UsageError for options out of range or arrays of the wrong length, Cancelled. Cost:
// O(V log V).
inline CollapsedSkeleton collapse_skeleton_mesh(const SurfaceSnapshot& surface, const SkeletonMesh& mesh,
                                                const std::vector<CocycleLabel>& labels = {},
                                                const CollapseOptions& options = {},
                                                const Execution& execution = {}) {
  if (static_cast<Index>(mesh.position.size()) != surface.vertex_count())
    throw UsageError("skeleton mesh: must have one point for each of the surface's " +
                     std::to_string(surface.vertex_count()) + " vertices");
  return collapse_complex(make_complex(surface, labels), make_merging_sets(mesh), options, execution);
}

}  // namespace mspskel
