// The pipeline: from one closed surface to its curve skeleton.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/arcs/limit_nodes.h"
#include "mspskel/arcs/space_nodes.h"
#include "mspskel/base/counted.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/orient_shells.h"
#include "mspskel/pipeline/detail/carry_over.h"
#include "mspskel/pipeline/detail/collapse_stages.h"
#include "mspskel/pipeline/detail/limb_surface.h"
#include "mspskel/pipeline/detail/stage_clock.h"
#include "mspskel/pipeline/detail/vertex_stages.h"
#include "mspskel/refine/reach_digits.h"
#include "mspskel/skeleton/make_curve_skeleton.h"

namespace mspskel {
namespace detail {

inline void coarsen(const SurfaceSnapshot& shells, const ExtractOptions& options, LimbSurface& limbs,
                    ExtractResult& result) {
  limbs = {};
  result.coarse.reset();
  if (options.coarsen && shells.vertex_count() > options.coarsening.vertices)
    result.coarse = coarsen_in_steps(shells, options, limbs);
}

// On the coarse surface, or on `shells`, which bounds `solid` where that is given. What the slices are like
// tells whether a thin shape needs more vertices than it got.
inline void run_vertex_stages(const SurfaceSnapshot& shells, const BoundingVolumeHierarchy* solid,
                              const ExtractOptions& options, LimbSurface& limbs, ExtractResult& result,
                              StageClock& clock) {
  const auto run = [&] {
    if (result.coarse)
      run_vertex_stages(result.coarse->surface, nullptr, options, result, clock);
    else
      run_vertex_stages(shells, solid, options, result, clock);
  };
  run();
  if (!result.coarse) return;
  const SurfaceSnapshot& coarse = result.coarse->surface;
  const std::optional<ExtractOptions> more =
      finer(options, vertices_for_width(coarse, result.slices), coarse.vertex_count());
  if (!more) return;
  coarsen(shells, *more, limbs, result);
  clock.lap("coarsening");
  run();
}

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
        coarsen(shells, options, limbs, result);
        if (result.coarse) clock.lap("coarsening");
      },
      [&](const Execution& aside) {
        hierarchy = std::make_shared<const BoundingVolumeHierarchy>(
            bounds != nullptr ? *bounds : result.surface, aside.progress);
      });
  if (bounds == nullptr) result.solid = hierarchy;
  const BoundingVolumeHierarchy& solid = *hierarchy;
  clock.lap("hierarchy");
  run_vertex_stages(shells, bounds == nullptr ? &solid : nullptr, options, limbs, result, clock);
  const SurfaceSnapshot& working = result.coarse ? result.coarse->surface : shells;
  std::vector<LimbTip> tips;
  CoarseLabels coarse_labels;
  run_beside(
      options.execution,
      [&] { detail::run_collapse_stages(shells, working, options, result, coarse_labels, clock); },
      [&](const Execution& aside) {
        if (options.refinement.enabled)
          tips = detail::limb_tips(shells, limbs, solid, result.slices, options.refinement.limbs, aside);
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

}  // namespace detail
}  // namespace mspskel
