// For stages that follow the surface map from every vertex to its node.
#pragma once

#include <string>

#include "mspskel/base/error.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Throws UsageError unless the map has an entry a vertex, and a node of the skeleton for each that has faces.
// O(vertices).
inline void check_surface_map(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  if (static_cast<Index>(skeleton.node_of_vertex.size()) != surface.vertex_count())
    throw UsageError("the skeleton's surface map has " + std::to_string(skeleton.node_of_vertex.size()) +
                     " entries for " + std::to_string(surface.vertex_count()) + " vertices");
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Index n = skeleton.node_of_vertex[v];
    if (surface.vertex_halfedge[v] != kNone && (n < 0 || n >= static_cast<Index>(skeleton.nodes.size())))
      throw UsageError("vertex " + std::to_string(v) + " maps to no node of the skeleton");
  }
}

}  // namespace mspskel
