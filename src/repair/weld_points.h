// Which points are one.
#pragma once

#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Per point the first one with equal coordinates; -0 equals 0. O(n log n).
std::vector<Index> weld_equal_points(const std::vector<Vector3>& points);

// Joins members of `members` that are within the smaller of their two reaches: per point the first one of its
// group. `reach` is per point, and so is `representative`, which is updated. Returns how many points were
// joined to another.
Index weld_near_points(const std::vector<Vector3>& points, const std::vector<Index>& members,
                       const std::vector<double>& reach, std::vector<Index>& representative);

}  // namespace mspskel::detail
