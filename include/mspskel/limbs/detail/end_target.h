// Where the arc of a limb is to end.
#pragma once

#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

// Where few vertices make the end, their mean lies on the surface but for rounding, and outside in a bent
// one: then the tip itself is the target.
inline void keep_target_well_inside(LimbTip& tip, const BoundingVolumeHierarchy& solid) {
  constexpr double kLeastClearance = 0.05;  // half widths
  if (!solid.inside(tip.target) || solid.distance(tip.target) < kLeastClearance * tip.measures.half_width)
    tip.target = tip.position;
}

}  // namespace detail
}  // namespace mspskel
