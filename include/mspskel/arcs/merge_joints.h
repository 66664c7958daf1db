// Joints that lie within one another's maximal ball are one joint.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Contracts arcs between two joints, shortest first, while their distance is below `overlap` times the
// smaller ball's radius; the joint with the larger ball stays. Arcs of the other one enter the ball on a
// straight line, which the ball keeps inside the solid. A contracted arc is never a loop, so the homotopy
// type stays; and an arc that would go round a handle another way keeps its joint. Returns the number of
// joints that went. Cost: O(arcs · log arcs), and the points of the arcs at each joint that goes.
Index merge_joints(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double overlap = 1.0,
                   const CrossingLabels& crossings = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/merge_joints_impl.h"
#endif
