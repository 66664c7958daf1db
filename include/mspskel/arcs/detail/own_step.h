// How finely an arc is sampled: by its own thickness.
#pragma once

#include <algorithm>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/value_at_rank.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {
namespace detail {

// Half the thickness for which steps are meant, in extents. What is thinner gets steps that are as much
// shorter, so that it has as many of them for its width.
inline constexpr double kReferenceThickness = 0.006;

// The step for something of the given half width, where thick parts get `step`.
inline double step_for_width(double half_width, double step) {
  constexpr double kFinest = 1.0 / 16;
  return step * std::clamp(half_width / kReferenceThickness, kFinest, 1.0);
}

// As the median distance of the arc to the surface tells. Cost: at most nine distances.
inline double own_step(const Arc& arc, const BoundingVolumeHierarchy& solid, double step) {
  constexpr std::size_t kSamples = 9;
  const std::size_t stride = 1 + (arc.points.size() - 1) / kSamples;
  std::vector<double> radii;
  for (std::size_t i = stride / 2; i < arc.points.size(); i += stride)
    radii.push_back(solid.distance(arc.points[i]));
  return step_for_width(value_at_rank(std::move(radii), 0.5), step);
}

}  // namespace detail
}  // namespace mspskel
