#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>

#include "mspskel/base/counted.h"
#include "mspskel/base/linkage.h"
#include "mspskel/detail/join_components.h"
#include "mspskel/graph/collapsed_arcs.h"
#include "mspskel/graph/limit_nodes.h"
#include "mspskel/graph/make_curve_skeleton.h"
#include "mspskel/graph/reach_digits.h"
#include "mspskel/graph/space_nodes.h"
#include "mspskel/graph/surface_map.h"
#include "mspskel/graph/useless_pieces.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/component_solids.h"
#include "mspskel/mesh/orient_shells.h"

namespace mspskel {
namespace detail {

class StageClock {
 public:
  explicit StageClock(std::vector<std::pair<std::string, double>>& seconds) : seconds_(seconds) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    seconds_.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  std::vector<std::pair<std::string, double>>& seconds_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Whether some component has fewer vertices than it may be given.
inline bool may_be_subdivided(const SurfaceSnapshot& surface, const SubdivisionOptions& options) {
  std::vector<Index> count(static_cast<std::size_t>(surface.component_count), 0);
  for (const Index c : surface.component)
    if (c != kNone) ++count[c];
  return std::any_of(count.begin(), count.end(), [&](Index n) { return n < options.vertices; });
}

inline void run_slice_stages(const SliceTracer& tracer, const ExtractOptions& options, ExtractResult& result,
                             StageClock& clock) {
  if (options.slices == SliceMethod::kSearch) {
    result.slices = search_minimum_slice_perimeters(tracer, options.search, options.execution);
    clock.lap("slices");
    compute_slice_errors(tracer, options.error, result.slices, options.execution);
    clock.lap("slice_error");
    result.initial_slices = result.slices;
    return;
  }
  result.slices = compute_minimum_slice_perimeters(tracer, options.sampling, options.execution);
  clock.lap("slices");
  compute_slice_errors(tracer, options.error, result.slices, options.execution);
  clock.lap("slice_error");
  result.initial_slices = result.slices;
  if (!options.cone.enabled) return;
  refine_slices(tracer, options.sampling, options.cone, result.slices, options.execution);
  clock.lap("cone_refinement");
  compute_slice_errors(tracer, options.error, result.slices, options.execution);
  clock.lap("slice_error");
}

// Limbs are told on a surface between the input and the one that the other stages walk on: it shows smaller
// ones, and finding their tips costs little.
struct LimbSurface {
  std::optional<CoarseSurface> between;  // none: the input itself
  std::vector<Index> coarse_vertex;      // per vertex of it; empty if nothing is coarsened
};

// From the input to the surface that the stages walk on, by way of the limb surface where that is coarser.
inline CoarseSurface coarsen_in_steps(const SurfaceSnapshot& input, const ExtractOptions& options,
                                      LimbSurface& limbs) {
  if (input.vertex_count() > options.limb_vertices && options.limb_vertices > options.coarsening.vertices) {
    CoarseningOptions first = options.coarsening;
    first.vertices = options.limb_vertices;
    limbs.between = coarsen_surface(input, first, options.execution);
  }
  CoarseSurface coarse =
      coarsen_surface(limbs.between ? limbs.between->surface : input, options.coarsening, options.execution);
  limbs.coarse_vertex = coarse.coarse_vertex;
  if (!limbs.between) return coarse;
  coarse.coarse_vertex = carried_over(limbs.coarse_vertex, limbs.between->coarse_vertex, kNone);
  coarse.collapses += limbs.between->collapses;
  coarse.refused_topology += limbs.between->refused_topology;
  coarse.refused_shape += limbs.between->refused_shape;
  coarse.passes += limbs.between->passes;
  return coarse;
}

// `slices` are of the surface that the stages walk on, and so are the vertices of the tips.
inline std::vector<LimbTip> limb_tips(const SurfaceSnapshot& input, const LimbSurface& limbs,
                                      const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                      const LimbOptions& options) {
  Execution alone;  // other stages run beside it
  alone.threads = 1;
  if (limbs.coarse_vertex.empty()) return find_limb_tips(input, solid, slices, options, alone);
  const SurfaceSnapshot& surface = limbs.between ? limbs.between->surface : input;
  return on_coarser_surface(
      find_limb_tips(surface, solid, carried_over(slices, limbs.coarse_vertex), options, alone),
      limbs.coarse_vertex);
}

// Slices and skeletal points, on one surface: the stages that share their vertices among the threads.
// `of_surface` is the surface's own hierarchy, where there is one.
inline void run_vertex_stages(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy* of_surface,
                              const ExtractOptions& options, ExtractResult& result, StageClock& clock) {
  SkeletonMeshOptions points = options.points;
  // Holes of a slice are contours of the surface that was sliced.
  std::optional<BoundingVolumeHierarchy> own;
  std::optional<SliceTracer> tracer;
  run_beside(
      options.execution, [&] { tracer.emplace(surface); },
      [&] {
        if (of_surface == nullptr && points.holes != HoleSearch::kIgnore) own.emplace(surface);
      });
  run_slice_stages(*tracer, options, result, clock);
  points.solid = own ? &*own : of_surface;
  result.skeleton_mesh = make_skeleton_mesh(*tracer, result.slices, points, options.execution);
  clock.lap("skeletal_points");
}

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

inline std::string small_handles_left_out(const ExtractResult& result) {
  const std::vector<SmallHandle>& handles = result.cocycles.small_handles;
  const auto& least =
      *std::min_element(handles.begin(), handles.end(),
                        [](const SmallHandle& a, const SmallHandle& b) { return a.length < b.length; });
  const Vector3 at = result.surface.frame.to_model(least.at);
  char text[128];
  std::snprintf(text, sizeof text, "; the shortest loop, %.6g long, is at %.6g %.6g %.6g",
                least.length * result.surface.frame.scale, at.x(), at.y(), at.z());
  return counted(static_cast<Index>(handles.size()), "handle") + " too small for a cycle left out" + text;
}

inline void collect_warnings(ExtractResult& result) {
  if (result.skeleton_mesh.without_slice > 0)
    result.warnings.push_back("no valid slice at " +
                              counted(result.skeleton_mesh.without_slice, "vertex", "vertices") +
                              "; the neighbours' skeletal points stand in");
  if (result.refinement.routing.unroutable > 0)
    result.warnings.push_back("no way inside was found for " +
                              counted(result.refinement.routing.unroutable, "stretch", "stretches") +
                              " of the skeleton outside the solid");
  if (!result.cocycles.small_handles.empty()) result.warnings.push_back(small_handles_left_out(result));
  const UselessPieces useless = find_useless_pieces(result.surface, result.skeleton);
  if (useless.stubs > 0)
    result.warnings.push_back("the skeleton is shorter than a tenth of its extent in " +
                              counted(useless.stubs, "component"));
  if (useless.on_surface > 0)
    result.warnings.push_back("the skeleton lies on the surface at " + counted(useless.on_surface, "node"));
  if (result.cycles.rank < result.cycles.cycles)
    result.warnings.push_back("no way round the handle that it misses was found for " +
                              counted(result.cycles.cycles - result.cycles.rank, "cycle") +
                              " of the skeleton");
}

}  // namespace detail

MSPSKEL_INLINE ExtractOptions default_options() {
  ExtractOptions o;
  // The repulsive force has a minimum in each lobe of a wide slice, the filled region's field one in the
  // middle.
  o.points.point.method = SkeletalPointMethod::kAreaField;
  o.points.point.tolerance = 0.01;  // its square is the error
  o.points.holes = HoleSearch::kProbe;
  o.collapse.lambda = 0;
  o.collapse.angle_floor = 0.3;
  o.collapse.one_dimensional = EdgePolicy::kKeep;
  return o;
}

MSPSKEL_INLINE ExtractOptions thesis_options() {
  ExtractOptions o;
  o.mode = Mode::kThesis;
  o.coarsen = false;
  o.slices = SliceMethod::kSampling;
  o.error = {SliceErrorAverage::kMean, SliceErrorScale::kMinMax};
  o.points.point.method = SkeletalPointMethod::kSampledForce;
  o.coherence.enabled = false;
  o.filter_branches = true;
  o.refinement.enabled = false;
  return o;
}

MSPSKEL_INLINE void validate(const ExtractOptions& options) {
  validate(options.coarsening);
  validate(options.subdivision);
  if (options.limb_vertices < 4) throw UsageError("limb vertices must be at least 4");
  validate(options.search);
  validate(options.sampling);
  validate(options.cone);
  validate(options.points);
  validate(options.coherence);
  validate(options.cocycles);
  validate(options.collapse);
  validate(options.filter);
  validate(options.refinement);
}

namespace detail {

// A surface of one component, and what bounds its solid where that is more than the surface itself.
inline ExtractResult extract_component(SurfaceSnapshot surface, const SurfaceSnapshot* bounds,
                                       const ExtractOptions& options) {
  ExtractResult result;
  StageClock clock(result.seconds);
  result.surface = std::move(surface);
  // The solid is what the shell encloses, whichever way it is turned.
  const std::optional<SurfaceSnapshot> oriented = orient_shells_outward(result.surface);
  const SurfaceSnapshot& shells = oriented ? *oriented : result.surface;
  LimbSurface limbs;
  std::shared_ptr<const BoundingVolumeHierarchy> hierarchy;
  run_beside(
      options.execution,
      [&] {
        if (!options.coarsen || shells.vertex_count() <= options.coarsening.vertices) return;
        result.coarse = coarsen_in_steps(shells, options, limbs);
        clock.lap("coarsening");
      },
      [&] {
        hierarchy =
            std::make_shared<const BoundingVolumeHierarchy>(bounds != nullptr ? *bounds : result.surface);
      });
  if (bounds == nullptr) result.solid = hierarchy;
  const BoundingVolumeHierarchy& solid = *hierarchy;
  clock.lap("hierarchy");
  const SurfaceSnapshot& working = result.coarse ? result.coarse->surface : shells;
  run_vertex_stages(working, result.coarse || bounds != nullptr ? nullptr : &solid, options, result, clock);
  std::vector<LimbTip> tips;
  CoarseLabels coarse_labels;
  run_beside(
      options.execution,
      [&] { detail::run_collapse_stages(shells, working, options, result, coarse_labels, clock); },
      [&] {
        if (options.refinement.enabled)
          tips = detail::limb_tips(shells, limbs, solid, result.slices, options.refinement.limbs);
      });
  clock.lap("limb_tips");
  ArcGraph arcs;
  ArcClasses classes;
  if (options.refinement.enabled) {
    ArcTubes tubes;
    arcs = make_arc_graph(result.collapsed, tubes);
    if (result.cocycles.rank > 0 && !options.filter_branches)
      classes = {CrossingLabels(result.cocycles),
                 detail::collapse_tubes(result, coarse_labels, std::move(tubes))};
    result.refinement = refine_arcs(arcs, working, shells, solid, result.slices, std::move(tips),
                                    options.refinement, options.execution, classes);
    clock.lap("arcs");
  }
  // The labels are those of half-edges, which turned shells have others of.
  if (oriented)
    result.cocycles = compute_volume_cocycles(result.surface, detail::cocycle_candidates(result),
                                              options.cocycles, options.execution.progress);
  if (result.coarse) detail::carry_over(result, arcs);
  if (options.refinement.enabled) {
    // On the input itself: coarser surfaces show no digits.
    result.digits = reach_digits(
        arcs, shells, solid, find_digits(arcs, shells, solid, options.refinement.limbs, options.execution),
        options.refinement.centering.step, options.refinement.joint_overlap);
    clock.lap("digits");
    if (options.refinement.node_spacing) space_nodes(arcs, solid, *options.refinement.node_spacing);
    if (options.refinement.nodes > 0) {
      const Index left = limit_nodes(arcs, solid, options.refinement.nodes, classes.crossings);
      if (left > options.refinement.nodes)
        result.warnings.push_back("the skeleton keeps " + counted(left, "node") + ": with " +
                                  std::to_string(options.refinement.nodes) + " it would leave the solid");
    }
    result.cycles = cycle_rank(arcs, CrossingLabels(result.cocycles));
    clock.lap("arcs");
    result.skeleton = make_curve_skeleton(arcs, result.surface, solid, result.skeleton_mesh.perimeter,
                                          result.skeleton_mesh.error, options.execution);
  } else {
    result.skeleton = make_curve_skeleton(result.collapsed, result.surface.frame);
    set_radii(result.surface, solid, result.skeleton, options.execution);
  }
  clock.lap("result");
  return result;
}

// Whether the options ask for more of a component than its part of the whole's nodes.
inline ExtractOptions with_share_of_nodes(const ExtractOptions& options, Index own, Index all) {
  ExtractOptions share = options;
  share.refinement.nodes = static_cast<Index>(
      std::max<std::int64_t>(1, std::int64_t{options.refinement.nodes} * own / std::max<Index>(all, 1)));
  return share;
}

// Every component of a surface by itself: in a frame, with a budget of vertices and in a solid of its own.
class ComponentwiseExtraction {
 public:
  ComponentwiseExtraction(const SurfaceSnapshot& surface, const ComponentSolids& solids,
                          const ExtractOptions& options)
      : surface_(surface),
        solids_(solids),
        options_(options),
        part_(solids.faces.size()),
        own_(part_.size()) {
    for (Index f = 0; f < surface.face_count(); ++f)
      own_[surface.component[surface.origin[3 * f]]].push_back(f);
  }

  void run_into(ExtractResult& result) {
    ExtractOptions first = options_;
    first.refinement.nodes = 0;
    extract_all([&](Index) { return first; });
    if (options_.refinement.nodes > 0 && options_.refinement.enabled) {
      // A component gets nodes in proportion to what it has without a budget.
      std::vector<Index> nodes;
      Index all = 0;
      for (const ExtractResult& part : part_) {
        nodes.push_back(static_cast<Index>(part.skeleton.nodes.size()));
        all += nodes.back();
      }
      if (all > options_.refinement.nodes)
        extract_all([&](Index c) { return with_share_of_nodes(options_, nodes[c], all); });
    }
    make_room(result);
    for (std::size_t c = 0; c < part_.size(); ++c) {
      const NormalisedFrame frame = part_[c].surface.frame;
      join_component(std::move(part_[c]),
                     {static_cast<Index>(c), vertex_[c], own_[c], {frame, surface_.frame}}, result);
    }
  }

 private:
  template <class OptionsOf>
  void extract_all(OptionsOf options_of) {
    vertex_.assign(part_.size(), {});
    std::vector<Index> small, large;
    for (std::size_t c = 0; c < part_.size(); ++c)
      (own_[c].size() <= kSmallComponent ? small : large).push_back(static_cast<Index>(c));
    parallel_for(
        static_cast<Index>(small.size()), "components", options_.execution, [] { return 0; },
        [&](Index i, int) {
          ExtractOptions options = options_of(small[i]);
          // Progress is for the calling thread, which reports it for the components as a whole.
          options.execution = {1, {}};
          extract_one(small[i], options);
        },
        1);
    for (const Index c : large) extract_one(c, options_of(c));
  }

  void extract_one(Index c, const ExtractOptions& options) {
    SurfacePart own = surface_part(surface_, own_[c], own_[c].size());
    vertex_[c] = std::move(own.vertex);
    std::optional<SurfacePart> bounds;
    if (solids_.faces[c].size() > own_[c].size())
      bounds = surface_part(surface_, solids_.faces[c], own_[c].size());
    part_[c] = extract_component(std::move(own.surface), bounds ? &bounds->surface : nullptr, options);
  }

  const SurfaceSnapshot& surface_;
  const ComponentSolids& solids_;
  const ExtractOptions& options_;
  std::vector<ExtractResult> part_;         // per component
  std::vector<std::vector<Index>> own_;     // per component: its faces
  std::vector<std::vector<Index>> vertex_;  // per component: its vertices
};

inline ExtractResult extract_componentwise(SurfaceSnapshot surface, const ExtractOptions& options) {
  ExtractResult result;
  result.surface = std::move(surface);
  const ComponentSolids solids = find_component_solids(result.surface, options.execution.progress);
  ComponentwiseExtraction(result.surface, solids, options).run_into(result);
  const auto cavities = std::count(solids.cavity.begin(), solids.cavity.end(), 1);
  if (cavities > 0)
    result.warnings.push_back(std::to_string(cavities) + (cavities == 1 ? " cavity" : " cavities") +
                              " found: each has a skeleton of its own, which lies in the hollow, and the "
                              "solid round it keeps clear of it");
  return result;
}

inline ExtractResult extract_pieces(SurfaceSnapshot surface, const ExtractOptions& options) {
  return surface.component_count > 1 ? extract_componentwise(std::move(surface), options)
                                     : extract_component(std::move(surface), nullptr, options);
}

// What was found on a surface that subdivides the input, as of the input, whose vertices have the numbers
// `own` there.
inline void restrict_to_input(SurfaceSnapshot input, const std::vector<Index>& own,
                              const ExtractOptions& options, ExtractResult& result) {
  result.surface = std::move(input);
  result.solid.reset();
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

MSPSKEL_INLINE ExtractResult extract_skeleton_of_snapshot(SurfaceSnapshot surface,
                                                          const ExtractOptions& options) {
  validate(options);
  std::optional<SubdividedSurface> fine;
  if (options.coarsen && detail::may_be_subdivided(surface, options.subdivision))
    fine = subdivide_surface(surface, options.subdivision, options.execution);
  ExtractResult result;
  if (fine && fine->cuts > 0) {
    result = detail::extract_pieces(std::move(fine->surface), options);
    detail::restrict_to_input(std::move(surface), fine->vertex, options, result);
  } else {
    result = detail::extract_pieces(std::move(surface), options);
  }
  detail::collect_warnings(result);
  return result;
}

}  // namespace mspskel
