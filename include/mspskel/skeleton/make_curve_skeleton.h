// The collapse's multigraph as the result type: a simple graph in model coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mspskel/collapse/skeleton_decimater.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Nodes keep their order and the vertices that map to them. Of parallel edges the first stays as it is and
// each other one is split by a node of its own halfway, which no vertex maps to; a loop is split by two such
// nodes at its node's place. Radii are left 0. Cost: O(nodes + edges).
inline CurveSkeleton make_curve_skeleton(const CollapsedSkeleton& collapsed, const NormalisedFrame& frame) {
  CurveSkeleton result;
  result.node_of_vertex = collapsed.node_of_vertex;
  for (const CollapsedNode& node : collapsed.nodes)
    result.nodes.push_back({frame.to_model(node.position), 0.0, node.area * frame.scale * frame.scale,
                            node.perimeter * frame.scale, node.error});
  const auto add_node = [&](Index a, Index b) {
    const SkeletonNode u = result.nodes[a], v = result.nodes[b];
    result.nodes.push_back({(u.position + v.position) / 2, 0.0, 0.0, (u.perimeter + v.perimeter) / 2,
                            (u.slice_error + v.slice_error) / 2});
    return static_cast<Index>(result.nodes.size()) - 1;
  };
  const auto connect = [&](Index a, Index b) { result.edges.push_back({std::min(a, b), std::max(a, b)}); };
  for (std::size_t i = 0; i < collapsed.edges.size(); ++i) {
    const auto& [first, second, label] = collapsed.edges[i];
    const bool parallel =
        i > 0 && collapsed.edges[i - 1].first == first && collapsed.edges[i - 1].second == second;
    if (first != second && !parallel) {
      connect(first, second);
      continue;
    }
    const Index middle = add_node(first, second);
    connect(first, middle);
    if (first == second) {
      const Index other = add_node(first, second);
      connect(middle, other);
      connect(other, second);
    } else {
      connect(middle, second);
    }
  }
  std::sort(result.edges.begin(), result.edges.end());
  return result;
}

}  // namespace mspskel
