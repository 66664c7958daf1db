// One arc in place of all that stands for a component.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// `component` is that of each hub before anything was replaced; hubs beyond it are of arcs laid since.
inline void replace_by_arc(ArcGraph& graph, const SurfaceSnapshot& surface,
                           const std::vector<Index>& component, Index c, std::vector<Vector3> points) {
  const auto belongs = [&](Index hub) {
    return hub < static_cast<Index>(component.size()) && component[hub] == c;
  };
  for (Arc& arc : graph.arcs)
    if (belongs(arc.hub[0])) arc.alive = false;
  for (Index h = 0; h < static_cast<Index>(component.size()); ++h)
    if (component[h] == c) graph.hub_alive[h] = false;
  Arc single;
  single.hub = {graph.add_hub(points.front()), graph.add_hub(points.back())};
  single.points = std::move(points);
  graph.arcs.push_back(std::move(single));
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone || surface.component[v] != c) continue;
    graph.arc_of_vertex[v] = graph.arc_count() - 1;
    graph.hub_of_vertex[v] = kNone;
  }
}

}  // namespace detail
}  // namespace mspskel
