// Branch-level saturation: leaf arcs that carry no feature of the surface go, the least significant first.
#pragma once

#include "mspskel/graph/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct PruningOptions {
  // A leaf arc stays if its part of the surface protrudes from the balls of the rest of the skeleton by more
  // than this share of its own width where it leaves; 0 to 100. Larger keeps fewer features.
  double protrusion = 0.5;
  // ... and by more than this share of the model's extent; 0 to 1. Below it everything counts as noise.
  double smallest = 0.01;
};

inline void validate(const PruningOptions& o) {
  if (!(o.protrusion >= 0 && o.protrusion <= 100)) throw UsageError("protrusion must be from 0 to 100");
  if (!(o.smallest >= 0 && o.smallest <= 1))
    throw UsageError("smallest feature must be from 0 to 1 of the extent");
}

struct LeafSignificance {
  double depth = 0.0;  // how far the arc's surface reaches beyond the balls of the rest of the skeleton
  double width = 0.0;  // radius of the solid where the arc leaves its joint
};

// Prunes until every leaf arc is significant; through hubs that are left dissolve. `perimeter` is the MSP of
// every vertex. Returns the number of arcs removed. A component keeps at least one arc or hub, loops always
// stay. Cost: O(leaf arcs · vertices on leaf arcs · points near them).
Index prune_branches(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const std::vector<double>& perimeter, const PruningOptions& options);

}  // namespace mspskel

#include "mspskel/graph/detail/prune_branches_impl.h"
