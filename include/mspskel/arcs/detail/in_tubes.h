// Where the arcs of a shell run in tubes: handles, spouts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/arcs/center_arcs.h"
#include "mspskel/base/value_at_rank.h"

namespace mspskel {
namespace detail {

// Which points of a polyline lie in tubes: where sections are round for some widths on end. Such a stretch
// counts less one radius at either end, where the tube widens into the wall.
inline std::vector<std::uint8_t> in_tubes(const std::vector<Vector3>& points,
                                          const BoundingVolumeHierarchy& solid) {
  constexpr double kTube = 0.45;   // roundness of a tube's section
  constexpr double kLength = 3.0;  // of a tube, in radii of its sections
  const std::size_t n = points.size();
  std::vector<std::uint8_t> inside(n, 0);
  std::vector<double> radius(n, 0.0), walked(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) walked[i] = walked[i - 1] + (points[i] - points[i - 1]).norm();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 along = points[std::min(i + 2, n - 1)] - points[i > 2 ? i - 2 : 0];
    if (along.norm() == 0) continue;
    const VisibleSection section =
        visible_section(solid, points[i], along.normalized(), CenteringOptions().rays);
    if (section.closed && section.roundness >= kTube) radius[i] = section.radius;
  }
  for (std::size_t begin = 0; begin < n; ++begin) {
    if (radius[begin] == 0) continue;
    std::size_t end = begin;
    while (end + 1 < n && radius[end + 1] > 0) ++end;
    std::vector<double> radii(radius.begin() + static_cast<std::ptrdiff_t>(begin),
                              radius.begin() + static_cast<std::ptrdiff_t>(end + 1));
    const double width = value_at_rank(std::move(radii), 0.5);
    if (walked[end] - walked[begin] >= kLength * width)
      for (std::size_t i = begin; i <= end; ++i)
        inside[i] = walked[i] - walked[begin] >= width && walked[end] - walked[i] >= width;
    begin = end;
  }
  return inside;
}

// Lets a loop begin in the middle of its longest tube; false if it has none.
inline bool begin_in_tube(ArcGraph& graph, Index arc, const BoundingVolumeHierarchy& solid) {
  std::vector<Vector3>& points = graph.arcs[arc].points;
  points.pop_back();  // once in the ring
  const std::size_t n = points.size();
  std::vector<Vector3> twice(points);
  twice.insert(twice.end(), points.begin(), points.end());
  const std::vector<std::uint8_t> tube = in_tubes(twice, solid);
  std::size_t longest = 0, middle = 0;
  for (std::size_t i = 0, length = 0; i < tube.size(); ++i) {
    length = tube[i] ? length + 1 : 0;
    if (length > longest) {
      longest = length;
      middle = i - length / 2;
    }
  }
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle % n), points.end());
  points.push_back(points.front());
  graph.hub_position[graph.arcs[arc].hub[0]] = points.front();
  return longest > 0;
}

}  // namespace detail
}  // namespace mspskel
