// Which solid each component of a surface bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// A component that lies directly inside another one and is turned the other way bounds a cavity of it. One
// that is turned the same way is a solid of its own, which the outer one knows nothing of: a figure inside
// its clothes.
struct ComponentSolids {
  std::vector<Index> around;  // per component: the innermost other one around it; kNone if there is none
  std::vector<std::uint8_t> cavity;   // per component: it bounds a cavity of `around`
  std::vector<double> signed_volume;  // per component, normalised units; positive if turned outward
  // Per component the faces that bound its solid: its own first, then those of its cavities.
  std::vector<std::vector<Index>> faces;
};

// A component inside another is found by its first vertex, so the nesting of pieces that cross each other
// means nothing. Cost: O(faces log faces) where boxes of components seldom overlap. Throws Cancelled.
ComponentSolids find_component_solids(const SurfaceSnapshot& surface, const ProgressCallback& progress = {});

// Some faces of a surface as a surface of their own, with the vertices that they use.
struct SurfacePart {
  SurfaceSnapshot surface;
  std::vector<Index> vertex;  // of the whole, per vertex of the part
};

// Whole components, in the order of their numbers, with a frame of their own: what a component gets does not
// depend on the others. Cost: O(faces), times a logarithm where their numbers lie far apart.
SurfacePart surface_part(const SurfaceSnapshot& surface, const std::vector<Index>& faces);

// What bounds a component's solid, in the frame of the component's own part: of `faces` the first `own` are
// the component, which come first here too and are named as in its own part; the others bound cavities.
SurfacePart solid_part(const SurfaceSnapshot& surface, const std::vector<Index>& faces, std::size_t own,
                       const NormalisedFrame& frame);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/component_solids_impl.h"
#endif
