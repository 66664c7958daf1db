// From the collapse's graph to the finished arcs of the default mode: routed inside, pruned, centred, grown
// into the tips.
#pragma once

#include "mspskel/graph/aim_ends.h"
#include "mspskel/graph/center_arcs.h"
#include "mspskel/graph/complete_limbs.h"
#include "mspskel/graph/extend_ends.h"
#include "mspskel/graph/limit_nodes.h"
#include "mspskel/graph/merge_joints.h"
#include "mspskel/graph/prune_branches.h"
#include "mspskel/graph/route_inside.h"
#include "mspskel/graph/zip_arcs.h"

namespace mspskel {

struct RefinementOptions {
  bool enabled = true;
  PruningOptions pruning;
  CenteringOptions centering;
  ExtensionOptions extension;
  ZipOptions zip;
  Index nodes = 0;             // budget of nodes, 0: none
  double joint_overlap = 1.0;  // joints closer than this many radii of the smaller ball are one, 0 to 10
  double first_pruning = 0.3;  // share of the pruning thresholds before arcs are centred, 0 to 1
};

inline void validate(const RefinementOptions& o) {
  validate(o.pruning);
  validate(o.centering);
  validate(o.extension);
  validate(o.zip);
  if (o.nodes < 0) throw UsageError("nodes must be at least 0");
  if (!(o.joint_overlap >= 0 && o.joint_overlap <= 10))
    throw UsageError("joint overlap must be from 0 to 10 radii");
  if (!(o.first_pruning >= 0 && o.first_pruning <= 1)) throw UsageError("first pruning must be from 0 to 1");
}

struct RefinementCounts {
  Index pruned = 0;  // leaf arcs removed
  Index joints_merged = 0;
  Index completed = 0;  // arcs added for limbs that had none
  Index zips = 0;       // pairs of arcs joined from their joint to where they part
  RoutingResult routing;
};

// Every step keeps the number of components and of independent cycles: leaf arcs go, arcs that are no loops
// contract, points move. `slices` are those of the surface's vertices. Throws UsageError, Cancelled.
inline RefinementCounts refine_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                    const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                    const RefinementOptions& options, const Execution& execution = {}) {
  validate(options);
  RefinementCounts counts;
  const auto prune = [&](double share) {
    PruningOptions pruning = options.pruning;
    pruning.significance *= share;
    pruning.smallest *= share;
    counts.pruned += prune_branches(graph, surface, solid, slices, pruning);
    counts.joints_merged += merge_joints(graph, solid, options.joint_overlap);
    dissolve_through_hubs(graph);
  };
  // Until the graph's shape is settled a coarser line will do.
  CenteringOptions few = options.centering;
  few.rounds = (options.centering.rounds + 2) / 3;
  few.step = 2 * options.centering.step;
  few.rays = std::max(4, 2 * options.centering.rays / 3);
  counts.routing = route_inside(graph, surface, solid);
  aim_ends(graph, surface, solid, options.centering.step);
  prune(options.first_pruning);  // hairs would pull on the arcs that they leave
  for (int pass = 0; pass < 2; ++pass) {
    center_arcs(graph, solid, few, execution);
    counts.zips += zip_arcs(graph, surface, solid, options.zip);
    prune(1.0);
  }
  aim_ends(graph, surface, solid, options.centering.step);
  counts.completed = complete_limbs(graph, surface, solid, slices, options.pruning, options.centering.step);
  center_arcs(graph, solid, few, execution);
  counts.zips += zip_arcs(graph, surface, solid, options.zip);
  extend_ends(graph, solid, options.extension);
  center_arcs(graph, solid, few, execution);
  prune(1.0);
  center_arcs(graph, solid, options.centering, execution);
  const Index spurs = remove_spurs(graph, solid);
  counts.pruned += spurs;
  if (spurs > 0) center_arcs(graph, solid, few, execution);
  subdivide(graph, 1.25 * options.centering.step);  // rounds of centring stretch some edges
  return counts;
}

}  // namespace mspskel
