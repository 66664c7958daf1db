// Where a leg meets a plate or a frame turns, the middle has a corner: arcs that were rounded there get it.
#pragma once

#include "mspskel/arcs/center_arcs.h"

namespace mspskel {

// Straight arcs are what centring has instead of noise, so it rounds corners, by about the thickness of what
// the arc runs through, and the round way is off the middle. Where an arc turns by 25 degrees and more and is
// off the middle, its straight continuations from both sides, if they meet within a third of the thickness,
// take the place of the round way once they are better centred by a quarter in the mean and no worse in sum.
// A way off the middle is measured as |Σ r d| / Σ r of the rays of a section across it. Ends of arcs stay,
// new lines stay inside, and none goes round a handle. Returns the number of corners. Cost: for each step of
// an arc that bends, two dozen ray queries at most.
Index sharpen_corners(ArcGraph& graph, const BoundingVolumeHierarchy& solid, const Execution& execution = {},
                      const CrossingLabels& crossings = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/sharpen_corners_impl.h"
#endif
