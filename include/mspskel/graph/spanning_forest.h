// A skeleton as trees: for formats and users that know no loops.
#pragma once

#include <array>
#include <vector>

#include "mspskel/graph/curve_skeleton.h"

namespace mspskel {

// A breadth-first tree of every component, from its smallest node.
struct SpanningForest {
  std::vector<Index> order;               // all nodes, parents first
  std::vector<Index> parent;              // per node; kNone for a root
  std::vector<std::array<Index, 2>> cut;  // the edges that are left, one for each independent cycle
};

// O(nodes + edges).
inline SpanningForest span(const CurveSkeleton& skeleton) {
  const auto neighbors = adjacency(skeleton);
  const auto count = static_cast<Index>(skeleton.nodes.size());
  SpanningForest forest;
  forest.parent.assign(skeleton.nodes.size(), kNone);
  std::vector<char> seen(skeleton.nodes.size(), 0);
  for (Index root = 0; root < count; ++root) {
    if (seen[root]) continue;
    seen[root] = 1;
    std::size_t at = forest.order.size();
    for (forest.order.push_back(root); at < forest.order.size(); ++at) {
      const Index v = forest.order[at];
      for (const Index w : neighbors[v]) {
        if (seen[w]) continue;
        seen[w] = 1;
        forest.parent[w] = v;
        forest.order.push_back(w);
      }
    }
  }
  for (const auto& [a, b] : skeleton.edges)
    if (forest.parent[a] != b && forest.parent[b] != a) forest.cut.push_back({a, b});
  return forest;
}

}  // namespace mspskel
