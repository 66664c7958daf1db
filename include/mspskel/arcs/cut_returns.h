// An arc does not come back to where it has been.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// What an arc does between two points of which one lies in the other's maximal ball, on a way of more than
// twice their distance and than that ball's radius, is a detour: the chord, which is inside, takes its place,
// unless the two go round a handle together; without labels arcs of cycles stay as they are. Of several
// detours from a point the longest goes. Where a leaf arc's detour reaches farther beyond the ball, by a
// radius, than what follows up to its end, the arc ends in the detour, where that is farthest from the ball.
// Returns the number of detours. Cost: O(points · log points) for arcs that are about straight, a distance
// query for each point from which there may be a detour.
Index cut_returns(ArcGraph& graph, const BoundingVolumeHierarchy& solid, const Execution& execution = {},
                  const CrossingLabels& crossings = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/cut_returns_impl.h"
#endif
