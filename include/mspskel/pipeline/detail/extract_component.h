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
#include "mspskel/pipeline/detail/follow_width.h"
#include "mspskel/pipeline/detail/limb_surface.h"
#include "mspskel/pipeline/detail/stage_clock.h"
#include "mspskel/pipeline/detail/vertex_stages.h"
#include "mspskel/refine/reach_digits.h"
#include "mspskel/skeleton/make_curve_skeleton.h"

namespace mspskel {
namespace detail {

// A surface of one component, and what bounds its solid where that is more than the surface itself.
inline ExtractResult extract_component(SurfaceSnapshot surface, const SurfaceSnapshot* bounds,
                                       const ExtractOptions& given) {
  ExtractResult result;
  StageClock clock(result.seconds);
  result.surface = std::move(surface);
  // The solid is what the shell encloses, whichever way it is turned.
  const std::optional<SurfaceSnapshot> oriented = orient_shells_outward(result.surface);
  const SurfaceSnapshot& shells = oriented ? *oriented : result.surface;
  LimbSurface limbs;
  std::shared_ptr<const BoundingVolumeHierarchy> hierarchy;
  const bool coarsens = given.coarsen && shells.vertex_count() > given.coarsening.vertices;
  run_beside(
      given.execution,
      [&] {
        if (!coarsens) return;
        result.coarse = coarsen_in_steps(shells, given, limbs);
        clock.lap("coarsening");
      },
      [&](const Execution& aside) {
        hierarchy = std::make_shared<const BoundingVolumeHierarchy>(
            bounds != nullptr ? *bounds : result.surface, aside.progress);
      });
  clock.lap("hierarchy");
  // How wide the limbs are only the solid shows. Few shapes ask for another surface.
  const ExtractOptions options = coarsens ? following_width(shells, *hierarchy, given) : given;
  if (options.coarsening.vertices > given.coarsening.vertices) {
    result.coarse.reset();
    if (shells.vertex_count() > options.coarsening.vertices)
      result.coarse = coarsen_in_steps(shells, options, limbs);
    else
      limbs = {};
    clock.lap("coarsening");
  }
  if (bounds == nullptr) result.solid = hierarchy;
  const BoundingVolumeHierarchy& solid = *hierarchy;
  const SurfaceSnapshot& working = result.coarse ? result.coarse->surface : shells;
  run_vertex_stages(working, result.coarse || bounds != nullptr ? nullptr : &solid, options, result, clock);
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
        options.refinement.centering.step, options.refinement.joint_overlap, options.execution);
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
