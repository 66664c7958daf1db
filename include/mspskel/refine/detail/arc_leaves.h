// The leaf arcs of a graph, the vertices on them, and which of them stand for the limbs of the surface.
#pragma once

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

inline constexpr std::size_t kNoLeaf = static_cast<std::size_t>(-1);

struct LeafArc {
  Index arc, joint, tip;  // the joint and the tip are the arc's two hubs
};

struct ArcLeaves {
  std::vector<LeafArc> leaf;
  std::vector<std::vector<Index>> vertices;  // per leaf: those of the arc and of its tip

  ArcLeaves(const ArcGraph& graph, const std::vector<std::vector<Index>>& at) {
    std::vector<std::size_t> of_arc(graph.arcs.size(), kNoLeaf), of_hub(graph.hub_position.size(), kNoLeaf);
    for (Index a = 0; a < graph.arc_count(); ++a) {
      if (!graph.arcs[a].alive) continue;
      for (const int end : {0, 1}) {
        const Index tip = graph.arcs[a].hub[end], joint = graph.arcs[a].hub[1 - end];
        if (at[tip].size() != 1 || at[joint].size() < 3) continue;
        of_arc[a] = of_hub[tip] = leaf.size();
        leaf.push_back({a, joint, tip});
      }
    }
    vertices.resize(leaf.size());
    for (Index v = 0; v < static_cast<Index>(graph.arc_of_vertex.size()); ++v) {
      const Index arc = graph.arc_of_vertex[v], hub = graph.hub_of_vertex[v];
      const std::size_t i = arc != kNone ? of_arc[arc] : hub != kNone ? of_hub[hub] : kNoLeaf;
      if (i != kNoLeaf) vertices[i].push_back(v);
    }
  }
};

// Gives a leaf arc the points from its joint to its tip.
inline void set_leaf_points(ArcGraph& graph, const LeafArc& leaf, std::vector<Vector3> points) {
  Arc& arc = graph.arcs[leaf.arc];
  graph.hub_position[leaf.tip] = points.back();
  if (arc.hub[1] == leaf.joint) std::reverse(points.begin(), points.end());
  arc.points = std::move(points);
}

inline std::vector<Vector3> leaf_points(const ArcGraph& graph, const LeafArc& leaf) {
  const Arc& arc = graph.arcs[leaf.arc];
  return points_from(arc, arc.hub[1] == leaf.joint ? 1 : 0);
}

// Pairs (distance, tip, leaf) of what could have each other: for each tip the place of the leaf that it gets,
// or kNoLeaf. The nearest come first, and each tip and leaf has one at most.
inline std::vector<std::size_t> nearest_pairs(std::vector<std::tuple<double, std::size_t, std::size_t>> pairs,
                                              std::size_t tip_count, std::size_t leaf_count) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::size_t> leaf_of_tip(tip_count, kNoLeaf);
  std::vector<bool> taken(leaf_count, false);
  for (const auto& [distance, t, i] : pairs) {
    if (leaf_of_tip[t] != kNoLeaf || taken[i]) continue;
    leaf_of_tip[t] = i;
    taken[i] = true;
  }
  return leaf_of_tip;
}

// For each tip the leaf arc that stands for it, as a place in leaves.leaf, or kNoLeaf: one that has a third
// of its cap or more. Where several tips or arcs could have each other, those whose ends are nearest do.
inline std::vector<std::size_t> leaves_of_tips(const ArcGraph& graph, const ArcLeaves& leaves,
                                               const std::vector<LimbTip>& tips) {
  constexpr double kShare = 1.0 / 3;
  std::vector<std::size_t> leaf_of_vertex(graph.arc_of_vertex.size(), kNoLeaf);
  for (std::size_t i = 0; i < leaves.leaf.size(); ++i)
    for (const Index v : leaves.vertices[i]) leaf_of_vertex[v] = i;
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, tip, leaf
  std::vector<std::size_t> count(leaves.leaf.size());
  for (std::size_t t = 0; t < tips.size(); ++t) {
    std::fill(count.begin(), count.end(), 0);
    for (const Index v : tips[t].cap)
      if (leaf_of_vertex[v] != kNoLeaf) ++count[leaf_of_vertex[v]];
    for (std::size_t i = 0; i < count.size(); ++i)
      if (static_cast<double>(count[i]) >= kShare * static_cast<double>(tips[t].cap.size()))
        pairs.emplace_back((graph.hub_position[leaves.leaf[i].tip] - tips[t].target).norm(), t, i);
  }
  return nearest_pairs(std::move(pairs), tips.size(), leaves.leaf.size());
}

}  // namespace detail
}  // namespace mspskel
