// Which of two arcs a vertex belongs to when one of them is new.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

inline double distance_to_points(const std::vector<Vector3>& points, const Vector3& x) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vector3& p : points) best = std::min(best, (p - x).squaredNorm());
  return best;
}

// Whether a point is nearer to the points of the arc `to` than to those of the arc `from`.
inline bool is_nearer(const ArcGraph& graph, const Vector3& x, Index to, Index from) {
  return distance_to_points(graph.arcs[to].points, x) < distance_to_points(graph.arcs[from].points, x);
}

// Gives the arc `to` what it is nearer to of the vertices of the arc `from`.
inline void give_near_vertices(ArcGraph& graph, const SurfaceSnapshot& surface, Index from, Index to) {
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (graph.arc_of_vertex[v] == from && is_nearer(graph, surface.position[v], to, from))
      graph.arc_of_vertex[v] = to;
}

}  // namespace detail
}  // namespace mspskel
