#pragma once

#include <algorithm>
#include <tuple>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/collapsed_edges.h"

namespace mspskel {
namespace detail {

// The skeleton as a complex without faces, so that its rules guard the topology.
class BranchFilter {
 public:
  BranchFilter(const CollapsedSkeleton& skeleton, const BranchFilterOptions& options)
      : options_(options), nodes_(skeleton.nodes), complex_(static_cast<Index>(skeleton.nodes.size())) {
    result_.skeleton = skeleton;
    for (const CollapsedEdge& e : skeleton.edges) complex_.add_edge(e.first, e.second, e.label);
    parent_.assign(nodes_.size(), kNone);
  }

  BranchFilterResult run() {
    bool changed = true;
    while (changed) {
      changed = options_.drop_branches && drop_branches();
      changed = (options_.combine_joints && combine_joints()) || changed;
    }
    write_skeleton();
    return std::move(result_);
  }

 private:
  bool is_joint(Index v) const { return complex_.degree(v) >= 3; }
  double radius(Index v) const { return options_.ball_scale * nodes_[v].perimeter / (2 * kPi); }
  double distance(Index u, Index v) const { return (nodes_[u].position - nodes_[v].position).norm(); }

  // Nodes from a leaf to the joint that its branch leaves, both included; empty if there is no joint.
  std::vector<Index> leaf_branch(Index leaf) const {
    std::vector<Index> branch{leaf};
    Index dart = complex_.first_dart(leaf);
    while (true) {
      const Index here = complex_.target(dart);
      branch.push_back(here);
      if (is_joint(here)) return branch;
      if (complex_.degree(here) == 1) return {};
      const Index first = complex_.first_dart(here);
      dart = first == (dart ^ 1) ? complex_.next_dart(first) : first;
    }
  }

  bool drop_branches() {
    std::vector<std::tuple<double, Index>> inside;  // reach beyond the joint in radii, leaf
    for (Index v = 0; v < complex_.vertex_capacity(); ++v) {
      if (!complex_.is_vertex(v) || complex_.degree(v) != 1) continue;
      const std::vector<Index> branch = leaf_branch(v);
      if (branch.empty()) continue;
      double reach = 0;
      for (const Index node : branch) reach = std::max(reach, distance(node, branch.back()));
      if (reach <= radius(branch.back())) inside.emplace_back(reach, v);
    }
    std::sort(inside.begin(), inside.end());
    bool changed = false;
    for (const auto& [reach, leaf] : inside) {
      // A joint that lost all but two of its branches is none: what was a branch is part of a longer one.
      const std::vector<Index> branch = leaf_branch(leaf);
      if (branch.empty() || reach > radius(branch.back()) || distance(leaf, branch.back()) > reach) continue;
      drop(branch);
      changed = true;
    }
    return changed;
  }

  void drop(const std::vector<Index>& branch) {
    for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
      complex_.collapse(complex_.first_dart(branch[i]) / 2, branch[i + 1]);
      parent_[branch[i]] = branch.back();
      nodes_[branch.back()].set.merge(nodes_[branch[i]].set);
    }
    refresh(branch.back());
    ++result_.dropped_branches;
    result_.dropped_nodes += static_cast<Index>(branch.size()) - 1;
  }

  bool combine_joints() {
    std::vector<std::tuple<double, Index>> close;  // length, edge
    for (const Index e : living_edges(complex_)) {
      const auto [u, v] = complex_.ends(e);
      if (is_joint(u) && is_joint(v) && distance(u, v) <= std::min(radius(u), radius(v)))
        close.emplace_back(distance(u, v), e);
    }
    std::sort(close.begin(), close.end());
    bool changed = false;
    result_.refused_joints = 0;
    for (const auto& [length, e] : close) {
      if (!complex_.is_edge(e)) continue;
      const auto [u, v] = complex_.ends(e);
      if (distance(u, v) > std::min(radius(u), radius(v))) continue;
      const Index kept = std::min(u, v), gone = std::max(u, v);
      if (complex_.collapse(e, kept) != CollapseRefusal::kAllowed) {
        ++result_.refused_joints;
        continue;
      }
      parent_[gone] = kept;
      nodes_[kept].set.merge(nodes_[gone].set);
      refresh(kept);
      nodes_[kept].position = nodes_[kept].set.position();
      ++result_.combined_joints;
      changed = true;
    }
    return changed;
  }

  void refresh(Index v) {
    CollapsedNode& node = nodes_[v];
    node.area = node.set.area();
    node.perimeter = node.set.perimeter();
    node.error = node.set.error();
    node.normal = node.set.axis();
  }

  void write_skeleton() {
    CollapsedSkeleton& out = result_.skeleton;
    std::vector<Index> number(nodes_.size(), kNone);
    out.nodes.clear();
    for (Index v = 0; v < complex_.vertex_capacity(); ++v) {
      if (!complex_.is_vertex(v)) continue;
      number[v] = static_cast<Index>(out.nodes.size());
      out.nodes.push_back(nodes_[v]);
    }
    for (Index& node : out.node_of_vertex) {
      if (node == kNone) continue;
      while (parent_[node] != kNone) node = parent_[node];
      node = number[node];
    }
    out.edges = collapsed_edges(complex_, number);
    out.label_of_vertex.clear();
  }

  BranchFilterOptions options_;
  std::vector<CollapsedNode> nodes_;
  SkeletonComplex complex_;
  std::vector<Index> parent_;  // gone node -> the one that took it in
  BranchFilterResult result_;
};

}  // namespace detail

MSPSKEL_INLINE BranchFilterResult filter_branches(const CollapsedSkeleton& skeleton,
                                                  const BranchFilterOptions& options) {
  validate(options);
  return detail::BranchFilter(skeleton, options).run();
}

}  // namespace mspskel
