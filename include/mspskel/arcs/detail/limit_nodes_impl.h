#pragma once

#include <algorithm>
#include <limits>

#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

inline double distance_to_chord(const Vector3& x, const Vector3& a, const Vector3& b) {
  const Vector3 chord = b - a;
  const double square = chord.squaredNorm();
  const double t = square > 0 ? std::clamp((x - a).dot(chord) / square, 0.0, 1.0) : 0.0;
  return (x - (a + t * chord)).norm();
}

// Fewest points that the arc keeps as a simple graph: a loop needs two inner ones, one of parallel arcs one.
inline std::size_t least_points(const ArcGraph& graph, Index arc) {
  const Arc& a = graph.arcs[arc];
  if (a.hub[0] == a.hub[1]) return 4;
  for (Index b = 0; b < graph.arc_count(); ++b) {
    const Arc& other = graph.arcs[b];
    if (b != arc && other.alive &&
        ((other.hub[0] == a.hub[0] && other.hub[1] == a.hub[1]) ||
         (other.hub[0] == a.hub[1] && other.hub[1] == a.hub[0])))
      return 3;
  }
  return 2;
}

}  // namespace detail

MSPSKEL_INLINE Index limit_nodes(ArcGraph& graph, const BoundingVolumeHierarchy& solid, Index nodes,
                                 const CrossingLabels& crossings) {
  // Per arc and point: how far it lies off its neighbours' chord; infinite where it has to stay.
  constexpr double kStays = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> offset(graph.arcs.size());
  std::vector<std::size_t> least(graph.arcs.size(), 2);
  Index count = static_cast<Index>(std::count(graph.hub_alive.begin(), graph.hub_alive.end(), true));
  const auto measure = [&](Index a, std::size_t i) {
    const auto& p = graph.arcs[a].points;
    offset[a][i] = i == 0 || i + 1 >= p.size() ? kStays : detail::distance_to_chord(p[i], p[i - 1], p[i + 1]);
  };
  for (Index a = 0; a < graph.arc_count(); ++a) {
    if (!graph.arcs[a].alive) continue;
    least[a] = detail::least_points(graph, a);
    offset[a].assign(graph.arcs[a].points.size(), kStays);
    for (std::size_t i = 0; i < offset[a].size(); ++i) measure(a, i);
    count += static_cast<Index>(graph.arcs[a].points.size()) - 2;
  }
  while (count > nodes) {
    Index arc = kNone;
    std::size_t point = 0;
    double smallest = kStays;
    for (Index a = 0; a < graph.arc_count(); ++a) {
      if (offset[a].size() <= least[a]) continue;
      const auto at = std::min_element(offset[a].begin(), offset[a].end());
      if (*at >= smallest) continue;
      smallest = *at;
      arc = a;
      point = static_cast<std::size_t>(at - offset[a].begin());
    }
    if (arc == kNone) break;
    auto& p = graph.arcs[arc].points;
    if (solid.segment_crosses(p[point - 1], p[point + 1]) ||
        crossings.goes_round({p[point - 1], p[point], p[point + 1]})) {
      offset[arc][point] = kStays;
      continue;
    }
    p.erase(p.begin() + static_cast<std::ptrdiff_t>(point));
    offset[arc].erase(offset[arc].begin() + static_cast<std::ptrdiff_t>(point));
    measure(arc, point - 1);
    measure(arc, point);
    --count;
  }
  return count;
}

}  // namespace mspskel
