// Which component of the surface the parts of a graph stand for.
#pragma once

#include <string>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The component of the surface that each hub stands for; kNone where no vertex maps to it or its arcs. Throws
// UsageError if the graph's map is not of the vertices of the surface.
inline std::vector<Index> hub_components(const ArcGraph& graph, const SurfaceSnapshot& surface) {
  if (graph.arc_of_vertex.size() != surface.position.size())
    throw UsageError("the graph's map is of " + std::to_string(graph.arc_of_vertex.size()) +
                     " vertices, the surface has " + std::to_string(surface.position.size()));
  std::vector<Index> component(graph.hub_position.size(), kNone);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (graph.hub_of_vertex[v] != kNone) component[graph.hub_of_vertex[v]] = surface.component[v];
    if (graph.arc_of_vertex[v] == kNone) continue;
    for (const Index h : graph.arcs[graph.arc_of_vertex[v]].hub) component[h] = surface.component[v];
  }
  return component;
}

}  // namespace detail
}  // namespace mspskel
