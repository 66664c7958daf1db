#include "close_seams.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <queue>

namespace mspskel::detail {
namespace {

// How far weights spread for each unit of the way that the map jumps. At a seam they change by half per
// reach; a joint at one end of the way that is turned by 45 degrees moves what is at the other by 0.77 of it,
// so with less than 0.38 faces turn over.
constexpr double kReach = 0.4;
// And at most in radii: where a limb's tip touches another's root, all of both would follow both.
constexpr double kMostReach = 4;
// Weights below this have no visible effect.
constexpr double kLeastWeight = 1e-3;

using Matrix = Eigen::SparseMatrix<double>;

class Seams {
 public:
  Seams(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const SkeletonTree& tree)
      : surface_(surface),
        node_of_vertex_(skeleton.node_of_vertex),
        tree_(tree),
        depth_(skeleton.nodes.size(), 0.0),
        level_(skeleton.nodes.size(), 0),
        reach_(surface.vertex_count(), 0.0) {
    for (const Index n : tree.order) {
      if (tree.parent[n] == kNone) continue;
      depth_[n] = depth_[tree.parent[n]] + tree.above[n] / surface.frame.scale;
      level_[n] = level_[tree.parent[n]] + 1;
    }
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index v = surface.origin[h], w = surface.target(h);
      if (node_of_vertex_[v] == node_of_vertex_[w]) continue;
      const double jump = way(node_of_vertex_[v], node_of_vertex_[w]) - surface_.edge_length(h);
      const double most = kMostReach * skeleton.nodes[node_of_vertex_[v]].radius / surface.frame.scale;
      reach_[v] = std::max(reach_[v], std::min(kReach * jump, most));
    }
    spread();
    for (Index v = 0; v < surface.vertex_count(); ++v)
      for_each_outgoing(v, [&](Index h) {
        if (reach_[v] > surface_.edge_length(h)) add(v);
      });
  }

  void close(std::vector<Weights>& weights) {
    if (active_.empty()) return;
    const Index count = static_cast<Index>(active_.size());
    std::vector<Index> column;  // per joint
    for (const Index v : active_) note(weights[v], column);
    for (const Index v : active_) for_each_neighbour(surface_, v, [&](Index w) { note(weights[w], column); });
    const Index joints = static_cast<Index>(joint_of_column_.size());
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(count, joints);
    std::vector<Eigen::Triplet<double>> entries;
    const auto add_to = [&](Index row, const Weights& from, double share) {
      for (const auto& [joint, weight] : from) given(row, column[joint]) += share * weight;
    };
    for (Index i = 0; i < count; ++i) {
      const Index v = active_[i];
      double own = 1;
      add_to(i, weights[v], 1);
      for_each_outgoing(v, [&](Index h) {
        const Index w = surface_.target(h);
        const double ratio = std::min(reach_[v], reach_[w]) / std::max(surface_.edge_length(h), 1e-12);
        const double flow = ratio * ratio;
        own += flow;
        if (place_[w] != kNone)
          entries.emplace_back(i, place_[w], -flow);
        else
          add_to(i, weights[w], flow);
      });
      entries.emplace_back(i, i, own);
    }
    Matrix system(count, count);
    system.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Matrix> solver(system);
    const Eigen::MatrixXd solution = solver.solve(given);
    for (Index i = 0; i < count; ++i) {
      Weights& settled = weights[active_[i]];
      settled.clear();
      for (Index k = 0; k < joints; ++k)
        if (solution(i, k) > kLeastWeight) settled.emplace_back(joint_of_column_[k], solution(i, k));
      std::sort(settled.begin(), settled.end());
    }
  }

 private:
  template <class Visit>
  void for_each_outgoing(Index v, Visit visit) const {
    const Index first = surface_.vertex_halfedge[v];
    if (first == kNone) return;
    Index h = first;
    do {
      visit(h);
      h = surface_.next_outgoing(h);
    } while (h != first);
  }
  // Along the tree, in the normalised frame.
  double way(Index a, Index b) const {
    const double sum = depth_[a] + depth_[b];
    while (a != b) {
      if (level_[a] < level_[b]) std::swap(a, b);
      a = tree_.parent[a];
    }
    return sum - 2 * depth_[a];
  }
  // A reach ends as far from its seam as it is long.
  void spread() {
    using Item = std::pair<double, Index>;
    std::priority_queue<Item> queue;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (reach_[v] > 0) queue.push({reach_[v], v});
    while (!queue.empty()) {
      const auto [reach, v] = queue.top();
      queue.pop();
      if (reach < reach_[v]) continue;
      for_each_outgoing(v, [&, here = reach](Index h) {
        const Index w = surface_.target(h);
        const double there = here - surface_.edge_length(h);
        if (there <= reach_[w]) return;
        reach_[w] = there;
        queue.push({there, w});
      });
    }
  }
  void add(Index v) {
    if (place_.empty()) place_.assign(surface_.vertex_count(), kNone);
    if (place_[v] != kNone) return;
    place_[v] = static_cast<Index>(active_.size());
    active_.push_back(v);
  }
  void note(const Weights& weights, std::vector<Index>& column) {
    for (const auto& entry : weights) {
      const Index joint = entry.first;
      if (joint >= static_cast<Index>(column.size())) column.resize(joint + 1, kNone);
      if (column[joint] != kNone) continue;
      column[joint] = static_cast<Index>(joint_of_column_.size());
      joint_of_column_.push_back(joint);
    }
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Index>& node_of_vertex_;
  const SkeletonTree& tree_;
  std::vector<double> depth_;  // per node: from the root
  std::vector<Index> level_;   // per node: edges from the root
  std::vector<double> reach_;  // per vertex
  std::vector<Index> place_;   // per vertex: in `active_`
  std::vector<Index> active_;  // vertices whose weights spread
  std::vector<Index> joint_of_column_;
};

}  // namespace

void close_seams(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const SkeletonTree& tree,
                 std::vector<Weights>& weights) {
  Seams(surface, skeleton, tree).close(weights);
}

}  // namespace mspskel::detail
