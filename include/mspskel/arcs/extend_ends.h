// Leaf ends grow into the tips of the limbs, which the slices round a tip do not reach (terminal deviation,
// thesis 3.1).
#pragma once

#include "mspskel/arcs/center_arcs.h"

namespace mspskel {

struct ExtensionOptions {
  double step = 0.008;         // growth a step, share of the model's extent; 0.0005 to 0.5
  double tip_clearance = 0.5;  // stop at this distance before the tip, in radii of the limb's end; 0.05 to 2
  double max_length = 8.0;     // longest growth in radii of the limb's end; 0 to 100
  int rays = 24;               // rays a cross-section, 4 to 256
};

inline void validate(const ExtensionOptions& o) {
  if (!(o.step >= 0.0005 && o.step <= 0.5))
    throw UsageError("extension step must be from 0.0005 to 0.5 of the extent");
  if (!(o.tip_clearance >= 0.05 && o.tip_clearance <= 2))
    throw UsageError("tip clearance must be from 0.05 to 2 radii");
  if (!(o.max_length >= 0 && o.max_length <= 100))
    throw UsageError("longest extension must be from 0 to 100 radii");
  if (o.rays < 4 || o.rays > 256) throw UsageError("extension rays must be from 4 to 256");
}

// Grows every leaf end step by step along its tangent, drawn to the centre of each cross-section on the way,
// until the surface ahead is near. Points stay inside the solid. Cost: a ray fan and a few queries a step.
void extend_ends(ArcGraph& graph, const BoundingVolumeHierarchy& solid, const ExtensionOptions& options);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/extend_ends_impl.h"
#endif
