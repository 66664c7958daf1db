// Branch-level saturation: leaf arcs that carry no feature of the surface go, the least significant first.
#pragma once

#include "mspskel/graph/center_arcs.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

struct PruningOptions {
  // A leaf arc stays if its significance exceeds this; 0 to 100. Larger keeps fewer features.
  double significance = 1.35;
  // ... and if its surface reaches beyond the balls of the rest of the skeleton by more than this share of
  // the model's extent; 0 to 1. Below it everything counts as noise.
  double smallest = 0.01;
};

inline void validate(const PruningOptions& o) {
  if (!(o.significance >= 0 && o.significance <= 100))
    throw UsageError("branch significance must be from 0 to 100");
  if (!(o.smallest >= 0 && o.smallest <= 1))
    throw UsageError("smallest feature must be from 0 to 1 of the extent");
}

// What a leaf arc stands for, in the manner of the saturation of Eq. 4.5 lifted from nodes to branches: how
// far its part of the surface protrudes, in its own half widths, times how much smaller its slices are than
// those of the part that it leaves. Fingers and ears are long for their width and much smaller than what
// carries them; the corners of a sheet are no longer than wide, noise does not protrude.
struct LeafSignificance {
  double depth =
      0.0;  // how far the arc's surface reaches beyond the slices of the joint and the balls of the rest
  double half_width = 0.0;  // median along the arc
  double msp_ratio = 1.0;   // MSP of the part that it leaves / MSP of the arc, at least 1

  double value() const;
};

// Half the longer side of the rectangle of the same perimeter and area: half the width of a flat slice, π/4
// radii of a disc.
double slice_half_width(double perimeter, double area);

// Prunes until every leaf arc is significant; hubs with two arc ends dissolve. `slices` are those of the
// surface's vertices. Returns the number of arcs removed. A component keeps at least one arc or hub, loops
// always stay. Cost: O(leaf arcs · vertices on leaf arcs · points near them).
Index prune_branches(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const VertexSlices& slices, const PruningOptions& options,
                     const Execution& execution = {});

// Removes leaf arcs whose tip lies in the ball of their joint. Returns their number.
Index remove_spurs(ArcGraph& graph, const BoundingVolumeHierarchy& solid);

}  // namespace mspskel

#include "mspskel/graph/detail/prune_branches_impl.h"
