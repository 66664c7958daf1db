#include "part_tree.h"

#include <algorithm>
#include <utility>

namespace mspskel::detail {
namespace {

void walk(PartTree& tree, const std::vector<std::vector<Index>>& neighbours,
          const std::vector<Index>& part_of_node, Index root) {
  std::vector<std::pair<Index, std::size_t>> stack;
  const auto enter = [&](Index n, Index from) {
    tree.parent[n] = from;
    tree.place[n] = tree.low[n] = static_cast<Index>(tree.order.size());
    tree.order.push_back(n);
    stack.push_back({n, 0});
  };
  enter(root, kNone);
  while (!stack.empty()) {
    const Index n = stack.back().first;
    if (stack.back().second == neighbours[n].size()) {
      stack.pop_back();
      if (!stack.empty()) tree.low[stack.back().first] = std::min(tree.low[stack.back().first], tree.low[n]);
      continue;
    }
    const Index k = neighbours[n][stack.back().second++];
    if (part_of_node[k] != part_of_node[n] || k == tree.parent[n]) continue;
    if (tree.place[k] == kNone)
      enter(k, n);
    else
      tree.low[n] = std::min(tree.low[n], tree.place[k]);
  }
}

}  // namespace

PartTree make_part_tree(const CurveSkeleton& skeleton, const std::vector<std::vector<Index>>& neighbours,
                        const std::vector<NodeContact>& contacts, const std::vector<Index>& part_of_node,
                        Index root) {
  const std::size_t count = skeleton.nodes.size();
  PartTree tree;
  tree.parent.assign(count, kNone);
  tree.place.assign(count, kNone);
  tree.low.assign(count, kNone);
  tree.area.assign(count, 0.0);
  tree.border.assign(count, 0.0);
  walk(tree, neighbours, part_of_node, root);
  for (auto n = tree.order.rbegin(); n != tree.order.rend(); ++n) {
    tree.area[*n] += skeleton.nodes[*n].area;
    if (tree.parent[*n] != kNone) tree.area[tree.parent[*n]] += tree.area[*n];
  }
  // A contact is cut by the edges of the way between its two nodes.
  for (const NodeContact& contact : contacts) {
    Index a = contact.nodes[0], b = contact.nodes[1];
    if (tree.place[a] == kNone || tree.place[b] == kNone) continue;
    while (a != b) {
      if (tree.place[a] < tree.place[b]) std::swap(a, b);
      tree.border[a] += contact.length;
      a = tree.parent[a];
    }
  }
  return tree;
}

}  // namespace mspskel::detail
