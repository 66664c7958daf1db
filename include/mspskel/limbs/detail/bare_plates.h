// The plates that no arc leads into.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/limbs/detail/plate_growth.h"

namespace mspskel {
namespace detail {

// Those that stand out and hold none of the given points in their outer halves. The balls of an arc that runs
// within a plate leave most of it uncovered, so no distance from balls tells whether it has one. `outside`:
// how far each vertex is beyond the balls; a plate grows from its greatest values, where they are more than
// the plate is thick and than `least`. Throws Cancelled. Cost: O(vertices), a few rays where that is
// greatest, and what the plates cost.
inline std::vector<Plate> bare_plates(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                      const LimbOptions& options, const std::vector<double>& outside,
                                      const std::vector<Vector3>& points, double least,
                                      const ProgressCallback& progress) {
  const std::vector<Index> tops = greatest_of_neighbours(surface, outside, least);
  std::vector<Plate> bare;
  if (tops.empty()) return bare;
  PlateGrowth growth(surface, solid, options, progress);
  for (const Index v : tops) {
    std::optional<Plate> plate = growth.grow_at(v, outside[v]);
    if (!plate || !plate->stands_out || plate->is_bow) continue;
    const auto is_in = [&](const Vector3& x) { return plate->holds_in_outer_half(x); };
    if (std::none_of(points.begin(), points.end(), is_in)) bare.push_back(std::move(*plate));
  }
  return bare;
}

}  // namespace detail
}  // namespace mspskel
