// The certificate of what an extraction made.
#pragma once

#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel::test {

inline TopologyCertificate certificate_of(const ExtractResult& result) {
  PolylineGraph graph;
  for (const SkeletonNode& node : result.skeleton.nodes)
    graph.position.push_back(result.surface.frame.to_normalised(node.position));
  graph.edges = result.skeleton.edges;
  graph.component = component_of_nodes(result.surface, static_cast<Index>(result.skeleton.nodes.size()),
                                       result.skeleton.node_of_vertex);
  return certify_topology(result.surface, result.cocycles, BoundingVolumeHierarchy(result.surface), graph);
}

}  // namespace mspskel::test
