// A node budget: the points of the arcs that matter least go, the shape and the topology stay.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Removes inner points of arcs, each time the one nearest to the chord of its neighbours, until hubs and
// inner points together are at most `nodes` or no point can go: the chord would meet the surface, or the arc
// would become a loop of less than three edges or a second edge between the same hubs. Returns the number of
// nodes left, which may be above the budget. Cost: O(points²) distances, a segment query a removal.
Index limit_nodes(ArcGraph& graph, const BoundingVolumeHierarchy& solid, Index nodes,
                  const CrossingLabels& crossings = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/limit_nodes_impl.h"
#endif
