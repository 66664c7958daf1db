#pragma once

#include <limits>

#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// Replaces the arc's end at `hub` and the points that follow inside the ball by a straight line from the
// centre.
inline void enter_ball(Arc& arc, int end, const Vector3& centre, double radius) {
  if (end == 1) std::reverse(arc.points.begin(), arc.points.end());
  std::size_t first_outside = 1;
  while (first_outside + 1 < arc.points.size() && (arc.points[first_outside] - centre).norm() < radius)
    ++first_outside;
  // Keep the last point inside: from there on the arc is as it was.
  const std::size_t keep = first_outside > 1 ? first_outside - 1 : first_outside;
  std::vector<Vector3> points{centre};
  if (first_outside == 1) points.push_back(arc.points.front());
  points.insert(points.end(), arc.points.begin() + static_cast<std::ptrdiff_t>(keep), arc.points.end());
  arc.points = std::move(points);
  if (end == 1) std::reverse(arc.points.begin(), arc.points.end());
}

}  // namespace detail

MSPSKEL_INLINE Index merge_joints(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double overlap) {
  Index merged = 0;
  std::vector<double> radius(graph.hub_position.size(), 0.0);
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h]) radius[h] = solid.distance(graph.hub_position[h]);
  while (true) {
    const auto at = graph.incidence();
    Index best = kNone;
    double shortest = std::numeric_limits<double>::infinity();
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const Arc& arc = graph.arcs[a];
      if (!arc.alive || arc.hub[0] == arc.hub[1]) continue;
      if (at[arc.hub[0]].size() < 3 || at[arc.hub[1]].size() < 3) continue;
      const double distance = (arc.points.front() - arc.points.back()).norm();
      const double reach = overlap * std::min(radius[arc.hub[0]], radius[arc.hub[1]]);
      // An arc that leaves the balls goes round something and is no connection within them.
      if (distance >= reach || distance >= shortest || arc_length(arc) > 3 * std::max(reach, distance))
        continue;
      // Balls that overlap by less than a joint may have the surface between their centres.
      if (distance >= std::max(radius[arc.hub[0]], radius[arc.hub[1]]) &&
          solid.segment_crosses(arc.points.front(), arc.points.back()))
        continue;
      // Contracting one of two parallel arcs would make a loop of the other.
      bool parallel = false;
      for (const Index b : at[arc.hub[0]])
        parallel =
            parallel || (b != a && graph.arcs[b].hub[0] + graph.arcs[b].hub[1] == arc.hub[0] + arc.hub[1] &&
                         (graph.arcs[b].hub[0] == arc.hub[1] || graph.arcs[b].hub[1] == arc.hub[1]));
      if (parallel) continue;
      shortest = distance;
      best = a;
    }
    if (best == kNone) return merged;
    Arc& arc = graph.arcs[best];
    if (radius[arc.hub[0]] < radius[arc.hub[1]]) {
      std::swap(arc.hub[0], arc.hub[1]);
      std::reverse(arc.points.begin(), arc.points.end());
    }
    const Index keep = arc.hub[0], gone = arc.hub[1];
    const Vector3 centre = graph.hub_position[keep];
    for (const Index b : at[gone])
      if (b != best)
        for (const int end : {0, 1})
          if (graph.arcs[b].hub[end] == gone) detail::enter_ball(graph.arcs[b], end, centre, radius[keep]);
    contract_arc(graph, best, centre);
    ++merged;
  }
}

}  // namespace mspskel
