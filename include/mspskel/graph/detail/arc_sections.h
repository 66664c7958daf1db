// How wide the solid is round an arc, by its visible sections.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mspskel/graph/center_arcs.h"
#include "mspskel/graph/detail/arc_balls.h"
#include "mspskel/graph/limb_measures.h"

namespace mspskel {
namespace detail {

// Half width and perimeter of the visible section across a direction; zeros where there is none.
inline std::array<double, 2> section_size(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                          const Vector3& along) {
  constexpr int kRays = 16;
  if (along.norm() == 0) return {0.0, 0.0};
  const VisibleSection section = visible_section(solid, x, along.normalized(), kRays);
  if (!section.closed) return {0.0, 0.0};
  const double area = kPi * section.radius * section.radius;
  const double perimeter = std::sqrt(4 * kPi * area / std::max(section.roundness, 1e-6));
  return {section.half_width, perimeter};
}

// Lower quartiles over at most nine points of a polyline outside the ball: a way into a limb comes from what
// is wider, and how much of it does is chance.
inline std::array<double, 2> lower_section(const std::vector<Vector3>& points, const Ball& ball,
                                           const BoundingVolumeHierarchy& solid) {
  constexpr std::size_t kMost = 9;
  std::vector<std::size_t> outside;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if ((points[i] - ball.centre).norm() >= ball.radius) outside.push_back(i);
  std::vector<double> widths, perimeters;
  const std::size_t count = std::min(kMost, outside.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = outside[(2 * k + 1) * outside.size() / (2 * count)];
    const auto [width, perimeter] = section_size(solid, points[i], points[i + 1] - points[i - 1]);
    if (perimeter == 0) continue;
    widths.push_back(width);
    perimeters.push_back(perimeter);
  }
  return {value_at_rank(std::move(widths), 0.25), value_at_rank(std::move(perimeters), 0.25)};
}

}  // namespace detail
}  // namespace mspskel
