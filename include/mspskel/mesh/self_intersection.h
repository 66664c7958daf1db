// Pairs of triangles that meet where they should not: whether the surface bounds a solid at all.
#pragma once

#include <limits>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Number of pairs of faces that have more in common than the corners that they share: crossing, touching or
// overlapping within rounding (signs of volumes, see detail/orientation.h; doubt counts as contact).
// Triangles without area are left to their neighbours. Stops as soon as `limit` pairs are known, so limit = 1
// answers yes or no. O((faces + pairs whose boxes overlap) · log faces), parallel; the count does not depend
// on the threads. Throws Cancelled if the progress callback asks to stop.
Index count_self_intersections(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                               Index limit = std::numeric_limits<Index>::max(),
                               const Execution& execution = {});

// The faces that any such pair has, ascending. O((faces + boxes that overlap until a partner is found) · log
// faces), parallel. Throws Cancelled likewise.
std::vector<Index> find_self_intersecting_faces(const SurfaceSnapshot& snapshot,
                                                const BoundingVolumeHierarchy& hierarchy,
                                                const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/self_intersection_impl.h"
#endif
