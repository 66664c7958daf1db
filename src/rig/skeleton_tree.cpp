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
      : skeleton_(skeleton), tree_(tree), marked_(skeleton.nodes.size(), 0) {
    count_children();
  }

  std::vector<char> choose(Index wanted, const ProgressCallback& progress) {
    Index leaves = 0;
    for (const Index n : tree_.order) {
      if (left_out_[n]) continue;
      leaves += children_[n] == 0 ? 1 : 0;
      if (children_[n] != 1 || n == tree_.root()) mark(n);
    }
    merge_close_junctions();
    mark_limb_roots();
    mark_bends();
    constexpr Index kMost = 40, kLeast = 13, kLeastPerEnd = 3;
    const Index most = wanted > 0 ? wanted : kMost;
    const Index least = wanted > 0 ? wanted : std::min(kLeast, kLeastPerEnd * leaves);
    const auto ask = [&] { report_progress(progress, kRigStage, 0.1); };
    for (ask(); count_ > most && drop_least(); ask()) mark_bare_ends();
    while (count_ < least && split_longest()) ask();
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
  // Branches to which no vertex is mapped, as inside other shells, are left out: nothing would follow them.
  void count_children() {
    std::vector<char> followed(marked_.size(), 0);
    for (const Index n : skeleton_.node_of_vertex)
      if (n != kNone) followed[n] = 1;
    for (auto n = tree_.order.rbegin(); n != tree_.order.rend(); ++n)
      if (followed[*n] && tree_.parent[*n] != kNone) followed[tree_.parent[*n]] = 1;
    left_out_.assign(marked_.size(), 0);
    children_.assign(marked_.size(), 0);
    for (const Index n : tree_.order) {
      const Index up = tree_.parent[n];
      if (up == kNone) continue;
      left_out_[n] = left_out_[up] || (tree_.child_count[up] > 1 && !followed[n]) ? 1 : 0;
      children_[up] += left_out_[n] ? 0 : 1;
    }
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
      if (children_[n] > 1 && bone_length(n) < 0.5 * node(marked_above(tree_, marked_, n)).radius) unmark(n);
  }
  // What leaves a junction turns where it leaves its ball, and a limb that hardly does so at half its length:
  // each has a joint that bends it.
  void mark_limb_roots() {
    for (const Index n : joints())
      if (children_[bone(n)[0]] >= 2) mark_root_of(n, children_[n] == 0);
  }
  void mark_root_of(Index joint, bool is_end) {
    const std::vector<Index> nodes = bone(joint);
    const double whole = bone_length(joint), ball = half_width(nodes[0]);
    const double least = is_end ? std::min(ball, 0.5 * whole) : ball;
    double walked = 0;
    for (std::size_t i = 1; i + 1 < nodes.size() && walked < least; ++i) {
      walked += tree_.above[nodes[i]];
      if (walked >= least && (is_end || whole - walked > 0.5 * ball)) mark(nodes[i]);
    }
  }
  // A junction whose limbs were dropped has become an end, which wants a joint that bends it.
  void mark_bare_ends() {
    const std::vector<Index> below = bones_below();
    for (const Index n : joints())
      if (below[n] == 0 && children_[n] != 0 && limb_of(n, below).size() == 1) mark_root_of(n, true);
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
  // Per node how many bones hang on its joint.
  std::vector<Index> bones_below() const {
    std::vector<Index> below(marked_.size(), 0);
    for (const Index n : joints()) ++below[marked_above(tree_, marked_, n)];
    return below;
  }
  // The joints from where a limb leaves the body to its end.
  std::vector<Index> limb_of(Index end, const std::vector<Index>& below) const {
    std::vector<Index> joints;
    for (Index n = end; n != tree_.root() && (n == end || below[n] == 1); n = marked_above(tree_, marked_, n))
      joints.push_back(n);
    std::reverse(joints.begin(), joints.end());
    return joints;
  }
  // What is shortest: a bone, or a limb that has no bends left. While a limb stays it keeps its end and the
  // joint that bends it as a whole.
  bool drop_least() {
    std::vector<Index> dropped;
    double least = kInfinite;
    const auto consider = [&](double length, std::vector<Index> joints) {
      if (length >= least) return;
      least = length;
      dropped = std::move(joints);
    };
    std::vector<char> on_limb(marked_.size(), 0);
    const std::vector<Index> below = bones_below();
    for (const Index n : joints()) {
      if (below[n] != 0) continue;
      const std::vector<Index> limb = limb_of(n, below);
      for (const Index k : limb) on_limb[k] = 1;
      if (limb.size() <= 2) consider(bone_length(n) + (limb[0] != n ? bone_length(limb[0]) : 0.0), limb);
      for (std::size_t i = 1; i + 1 < limb.size(); ++i)
        consider(std::min(bone_length(limb[i]), bone_length(limb[i + 1])), {limb[i]});
    }
    for (const Index n : joints())
      if (!on_limb[n]) consider(bone_length(n), {n});
    for (const Index n : dropped) unmark(n);
    return !dropped.empty();
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
  std::vector<char> marked_, left_out_;  // per node
  std::vector<Index> children_;          // per node, without those that are left out
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

std::vector<char> choose_joints(const CurveSkeleton& skeleton, const SkeletonTree& tree, Index wanted,
                                const ProgressCallback& progress) {
  return JointChoice(skeleton, tree).choose(wanted, progress);
}

void turn_farther_out(const SkeletonTree& tree, Index node, std::vector<char>& marked) {
  std::vector<Index> way;  // from the next mark up to below the node
  for (const Index n : tree.order) {
    if (n == node || !marked[n] || marked_above(tree, marked, n) != node) continue;
    for (Index k = n; k != node; k = tree.parent[k]) way.push_back(k);
  }
  marked[node] = 0;
  double whole = 0, walked = 0;
  for (const Index n : way) whole += tree.above[n];
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    walked += tree.above[way[i]];
    if (2 * walked >= whole) {
      marked[way[i + 1]] = 1;
      return;
    }
  }
}

Index marked_above(const SkeletonTree& tree, const std::vector<char>& marked, Index node) {
  Index n = tree.parent[node];
  while (n != kNone && !marked[n]) n = tree.parent[n];
  return n;
}

}  // namespace mspskel::detail
