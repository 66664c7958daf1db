// Where a model was cut open, its skeleton ends in the middle of the cut.
#pragma once

#include <vector>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/repair/opening.h"
#include "mspskel/skeleton/curve_skeleton.h"
#include "mspskel/skeleton/radius.h"

namespace mspskel {

struct OpeningEnds {
  Index led = 0;      // openings that a leaf arc was led to
  Index added = 0;    // openings that got an arc of their own, where no leaf was near
  Index missing = 0;  // openings whose centre cannot be seen from the skeleton: nothing changed there
};

// Leads to each opening the nearest leaf within two of its radii, straight from a radius before it, or from
// the last node before that which sees the centre within 60 degrees of where its arc goes; an opening without
// such a leaf gets an arc from the nearest of the nodes that see it. The end lies a fiftieth of the radius
// before the centre, so that it is inside the surface that the cap closes. Nodes are at most `step` apart, a
// share of the model's extent, and radii are distances to the wall, the caps left out. The number of pieces
// and cycles stays, and the map of the surface stays a partition. Openings without a cap's centre are left
// alone. Coordinates are the model's. Cost: O(nodes + vertices) an opening, and a hierarchy of the wall.
OpeningEnds end_at_openings(CurveSkeleton& skeleton, const SurfaceSnapshot& surface,
                            const BoundingVolumeHierarchy& solid, const std::vector<Opening>& openings,
                            double step);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/skeleton/detail/end_at_openings_impl.h"
#endif
