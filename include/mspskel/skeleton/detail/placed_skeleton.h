// A skeleton whose nodes know their components, with the solids of these.
#pragma once

#include "mspskel/mesh/solid_hierarchies.h"
#include "mspskel/skeleton/polyline_graph.h"

namespace mspskel {
namespace detail {

// Every node and edge is measured in the solid of the component that it stands for.
struct PlacedSkeleton {
  PolylineGraph graph;  // the component of every node is known
  const SolidHierarchies& solids;

  PlacedSkeleton(const SurfaceSnapshot& surface, const SolidHierarchies& of_surface,
                 const CurveSkeleton& skeleton)
      : graph(polyline_graph(surface, skeleton)), solids(of_surface) {
    graph.component = find_components(surface, solids.whole(), solids, graph, pieces_of(graph));
  }
  const BoundingVolumeHierarchy& solid_of(Index node) const { return solids(graph.component[node]); }
};

}  // namespace detail
}  // namespace mspskel
