// Which parts of a surface its skeleton does not represent.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/solid_hierarchies.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// A part that protrudes from the balls of the skeleton.
struct UncoveredPart {
  Index vertex = kNone;                // the one farthest outside all balls
  Vector3 position = Vector3::Zero();  // of that vertex, model units
  double depth = 0.0;                  // of the part, model units
  double widths = 0.0;                 // its length over its width: depth divided by twice the mean radius
  bool is_plate = false;               // thin and wide, and no arc leads into it
};

// A part of so many widths is one that people would call a limb. A right-angled corner of a plate has 1.6,
// the rim of a flat end and the corner of a block less than 1.
inline constexpr double kMissedWidths = 2.25;

struct CoverageOptions {
  double smallest = 0.015;  // less deep parts are none; a share of their component's extent. [0, 1]
};

// The parts of at least kMissedWidths, and the plates that find_limb_tips would tell as limbs and that have
// no arc in their outer halves, the longest for its width first. With f the distance of the surface outside
// the union of the maximal balls round the skeleton's nodes (those of the same component, in its solid), a
// part is what hangs together beyond a level of f, from a maximum down to where it is most slender (pi
// depth^2 / area, which is length over width of a tube) before it meets a farther part: the measure that
// tells limbs, with another distance, and without their limit of half of the surface. The area is that of all
// triangles that a part touches, so few triangles rather hide a part than make one up. Solids and snapshot
// belong together; radii are measured anew. O((vertices + nodes) log nodes), parallel; the result does not
// depend on the threads. Throws Cancelled if the callback asks to stop.
std::vector<UncoveredPart> find_uncovered_parts(const SurfaceSnapshot& surface,
                                                const SolidHierarchies& solids, const CurveSkeleton& skeleton,
                                                const CoverageOptions& options = {},
                                                const Execution& execution = {});
// The same with the hierarchy of the whole surface, from which it makes those of the components.
std::vector<UncoveredPart> find_uncovered_parts(const SurfaceSnapshot& surface,
                                                const BoundingVolumeHierarchy& solid,
                                                const CurveSkeleton& skeleton,
                                                const CoverageOptions& options = {},
                                                const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/limbs/detail/coverage_impl.h"
#endif
