// Whether an edge without faces belongs to the skeleton or is a branch of noise (thesis 4.3.3).
#pragma once

#include <algorithm>

#include "mspskel/collapse/collapse_cost.h"
#include "mspskel/collapse/merging_set.h"

namespace mspskel {

// SE(e), Eq. 4.5: (MSP ratio)² · min(Sat) / max(Sat). At least 0; it can exceed 1, so a threshold bounds it
// from below only. 0 where neither end covers any surface.
inline double edge_saturation(const MergingSet& u, const MergingSet& v) {
  const double high = std::max(u.area(), v.area());
  if (!(high > 0)) return 0.0;
  const double ratio = perimeter_ratio(u.perimeter(), v.perimeter());
  return ratio * ratio * std::min(u.area(), v.area()) / high;
}

}  // namespace mspskel
