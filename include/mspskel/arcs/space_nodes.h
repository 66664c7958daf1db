// Nodes at a wanted distance along the arcs, which stay where they are.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Every arc gets nodes at even distances of at most `spacing`, on its polyline. Where the way between two of
// them cannot be straightened within the solid, corners stay between, so nothing that is inside leaves it,
// and an arc goes round the handles that it went round. Loops keep three edges, arcs beside others two. Cost:
// a segment query a point.
void space_nodes(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double spacing);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/space_nodes_impl.h"
#endif
