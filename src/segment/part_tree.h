// One part's nodes as a tree walked depth first: which of its edges are bridges, and what lies beyond each.
#pragma once

#include <vector>

#include "mspskel/segment/find_parts.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

struct PartTree {
  std::vector<Index> order;    // the part's nodes, parents before their children
  std::vector<Index> parent;   // per node of the skeleton; kNone at the root and outside of the part
  std::vector<Index> place;    // per node: in `order`; kNone outside of the part
  std::vector<Index> low;      // per node: least place that its subtree reaches by one more edge
  std::vector<double> area;    // per node: of its subtree, model units squared
  std::vector<double> border;  // per node: between its subtree and the rest of the part, model units

  // Whether the part falls apart without the edge from n to its parent.
  bool is_bridge(Index n) const { return parent[n] != kNone && low[n] > place[parent[n]]; }
};

// Of the part that `root` is in. O(nodes + contacts * depth).
PartTree make_part_tree(const CurveSkeleton& skeleton, const std::vector<std::vector<Index>>& neighbours,
                        const std::vector<NodeContact>& contacts, const std::vector<Index>& part_of_node,
                        Index root);

}  // namespace mspskel::detail
