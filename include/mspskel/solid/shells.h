// Vessels: solids that are a thin wall round a hollow, such as cups, bowls and vases.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

// Per component of the surface, whether it is a wall: over two thirds of its area half the chord inward from
// the surface is less than 0.3 half widths of the slice there. A slice of a wall is long and thin, or a ring,
// so nothing in it says where along it an arc should run. A sponge is none: its slices are as wide for
// the tunnels that they go round, and the square of their median half width is more than the surface has for
// each of its handles. Cost: O(faces); a ray a vertex for components whose volume is small for their area.
// Throws Cancelled.
std::vector<bool> find_shells(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                              const VertexSlices& slices, const ProgressCallback& progress = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/solid/detail/shells_impl.h"
#endif
