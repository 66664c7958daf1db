// From a mesh to its curve skeleton in one call: the composition of the public stages.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mspskel/arcs/cycle_rank.h"
#include "mspskel/base/progress.h"
#include "mspskel/center/skeleton_mesh.h"
#include "mspskel/center/spatial_coherence.h"
#include "mspskel/collapse/coarse_labels.h"
#include "mspskel/collapse/collapse_skeleton_mesh.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/mesh/subdivide_surface.h"
#include "mspskel/refine/refine_arcs.h"
#include "mspskel/skeleton/curve_skeleton.h"
#include "mspskel/slice/cone_refinement.h"
#include "mspskel/slice/plane_search.h"
#include "mspskel/slice/slice_error.h"
#include "mspskel/thesis/branch_filter.h"

namespace mspskel {

// A mode is a set of option values: default_options() and thesis_options(). This only names it.
enum class Mode { kDefault, kThesis };

enum class SliceMethod {
  kSearch,    // slice/plane_search.h
  kSampling,  // N planes (thesis 3.1), then cone refinement (thesis 3.2)
};

struct ExtractOptions {
  Mode mode = Mode::kDefault;
  // The stages walk on a surface as fine as a skeleton needs. Where the input has more vertices, slices,
  // skeletal points and the collapse run on a coarser one; arcs are centred in the input's solid, and values
  // are carried over to its vertices. Where it has fewer and long edges, all runs on one with those edges
  // cut, and the input gets what its own vertices have there.
  bool coarsen = true;
  // It gets more vertices where many limbs are thin: so many that an edge is no longer than half of the
  // limb's width. Then limb_vertices are no fewer, and features as large as the thinnest limbs' half width
  // are limbs.
  CoarseningOptions coarsening;
  SubdivisionOptions subdivision;
  // Limbs are told on a surface of so many vertices where the input is finer; [4, 2^31). With no more than
  // coarsening.vertices, on that one.
  Index limb_vertices = 4000;
  SliceMethod slices = SliceMethod::kSearch;
  SearchOptions search;      // of kSearch
  SamplingOptions sampling;  // of kSampling
  ConeOptions cone;          // of kSampling
  SliceErrorOptions error;
  SkeletonMeshOptions points;
  CoherenceOptions coherence;
  CocycleOptions cocycles;
  CollapseOptions collapse;
  bool filter_branches = false;  // thesis 6.1; refinement has a finer way
  BranchFilterOptions filter;    // of filter_branches
  RefinementOptions refinement;
  Execution execution;
};

// What a user gets: search, coherence, no collapse of limbs, refined arcs.
ExtractOptions default_options();
// Every formula and constant of the thesis as printed.
ExtractOptions thesis_options();
// Throws UsageError naming the option.
void validate(const ExtractOptions& options);

struct ExtractResult {
  CurveSkeleton skeleton;

  // What lies between the stages, in the order in which they ran; lengths in surface.frame. Everything per
  // vertex is per input vertex; where a coarser surface was used, its values are carried over.
  SurfaceSnapshot surface;
  // Of `surface`; empty if it has several components, which have solids of their own.
  std::shared_ptr<const BoundingVolumeHierarchy> solid;
  std::optional<CoarseSurface> coarse;  // of `surface`; empty where edges of the input were cut
  VertexSlices initial_slices;          // before cone refinement; equal to slices where nothing refines
  VertexSlices slices;
  SkeletonMesh skeleton_mesh;
  VolumeCocycles cocycles;      // of `surface`
  CollapsedSkeleton collapsed;  // after branch filtering, if that is on
  BranchFilterResult filter;    // its counts; its skeleton is moved to `collapsed`
  RefinementCounts refinement;
  Index digits = 0;                                     // arcs that reach_digits added
  CycleRank cycles;                                     // of the finished arcs
  std::vector<std::pair<std::string, double>> seconds;  // stage, wall seconds
  std::vector<std::string> warnings;
};

// The curve skeleton of a closed, manifold, oriented triangle mesh of any OpenMesh type. Each component gets
// a piece of its own with as many independent cycles as its genus. The mesh is only read. The result does not
// depend on the number of threads. Throws MeshError if the mesh is not usable, UsageError for options out of
// range, Cancelled. Cost: dominated by the slices, about 30 of √V crossings each a vertex.
template <class Mesh>
ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options = default_options());

// The same on a snapshot, which moves into the result.
ExtractResult extract_skeleton_of_snapshot(SurfaceSnapshot surface, const ExtractOptions& options);

template <class Mesh>
ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options) {
  return extract_skeleton_of_snapshot(make_snapshot(mesh), options);
}

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/pipeline/detail/extract_skeleton_impl.h"
#endif
