#include "skeleton_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace mspskel::detail {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double length(const CurveSkeleton& skeleton, Index a, Index b) {
  return (skeleton.nodes[a].position - skeleton.nodes[b].position).norm();
}

// Adds what hangs together with `start` to the tree, by shortest ways from it.
void grow(const CurveSkeleton& skeleton, const std::vector<std::vector<Index>>& next, Index start,
          SkeletonTree& tree, std::vector<char>& done) {
  std::vector<double> distance(next.size(), kInfinite);
  using Item = std::pair<double, Index>;
  std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
  distance[start] = 0;
  queue.push({0.0, start});
  while (!queue.empty()) {
    const auto [d, n] = queue.top();
    queue.pop();
    if (done[n]) continue;
    done[n] = 1;
    tree.order.push_back(n);
    for (const Index k : next[n]) {
      const double there = d + length(skeleton, n, k);
      if (done[k] || there >= distance[k]) continue;
      distance[k] = there;
      tree.parent[k] = n;
      tree.above[k] = length(skeleton, n, k);
      queue.push({there, k});
    }
  }
}

SkeletonTree tree_from(const CurveSkeleton& skeleton, Index root) {
  const auto next = adjacency(skeleton);
  const Index count = static_cast<Index>(skeleton.nodes.size());
  SkeletonTree tree;
  tree.parent.assign(count, kNone);
  tree.above.assign(count, 0.0);
  tree.child_count.assign(count, 0);
  std::vector<char> done(count, 0);
  grow(skeleton, next, root, tree, done);
  for (Index n = 0; n < count; ++n) {
    if (done[n]) continue;
    grow(skeleton, next, n, tree, done);
    tree.parent[n] = root;
    tree.above[n] = length(skeleton, n, root);
  }
  for (const auto& [a, b] : skeleton.edges)
    if (tree.parent[a] != b && tree.parent[b] != a) tree.cut.push_back({a, b});
  for (Index n = 0; n < count; ++n)
    if (tree.parent[n] != kNone) ++tree.child_count[tree.parent[n]];
  return tree;
}

// The node of a piece from which the summed distance to the piece's area is least: from any node downhill, to
// the child that has more than half of the area below it.
Index median_node(const CurveSkeleton& skeleton, const SkeletonTree& tree) {
  std::vector<double> below(skeleton.nodes.size());
  double whole = 0;
  for (std::size_t n = 0; n < below.size(); ++n) whole += below[n] = skeleton.nodes[n].area;
  for (auto n = tree.order.rbegin(); n != tree.order.rend(); ++n)
    if (tree.parent[*n] != kNone) below[tree.parent[*n]] += below[*n];
  Index median = tree.root();
  for (const Index n : tree.order)
    if (tree.parent[n] == median && below[n] > 0.5 * whole) median = n;
  return median;
}

class JointChoice {
 public:
  JointChoice(const CurveSkeleton& skeleton, const SkeletonTree& tree)
      : skeleton_(skeleton), tree_(tree), marked_(skeleton.nodes.size(), 0) {}

  std::vector<char> choose(Index wanted) {
    Index leaves = 0;
    for (const Index n : tree_.order) {
      leaves += tree_.child_count[n] == 0 ? 1 : 0;
      if (tree_.child_count[n] != 1 || n == tree_.root()) mark(n);
    }
    merge_close_junctions();
    mark_limb_roots();
    mark_bends();
    constexpr Index kMost = 40, kLeast = 13, kLeastPerEnd = 3;
    const Index most = wanted > 0 ? wanted : kMost;
    const Index least = wanted > 0 ? wanted : std::min(kLeast, kLeastPerEnd * leaves);
    while (count_ > most && drop_shortest()) {
    }
    while (count_ < least && split_longest()) {
    }
    return marked_;
  }

 private:
  void mark(Index n) {
    count_ += marked_[n] ? 0 : 1;
    marked_[n] = 1;
  }
  void unmark(Index n) {
    count_ -= marked_[n] ? 1 : 0;
    marked_[n] = 0;
  }
  const SkeletonNode& node(Index n) const { return skeleton_.nodes[n]; }
  double half_width(Index n) const { return detail::half_width(node(n)); }
  // Nodes from the joint above `joint` down to it.
  std::vector<Index> bone(Index joint) const {
    std::vector<Index> nodes{joint};
    while (nodes.size() == 1 || !marked_[nodes.back()]) nodes.push_back(tree_.parent[nodes.back()]);
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }
  double bone_length(Index joint) const {
    double sum = 0;
    Index n = joint;
    do {
      sum += tree_.above[n];
      n = tree_.parent[n];
    } while (!marked_[n]);
    return sum;
  }
  std::vector<Index> joints() const {
    std::vector<Index> list;
    for (const Index n : tree_.order)
      if (marked_[n] && n != tree_.root()) list.push_back(n);
    return list;
  }

  // A junction well within the ball of the one above is the same place.
  void merge_close_junctions() {
    for (const Index n : joints())
      if (tree_.child_count[n] > 1 && bone_length(n) < 0.5 * node(marked_above(tree_, marked_, n)).radius)
        unmark(n);
  }
  // What leaves a junction turns where it leaves its ball.
  void mark_limb_roots() {
    for (const Index n : joints()) {
      const std::vector<Index> nodes = bone(n);
      if (tree_.child_count[nodes[0]] < 2) continue;
      const double whole = bone_length(n), radius = half_width(nodes[0]);
      double walked = 0;
      for (std::size_t i = 1; i + 1 < nodes.size() && walked < radius; ++i) {
        walked += tree_.above[nodes[i]];
        if (walked >= radius && whole - walked > 0.5 * radius) mark(nodes[i]);
      }
    }
  }
  // Farther from the straight bone than most of the limb's thickness.
  void mark_bends() {
    std::vector<Index> open = joints();
    while (!open.empty()) {
      const std::vector<Index> nodes = bone(open.back());
      const Vector3 a = node(nodes.front()).position, b = node(nodes.back()).position;
      double farthest = 1.0;
      Index bend = kNone;
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
        const Vector3& x = node(nodes[i]).position;
        const double square = (b - a).squaredNorm();
        const double t = square > 0 ? std::clamp((x - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
        const double off =
            (x - a - t * (b - a)).norm() / std::max(0.8 * node(nodes[i]).radius, 0.04 * std::sqrt(square));
        if (off > farthest) {
          farthest = off;
          bend = nodes[i];
        }
      }
      if (bend == kNone) {
        open.pop_back();
        continue;
      }
      mark(bend);
      open.push_back(bend);
    }
  }
  bool drop_shortest() {
    Index shortest = kNone;
    double least = kInfinite;
    for (const Index n : joints())
      if (const double l = bone_length(n); l < least) {
        least = l;
        shortest = n;
      }
    if (shortest != kNone) unmark(shortest);
    return shortest != kNone;
  }
  // At the node nearest to the middle of the longest bone that has inner nodes.
  bool split_longest() {
    double most = 0;
    Index at = kNone;
    for (const Index n : joints()) {
      const double whole = bone_length(n);
      if (whole <= most) continue;
      double nearest = kInfinite, walked = 0;
      for (Index k = n; !marked_[tree_.parent[k]];) {
        walked += tree_.above[k];
        k = tree_.parent[k];
        if (const double off = std::abs(walked - 0.5 * whole); off < nearest) {
          nearest = off;
          at = k;
          most = whole;
        }
      }
    }
    if (at != kNone) mark(at);
    return at != kNone;
  }

  const CurveSkeleton& skeleton_;
  const SkeletonTree& tree_;
  std::vector<char> marked_;
  Index count_ = 0;
};

}  // namespace

double half_width(const SkeletonNode& node) { return std::max(node.radius, node.perimeter / (2 * kPi)); }

SkeletonTree make_skeleton_tree(const CurveSkeleton& skeleton) {
  const Index median = median_node(skeleton, tree_from(skeleton, 0));
  SkeletonTree tree = tree_from(skeleton, median);
  Index root = median;
  double least = skeleton.nodes[median].radius;
  for (const Index n : tree.order) {
    double distance = 0;
    for (Index k = n; k != median; k = tree.parent[k]) distance += tree.above[k];
    if (tree.child_count[n] > 1 && distance < least) {
      least = distance;
      root = n;
    }
  }
  return root == median ? tree : tree_from(skeleton, root);
}

std::vector<char> choose_joints(const CurveSkeleton& skeleton, const SkeletonTree& tree, Index wanted) {
  return JointChoice(skeleton, tree).choose(wanted);
}

Index marked_above(const SkeletonTree& tree, const std::vector<char>& marked, Index node) {
  Index n = tree.parent[node];
  while (n != kNone && !marked[n]) n = tree.parent[n];
  return n;
}

}  // namespace mspskel::detail
