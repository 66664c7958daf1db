#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// Leaves out the corners between `from` and `to` if the fan of chords from `from` to them and to `to` stays
// off the surface, so that the shorter way can be reached without crossing it; else those stay that the fan
// needs.
inline void add_fan(std::vector<Vector3>& line, const std::vector<Vector3>& corners, const Vector3& to,
                    const BoundingVolumeHierarchy& solid) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3& next = i + 1 < corners.size() ? corners[i + 1] : to;
    if (line.back() != corners[i] && solid.segment_crosses(line.back(), next)) line.push_back(corners[i]);
  }
  line.push_back(to);
}

// The polyline in `count` steps of equal length, with the corners that add_fan keeps.
inline std::vector<Vector3> spaced_line(const std::vector<Vector3>& points, Index count,
                                        const BoundingVolumeHierarchy& solid) {
  std::vector<double> walked(points.size(), 0.0);  // from the start
  for (std::size_t i = 1; i < points.size(); ++i)
    walked[i] = walked[i - 1] + (points[i] - points[i - 1]).norm();
  std::vector<Vector3> line{points.front()}, corners;
  std::size_t corner = 1;
  for (Index k = 1; k < count; ++k) {
    const double target = walked.back() * k / count;
    corners.clear();
    for (; corner + 1 < points.size() && walked[corner] < target; ++corner) corners.push_back(points[corner]);
    const double edge = walked[corner] - walked[corner - 1], along = target - walked[corner - 1];
    const Vector3 place =
        along < edge ? Vector3(points[corner - 1] + along / edge * (points[corner] - points[corner - 1]))
                     : points[corner];
    add_fan(line, corners, place, solid);
  }
  corners.assign(points.begin() + static_cast<std::ptrdiff_t>(corner), points.end() - 1);
  add_fan(line, corners, points.back(), solid);
  return line;
}

}  // namespace detail

MSPSKEL_INLINE void space_nodes(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double spacing) {
  std::map<std::pair<Index, Index>, Index> arcs_between;
  const auto ends = [](const Arc& arc) -> std::pair<Index, Index> {
    return std::minmax(arc.hub[0], arc.hub[1]);
  };
  for (const Arc& arc : graph.arcs)
    if (arc.alive) ++arcs_between[ends(arc)];
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const Index least = arc.hub[0] == arc.hub[1] ? 3 : arcs_between[ends(arc)] > 1 ? 2 : 1;
    const Index wanted = static_cast<Index>(std::ceil(arc_length(arc) / spacing - 1e-9));
    arc.points = detail::spaced_line(arc.points, std::max(least, wanted), solid);
  }
}

}  // namespace mspskel
