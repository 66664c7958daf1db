// Where the arc of a limb is to end.
#pragma once

#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

// How near the surface an arc may end, in half widths of the limb.
inline constexpr double kLeastClearance = 0.05;

// Whether the target lies in the solid, not on its surface.
inline bool ends_inside(const LimbTip& tip) { return tip.target != tip.position; }

// Where few vertices make the end, their mean lies on the surface but for rounding, and outside in a bent
// one: then the tip itself is the target.
inline void keep_target_well_inside(LimbTip& tip, const BoundingVolumeHierarchy& solid) {
  if (!solid.inside(tip.target) || solid.distance(tip.target) < kLeastClearance * tip.measures.half_width)
    tip.target = tip.position;
}

}  // namespace detail
}  // namespace mspskel
