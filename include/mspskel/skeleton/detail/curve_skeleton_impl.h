#pragma once

#include <algorithm>
#include <numeric>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE std::vector<std::vector<Index>> adjacency(const CurveSkeleton& skeleton) {
  std::vector<std::vector<Index>> next(skeleton.nodes.size());
  for (const auto& [a, b] : skeleton.edges) {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  for (auto& list : next) std::sort(list.begin(), list.end());
  return next;
}

MSPSKEL_INLINE std::vector<Branch> branches(const CurveSkeleton& skeleton) {
  const auto next = adjacency(skeleton);
  std::vector<std::vector<bool>> walked(next.size());
  for (std::size_t v = 0; v < next.size(); ++v) walked[v].assign(next[v].size(), false);
  std::vector<Branch> result;
  const auto mark = [&](Index a, Index b) {
    const auto& list = next[a];
    walked[a][static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), b) - list.begin())] = true;
  };
  const auto walk = [&](Index start, std::size_t slot) {
    Branch branch{{start, next[start][slot]}};
    mark(branch.nodes[0], branch.nodes[1]);
    mark(branch.nodes[1], branch.nodes[0]);
    while (next[branch.nodes.back()].size() == 2 && branch.nodes.back() != start) {
      const Index here = branch.nodes.back(), came = branch.nodes[branch.nodes.size() - 2];
      const Index onward = next[here][0] == came ? next[here][1] : next[here][0];
      mark(here, onward);
      mark(onward, here);
      branch.nodes.push_back(onward);
    }
    result.push_back(std::move(branch));
  };
  // Chains between leaves and joints first, then the closed chains that have neither.
  for (const bool closed : {false, true})
    for (Index v = 0; v < static_cast<Index>(next.size()); ++v)
      for (std::size_t slot = 0; slot < next[v].size(); ++slot)
        if (!walked[v][slot] && (closed || next[v].size() != 2)) walk(v, slot);
  std::sort(result.begin(), result.end(), [](const Branch& a, const Branch& b) { return a.nodes < b.nodes; });
  return result;
}

MSPSKEL_INLINE GraphCounts count_graph(const CurveSkeleton& skeleton) {
  GraphCounts counts;
  counts.nodes = static_cast<Index>(skeleton.nodes.size());
  counts.edges = static_cast<Index>(skeleton.edges.size());
  std::vector<Index> parent(skeleton.nodes.size()), degree(skeleton.nodes.size(), 0);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index x) {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  };
  counts.components = counts.nodes;
  for (const auto& [a, b] : skeleton.edges) {
    ++degree[a];
    ++degree[b];
    counts.length += (skeleton.nodes[a].position - skeleton.nodes[b].position).norm();
    const Index ra = root(a), rb = root(b);
    if (ra != rb) {
      parent[ra] = rb;
      --counts.components;
    }
  }
  counts.cycles = counts.edges - counts.nodes + counts.components;
  counts.leaves = static_cast<Index>(std::count(degree.begin(), degree.end(), 1));
  counts.joints =
      static_cast<Index>(std::count_if(degree.begin(), degree.end(), [](Index d) { return d >= 3; }));
  return counts;
}

}  // namespace mspskel
