// Branch-level saturation: leaf arcs that stand for no limb of the surface go.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Removes leaf arcs, the shortest first, until each of the rest stands for one of the tips; hubs with two arc
// ends dissolve. Returns the number of arcs removed. A component keeps at least one arc or hub, loops always
// stay. `tips` are of the vertices of the graph's map. Cost: O(vertices + tips · leaf arcs) a round; rounds
// end when none removes an arc.
Index prune_branches(ArcGraph& graph, const std::vector<LimbTip>& tips);

// Removes leaf arcs whose tip lies in the ball of their joint, other than those that end in a flat end: a
// tube may be cut off just beside a joint. Returns their number.
Index remove_spurs(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                   const std::vector<LimbTip>& tips = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/prune_branches_impl.h"
#endif
