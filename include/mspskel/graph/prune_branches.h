// Branch-level saturation: leaf arcs that carry no feature of the surface go, the least significant first.
#pragma once

#include "mspskel/graph/center_arcs.h"
#include "mspskel/graph/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

// Prunes until every leaf arc stands for one of the tips or is significant by itself; hubs with two arc ends
// dissolve. `slices` are those of the surface's vertices. Returns the number of arcs removed. A component
// keeps at least one arc or hub, loops always stay. Cost: O(leaf arcs · vertices on leaf arcs · points near
// them).
Index prune_branches(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const VertexSlices& slices, const std::vector<LimbTip>& tips,
                     const PruningOptions& options, const Execution& execution = {});

// Removes leaf arcs whose tip lies in the ball of their joint. Returns their number.
Index remove_spurs(ArcGraph& graph, const BoundingVolumeHierarchy& solid);

}  // namespace mspskel

#include "mspskel/graph/detail/prune_branches_impl.h"
