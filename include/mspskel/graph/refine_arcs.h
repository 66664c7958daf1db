// From the collapse's graph to the finished arcs of the default mode: routed inside, pruned, centred, grown
// into the tips.
#pragma once

#include "mspskel/graph/center_arcs.h"
#include "mspskel/graph/extend_ends.h"
#include "mspskel/graph/merge_joints.h"
#include "mspskel/graph/prune_branches.h"
#include "mspskel/graph/route_inside.h"

namespace mspskel {

struct RefinementOptions {
  bool enabled = true;
  PruningOptions pruning;
  CenteringOptions centering;
  ExtensionOptions extension;
  double joint_overlap = 1.0;  // joints closer than this many radii of the smaller ball are one, 0 to 10
  double first_pruning = 0.3;  // share of the pruning thresholds before arcs are centred, 0 to 1
};

inline void validate(const RefinementOptions& o) {
  validate(o.pruning);
  validate(o.centering);
  validate(o.extension);
  if (!(o.joint_overlap >= 0 && o.joint_overlap <= 10))
    throw UsageError("joint overlap must be from 0 to 10 radii");
  if (!(o.first_pruning >= 0 && o.first_pruning <= 1)) throw UsageError("first pruning must be from 0 to 1");
}

struct RefinementCounts {
  Index pruned = 0;  // leaf arcs removed
  Index joints_merged = 0;
  RoutingResult routing;
};

// Every step keeps the number of components and of independent cycles: leaf arcs go, arcs that are no loops
// contract, points move. `perimeter` is the MSP of every vertex. Throws UsageError, Cancelled.
inline RefinementCounts refine_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                    const BoundingVolumeHierarchy& solid,
                                    const std::vector<double>& perimeter, const RefinementOptions& options,
                                    const Execution& execution = {}) {
  validate(options);
  RefinementCounts counts;
  const auto prune = [&](double share) {
    PruningOptions pruning = options.pruning;
    pruning.protrusion *= share;
    pruning.smallest *= share;
    counts.pruned += prune_branches(graph, surface, solid, perimeter, pruning);
    counts.joints_merged += merge_joints(graph, solid, options.joint_overlap);
    dissolve_through_hubs(graph);
  };
  counts.routing = route_inside(graph, surface, solid);
  prune(options.first_pruning);  // hairs would pull on the arcs that they leave
  CenteringOptions centering = options.centering;
  centering.rounds = (options.centering.rounds + 2) / 3;
  center_arcs(graph, solid, centering, execution);
  prune(1.0);
  extend_ends(graph, solid, options.extension);
  centering.rounds = options.centering.rounds - centering.rounds;
  center_arcs(graph, solid, centering, execution);
  prune(1.0);
  return counts;
}

}  // namespace mspskel
