// The holes in a slice's region: other contours of the same plane, inside the slice's own.
#pragma once

#include <vector>

#include "mspskel/center/planar_region.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/slice/trace_contour.h"

namespace mspskel {

// A slice and its region: the plane, the vertex that the contour goes through, the contour, its plane's
// coordinates and the region in them.
struct SliceRegion {
  Plane plane;
  Index through = kNone;
  Contour contour;
  PlaneFrame frame;
  PlanarRegion region;
};

// Fills in frame and region, without holes, from plane, through and contour. The polygon starts at the vertex
// that the contour goes through, so that the samples on it do not depend on where the walk began.
void flatten_slice(const SurfaceSnapshot& surface, SliceRegion& slice);

// Whether one of `rays` (an even number) rays in the plane from a point of the region meets the surface
// before it meets the region's own contours: then there is a hole (or more than one). Misses holes that lie
// between the rays. Cost: `rays` / 2 ray queries, each for two opposite rays.
bool may_have_holes(const SliceRegion& slice, const BoundingVolumeHierarchy& solid, const Vector2& from,
                    int rays = 8);

// Adds the contours that bound holes directly inside the slice's outer contour; islands inside holes and what
// they contain stay out. Returns the number of holes. Cost: O(log faces + crossings of the plane in the box
// round the contour), and for a hole what PlanarRegion::contains takes.
Index add_hole_contours(const SliceTracer& tracer, const BoundingVolumeHierarchy& solid, SliceRegion& slice);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/hole_contours_impl.h"
#endif
