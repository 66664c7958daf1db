// Which component of the surface the parts of a graph stand for.
#pragma once

#include <string>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The component of the surface that each hub stands for; kNone in pieces of the graph that no vertex maps to.
// Throws UsageError if the graph's map is not of the vertices of the surface. Cost: linear.
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
  const auto at = graph.incidence();
  std::vector<Index> known;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (component[h] != kNone) known.push_back(h);
  for (std::size_t k = 0; k < known.size(); ++k)
    for (const Index a : at[known[k]])
      for (const Index h : graph.arcs[a].hub)
        if (component[h] == kNone) {
          component[h] = component[known[k]];
          known.push_back(h);
        }
  return component;
}

}  // namespace detail
}  // namespace mspskel
