// How long polylines are, where they end, and how they grow.
#pragma once

#include <cstddef>
#include <vector>

#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {
namespace detail {

inline double length_of(const std::vector<Vector3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

// Adds the points from `first` up to the one before `end`.
inline void append_points(std::vector<Vector3>& line, const std::vector<Vector3>& points, std::size_t first,
                          std::size_t end) {
  line.insert(line.end(), points.begin() + static_cast<std::ptrdiff_t>(first),
              points.begin() + static_cast<std::ptrdiff_t>(end));
}

// The point of a polyline at the given length before its last point, or its first point.
inline Vector3 point_before_end(const std::vector<Vector3>& points, double length) {
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    const double edge = (points[i] - points[i - 1]).norm();
    if (edge >= length) return points[i] + (points[i - 1] - points[i]) * (length / edge);
    length -= edge;
  }
  return points.front();
}

// Points from the last one straight towards `target` until the maximal ball nearly touches it, or the surface
// is in the way.
inline void lead_towards(std::vector<Vector3>& points, const Vector3& target,
                         const BoundingVolumeHierarchy& solid, double step) {
  const Vector3 from = points.back(), way = target - from;
  const double length = way.norm();
  for (double walked = step; walked < length; walked += step) {
    const Vector3 x = from + way * (walked / length);
    const double clearance = solid.distance(x);
    if (clearance > 0.9 * (length - walked) || clearance < 0.25 * step) break;
    if (solid.segment_crosses(points.back(), x)) break;
    points.push_back(x);
  }
}

}  // namespace detail
}  // namespace mspskel
