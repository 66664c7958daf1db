// A skeleton as trees: for formats and users that know no loops.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Where a tree begins, in the component that is meant; in every other one at its thickest node.
struct RootChoice {
  enum class Kind {
    kThickest,  // the node of the greatest radius
    kTip,       // the leaf of the greatest radius: a vessel's inlet
    kPoint,     // the node nearest to `point`, in its component; model units
  };
  Kind kind = Kind::kThickest;
  Vector3 point = Vector3::Zero();
};

// The tree of each component.
struct SpanningForest {
  std::vector<Index> order;               // all nodes, parents first, a component after the other
  std::vector<Index> parent;              // per node; kNone for a root
  std::vector<std::array<Index, 2>> cut;  // the edges that are left, one for each independent cycle
};

namespace detail {

inline double edge_radius(const CurveSkeleton& skeleton, const std::array<Index, 2>& edge) {
  return std::min(skeleton.nodes[edge[0]].radius, skeleton.nodes[edge[1]].radius);
}

// The nodes in the order in which they are tried as roots.
inline std::vector<Index> root_order(const CurveSkeleton& skeleton,
                                     const std::vector<std::vector<Index>>& neighbours,
                                     const RootChoice& choice) {
  std::vector<Index> order(skeleton.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto comes_before = [&](Index a, Index b) {
    if (choice.kind == RootChoice::Kind::kTip && (neighbours[a].size() == 1) != (neighbours[b].size() == 1))
      return neighbours[a].size() == 1;
    const double ra = skeleton.nodes[a].radius, rb = skeleton.nodes[b].radius;
    return ra != rb ? ra > rb : a < b;
  };
  std::sort(order.begin(), order.end(), comes_before);
  if (choice.kind != RootChoice::Kind::kPoint || order.empty()) return order;
  const auto nearest = std::min_element(order.begin(), order.end(), [&](Index a, Index b) {
    return (skeleton.nodes[a].position - choice.point).squaredNorm() <
           (skeleton.nodes[b].position - choice.point).squaredNorm();
  });
  std::rotate(order.begin(), nearest, nearest + 1);
  return order;
}

}  // namespace detail

// A loop is cut at its thinnest edge, that is between the two nodes of the least radius (a maximum spanning
// tree, Kruskal 1956). Nodes follow breadth first. O((nodes + edges) log).
inline SpanningForest span(const CurveSkeleton& skeleton, const RootChoice& choice = {}) {
  SpanningForest forest;
  std::vector<Index> order(skeleton.edges.size()), above(skeleton.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return detail::edge_radius(skeleton, skeleton.edges[a]) >
           detail::edge_radius(skeleton, skeleton.edges[b]);
  });
  std::iota(above.begin(), above.end(), 0);
  const auto top = [&](Index v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
  };
  CurveSkeleton tree;
  tree.nodes.resize(skeleton.nodes.size());
  for (const Index e : order) {
    const auto [a, b] = skeleton.edges[e];
    const Index ta = top(a), tb = top(b);
    (ta == tb ? forest.cut : tree.edges).push_back(skeleton.edges[e]);
    above[ta] = tb;
  }
  std::sort(forest.cut.begin(), forest.cut.end());
  const auto neighbours = adjacency(tree);
  forest.parent.assign(skeleton.nodes.size(), kNone);
  std::vector<char> seen(skeleton.nodes.size(), 0);
  for (const Index root : detail::root_order(skeleton, adjacency(skeleton), choice)) {
    if (seen[root]) continue;
    seen[root] = 1;
    std::size_t at = forest.order.size();
    for (forest.order.push_back(root); at < forest.order.size(); ++at) {
      const Index v = forest.order[at];
      for (const Index w : neighbours[v]) {
        if (seen[w]) continue;
        seen[w] = 1;
        forest.parent[w] = v;
        forest.order.push_back(w);
      }
    }
  }
  return forest;
}

// Whether a root is a cell body: at least three times as thick as the median node that its ball leaves out.
inline bool is_soma(const CurveSkeleton& skeleton, Index root) {
  constexpr double kStandsOut = 3.0;
  const SkeletonNode& soma = skeleton.nodes[root];
  std::vector<double> others;
  for (const SkeletonNode& node : skeleton.nodes)
    if ((node.position - soma.position).norm() > soma.radius) others.push_back(node.radius);
  if (others.empty()) return false;
  const auto middle = others.begin() + static_cast<std::ptrdiff_t>(others.size() / 2);
  std::nth_element(others.begin(), middle, others.end());
  return soma.radius >= kStandsOut * *middle;
}

}  // namespace mspskel
