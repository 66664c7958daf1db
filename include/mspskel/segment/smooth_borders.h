// Short, smooth borders between the parts of a surface.
#pragma once

#include <limits>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// For each two parts that touch, in the order of their numbers: the cheapest border within a band about the
// present one, a minimum cut of the faces' dual graph, whose edges cost what border_costs says; a border
// moves by at most `width` radii of a circle of its length and by at most `most`, lengths in the surface's
// frame. Throws UsageError for a width out of [0, 10] or a negative `most`. Faces beyond the band stay, and
// so does a border whose band would swallow a part. Writes `part_of_face`. Throws Cancelled; the callback is
// asked before each band. Cost: a maximum flow in each band.
void smooth_borders(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                    std::vector<Index>& part_of_face, double width,
                    double most = std::numeric_limits<double>::infinity(),
                    const ProgressCallback& progress = {});

// Makes the faces of each part hang together across edges: the piece of the largest area stays, unless it is
// below `smallest` of the surface, and every other goes to the part with which it shares the longest border.
// A piece that touches no part that stays, since it is a component of the surface, stays. O(faces) a round;
// there are few rounds.
void connect_parts(const SurfaceSnapshot& surface, std::vector<Index>& part_of_face, double smallest = 0);

}  // namespace mspskel
