// A skeleton in the frame of its surface, as the certificate and the measures take it.
#pragma once

#include "mspskel/collapse/piece_components.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Points and edges of the skeleton in normalised units, with the component that each node stands for as far
// as the surface map says. Throws UsageError for a map that names no node.
inline PolylineGraph polyline_graph(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  PolylineGraph graph;
  for (const SkeletonNode& node : skeleton.nodes)
    graph.position.push_back(surface.frame.to_normalised(node.position));
  graph.edges = skeleton.edges;
  graph.component =
      component_of_nodes(surface, static_cast<Index>(skeleton.nodes.size()), skeleton.node_of_vertex);
  return graph;
}

}  // namespace mspskel
