#include "mspskel/rig/make_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bone_shares.h"
#include "bound_slopes.h"
#include "joint_ways.h"
#include "mspskel/base/error.h"
#include "mspskel/skeleton/check_surface_map.h"
#include "name_joints.h"
#include "skeleton_tree.h"

namespace mspskel {
namespace {

using detail::BoneShare;
using detail::JointWays;
using detail::SkeletonTree;

void check_fit(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty()) throw UsageError("a rig needs a skeleton: this one has no nodes");
  check_surface_map(surface, skeleton);
}

// Of a vertex: a joint on the way from the root has what it is followed more than the next one.
class Influences {
 public:
  explicit Influences(const JointWays& ways) : ways_(ways) {}

  std::array<Influence, 4> of(Index v) {
    const BoneShare& share = ways_.of_map(v);
    if (share.share >= 1 && !ways_.is_lowered(v)) return {{{share.joint, 1.0}}};
    way_.clear();
    double below = 0;
    for (Index j = share.joint; j != kNone; j = ways_.above(j)) {
      const double weight = detail::smooth_share(ways_.at_on_way(v, j));
      if (weight != below) way_.push_back({j, weight - below});
      below = weight;
    }
    std::reverse(way_.begin(), way_.end());
    return strongest();
  }

 private:
  // At most four, each with a weight that can be seen. What the least one has goes to the joint above it that
  // is left, so what follows any other joint with all below it stays as it was.
  std::array<Influence, 4> strongest() {
    for (;;) {
      const auto least =
          std::min_element(way_.begin(), way_.end(),
                           [](const Influence& a, const Influence& b) { return a.weight < b.weight; });
      if (way_.size() == 1 || (way_.size() <= 4 && least->weight > detail::kLeastWeight)) break;
      (least == way_.begin() ? least + 1 : least - 1)->weight += least->weight;
      way_.erase(least);
    }
    std::sort(way_.begin(), way_.end(), [](const Influence& a, const Influence& b) {
      return a.weight > b.weight || (a.weight == b.weight && a.joint < b.joint);
    });
    std::array<Influence, 4> influences{};
    std::copy(way_.begin(), way_.end(), influences.begin());
    return influences;
  }

  const JointWays& ways_;
  std::vector<Influence> way_;  // from the root
};

std::vector<std::array<Influence, 4>> influences_of(const JointWays& ways, Index vertices) {
  std::vector<std::array<Influence, 4>> influences;
  influences.reserve(vertices);
  Influences made(ways);
  for (Index v = 0; v < vertices; ++v) influences.push_back(made.of(v));
  return influences;
}

void lay_joints(const CurveSkeleton& skeleton, const SkeletonTree& tree, const std::vector<char>& marked,
                Rig& rig) {
  rig.joints.clear();
  std::vector<Index> joint(skeleton.nodes.size(), kNone);
  for (const Index n : tree.order) {
    if (!marked[n]) continue;
    const Index above = detail::marked_above(tree, marked, n);
    joint[n] = static_cast<Index>(rig.joints.size());
    rig.joints.push_back({"", above == kNone ? kNone : joint[above], skeleton.nodes[n].position, n, kNone});
  }
}

// Per joint the first of the limb that it is on: what hangs on that one is a chain. kNone: on no limb.
std::vector<Index> limbs_of(const Rig& rig) {
  const Index count = static_cast<Index>(rig.joints.size());
  std::vector<Index> children(count, 0), first(count, kNone);
  for (Index j = 1; j < count; ++j) ++children[rig.joints[j].parent];
  for (Index end = 1; end < count; ++end) {
    if (children[end] != 0) continue;
    Index top = end;
    while (rig.joints[top].parent != 0 && children[rig.joints[top].parent] == 1) top = rig.joints[top].parent;
    for (Index j = end; j != rig.joints[top].parent; j = rig.joints[j].parent) first[j] = top;
  }
  return first;
}

std::vector<Index> first_joints(const std::vector<Index>& first) {
  std::vector<Index> joints;
  for (std::size_t j = 1; j < first.size(); ++j)
    if (first[j] == static_cast<Index>(j)) joints.push_back(first[j]);
  return joints;
}

// The first joints of limbs that nothing follows more than what they hang on.
std::vector<Index> idle_limbs(const Rig& rig, const std::vector<Index>& first) {
  std::vector<double> followed(rig.joints.size(), 0.0);
  for (const auto& influences : rig.influences) {
    // A vertex follows joints of one way from the root, so of one limb.
    double sum = 0;
    Index limb = kNone;
    for (const Influence& influence : influences)
      if (influence.weight > 0 && first[influence.joint] != kNone) {
        limb = first[influence.joint];
        sum += influence.weight;
      }
    if (limb != kNone) followed[limb] = std::max(followed[limb], sum);
  }
  std::vector<Index> idle;
  for (const Index j : first_joints(first))
    if (followed[j] < 0.5) idle.push_back(j);
  return idle;
}

// What follows a dropped joint follows the one that it hangs on.
void drop_joints(const std::vector<char>& dropped, Rig& rig) {
  std::vector<Index> stands_for(rig.joints.size(), 0);
  std::vector<RigJoint> kept;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const Index above = rig.joints[j].parent == kNone ? kNone : stands_for[rig.joints[j].parent];
    stands_for[j] = dropped[j] ? above : static_cast<Index>(kept.size());
    if (dropped[j]) continue;
    kept.push_back(rig.joints[j]);
    kept.back().parent = above;
  }
  rig.joints = std::move(kept);
  for (auto& influences : rig.influences) {
    std::array<Influence, 4> merged{};
    std::size_t count = 0;
    for (const Influence& influence : influences) {
      if (!(influence.weight > 0)) continue;
      const Index joint = stands_for[influence.joint];
      std::size_t i = 0;
      while (i < count && merged[i].joint != joint) ++i;
      count = std::max(count, i + 1);
      merged[i].joint = joint;
      merged[i].weight += influence.weight;
    }
    // The strongest first, equal ones as they were; so few need no merge sort with its memory.
    for (std::size_t i = 1; i < count; ++i)
      for (std::size_t k = i; k > 0 && merged[k].weight > merged[k - 1].weight; --k)
        std::swap(merged[k], merged[k - 1]);
    influences = merged;
  }
}

// Idle limbs are none. Where all that hangs on a joint is idle, the end of one stays, since it gives that
// joint's bone its length. Returns whether a joint was dropped: what is left may be a limb that is idle.
bool drop_idle_limbs(Rig& rig) {
  const std::vector<Index> first = limbs_of(rig), idle = idle_limbs(rig, first);
  std::vector<char> dropped(rig.joints.size(), 0);
  for (std::size_t j = 0; j < first.size(); ++j)
    dropped[j] = first[j] != kNone && std::binary_search(idle.begin(), idle.end(), first[j]) ? 1 : 0;
  std::vector<char> is_end(rig.joints.size(), 1), carries(rig.joints.size(), 0);
  for (std::size_t j = 1; j < first.size(); ++j) {
    is_end[rig.joints[j].parent] = 0;
    if (!dropped[j]) carries[rig.joints[j].parent] = 1;
  }
  for (std::size_t j = first.size() - 1; j > 0; --j) {
    if (!dropped[j] || !is_end[j]) continue;
    char& carried = carries[rig.joints[first[j]].parent];
    dropped[j] = carried;
    carried = 1;
  }
  if (std::find(dropped.begin(), dropped.end(), 1) == dropped.end()) return false;
  drop_joints(dropped, rig);
  return true;
}

}  // namespace

void validate(const RigOptions& options) {
  if (options.joints < 0) throw UsageError("rig: joints must not be negative");
  if (!(options.blend >= 0 && options.blend <= 10)) throw UsageError("rig: blend must be from 0 to 10");
}

Rig make_rig(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const RigOptions& options,
             const ProgressCallback& progress) {
  validate(options);
  check_fit(surface, skeleton);
  const SkeletonTree tree = detail::make_skeleton_tree(skeleton);
  const std::vector<char> marked = detail::choose_joints(skeleton, tree, options.joints, progress);
  const auto lay = [&](const std::vector<char>& at_nodes) {
    Rig rig;
    lay_joints(skeleton, tree, at_nodes, rig);
    return rig;
  };
  const auto shares_of = [&](const Rig& rig) {
    report_progress(progress, detail::kRigStage, 0.5);
    return detail::bone_shares(surface, skeleton, tree, rig, options.blend);
  };
  const auto follow = [&](Rig& rig, const std::vector<BoneShare>& shares) {
    report_progress(progress, detail::kRigStage, 0.7);
    rig.influences = influences_of(detail::bound_slopes(surface, rig, shares), surface.vertex_count());
  };
  Rig rig = lay(marked);
  follow(rig, shares_of(rig));
  if (const std::vector<Index> idle = idle_limbs(rig, limbs_of(rig)); !idle.empty()) {
    std::vector<char> farther_out = marked;
    for (const Index j : idle) detail::turn_farther_out(tree, rig.joints[j].node, farther_out);
    Rig turned = lay(farther_out);
    const std::vector<BoneShare> shares = shares_of(turned);
    std::vector<char> is_moved;
    for (const RigJoint& joint : turned.joints) is_moved.push_back(marked[joint.node] ? 0 : 1);
    if (detail::may_follow(surface, turned, shares, is_moved)) {
      follow(turned, shares);
      rig = std::move(turned);
    }
  }
  while (drop_idle_limbs(rig)) report_progress(progress, detail::kRigStage, 0.9);
  rig.cut = tree.cut;
  detail::name_joints(rig, surface.frame.scale);
  return rig;
}

}  // namespace mspskel
