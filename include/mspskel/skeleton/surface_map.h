// The map from the surface to the skeleton: which vertices belong to which node.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

namespace detail {
// Vertices that a thread takes at a time: neighbours in storage share what it remembers.
inline constexpr Index kMapGrain = 512;
}  // namespace detail

// Maximal connected sets of vertices that map to one node.
struct SurfacePatches {
  std::vector<Index> patch_of_vertex;  // kNone where the vertex is isolated or maps nowhere
  std::vector<Index> node;             // per patch
  std::vector<double> area;            // per patch, sum of the vertex areas, normalised units squared
};

// Patches are numbered by their first vertex. O(faces).
SurfacePatches find_patches(const SurfaceSnapshot& snapshot, const std::vector<Index>& node_of_vertex);

struct SurfaceMapReport {
  bool partition = false;           // one node for each vertex that has a face, none for isolated ones
  Index unmapped_vertices = 0;      // with faces, but without a node in range
  Index empty_nodes = 0;            // nodes without vertices
  std::vector<Index> patches;       // per node
  Index nodes_in_one_patch = 0;     // nodes whose vertices form one patch
  double share_in_one_patch = 0.0;  // of the nodes with vertices; 1 if there is none
};

// Never throws for a wrong map: it reports. O(faces).
SurfaceMapReport report_surface_map(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton);

struct PatchRepair {
  Index moved_vertices = 0;
  Index moved_patches = 0;
  Index rounds = 0;
  Index nodes_left = 0;  // nodes that keep several patches, each on a component of its own
};

// Makes each node's vertices one patch on each component of the surface: the largest patch (by area, then by
// first vertex) stays; every other one goes to the node of a patch that stays and touches it, preferring
// nodes that the patch's own node is joined to, then nodes near the patch's centroid, then the smaller index.
// A partition stays a partition, and no node loses all its vertices. Nodes' `area` follows, perimeter and
// slice_error do not. O(faces · rounds); there are few rounds, as each settles all patches that touch a
// settled one. Throws UsageError if the map is not a partition.
PatchRepair make_patches_connected(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton);

// After the arcs were resampled: gives every vertex that belongs to a branch the nearest node along this
// branch, that is, the nearer end of the nearest edge of the branch's polyline; ties go to the earlier one.
//   branch_of_vertex  per vertex an index into `branches`, or kNone for a vertex that keeps its node (at a
//   joint, say) branches          chains of indices of the skeleton's nodes, at least one node each
// Writes skeleton.node_of_vertex, then makes the patches connected. O(vertices · nodes of their branch).
// Throws UsageError if a branch has no nodes or names one that is not there, or the map ends up as no
// partition.
PatchRepair assign_vertices_to_branch_nodes(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton,
                                            const std::vector<Index>& branch_of_vertex,
                                            const std::vector<Branch>& branches,
                                            const Execution& execution = {});

// Sets every node's area to the surface area of its vertices, model units squared. O(vertices).
void set_areas(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/skeleton/detail/surface_map_impl.h"
#endif
