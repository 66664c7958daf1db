// Radii of the maximal inscribed balls round the skeleton's nodes.
#pragma once

#include <limits>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Distance from a point in model coordinates to the surface, model units, whichever side the point is on.
inline double surface_distance(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                               const Vector3& model_point) {
  return snapshot.frame.scale * hierarchy.distance(snapshot.frame.to_normalised(model_point));
}

// Sets every node's radius to its distance to the surface. O(nodes · log faces), parallel. Throws Cancelled
// if the progress callback asks to stop; radii are then partly set.
inline void set_radii(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                      CurveSkeleton& skeleton, const Execution& execution = {}) {
  struct Before {
    Vector3 position = Vector3::Zero();
    double distance = std::numeric_limits<double>::infinity();
  };
  parallel_for(
      static_cast<Index>(skeleton.nodes.size()), "radius", execution, [] { return Before(); },
      [&](Index i, Before& before) {
        const Vector3 p = snapshot.frame.to_normalised(skeleton.nodes[i].position);
        // No farther than the way by the node before, but for rounding, which in triangles without area is
        // large beside distances near 0.
        const double bound = (before.distance + (p - before.position).norm()) * (1 + 1e-9) + 1e-12;
        ClosestPoint nearest = hierarchy.closest(p, bound);
        if (nearest.face == kNone) nearest = hierarchy.closest(p);
        before = {p, nearest.distance};
        skeleton.nodes[i].radius = snapshot.frame.scale * before.distance;
      });
}

}  // namespace mspskel
