#include "mspskel/rig/make_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bone_shares.h"
#include "bound_slopes.h"
#include "mspskel/base/error.h"
#include "mspskel/skeleton/check_surface_map.h"
#include "name_joints.h"
#include "skeleton_tree.h"

namespace mspskel {
namespace {

using detail::BoneShare;
using detail::LowerShare;
using detail::SkeletonTree;

void check_fit(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty()) throw UsageError("a rig needs a skeleton: this one has no nodes");
  check_surface_map(surface, skeleton);
}

// Less than this nobody sees, and files keep no more than seven digits.
constexpr double kLeastWeight = 1e-4;

// Of a vertex: a joint on the way from the root has what it is followed more than the next one. `lower` are
// the vertex's lower shares, ascending by joint.
class Influences {
 public:
  explicit Influences(const Rig& rig) : rig_(rig) {}

  std::array<Influence, 4> of(const BoneShare& share, const LowerShare* begin, const LowerShare* end) {
    if (share.share >= 1 && begin == end) return {{{share.joint, 1.0}}};
    way_.clear();
    for (Index j = share.joint; j != kNone; j = rig_.joints[j].parent)
      way_.push_back({j, j == share.joint ? share.share : 1.0});
    std::reverse(way_.begin(), way_.end());
    double above = 1;
    for (Influence& step : way_) {
      const auto lower = std::find_if(begin, end, [&](const LowerShare& l) { return l.joint == step.joint; });
      if (lower != end) step.weight = lower->share;
      above = step.weight = std::min(above, detail::smooth_share(step.weight));
    }
    for (std::size_t i = 0; i + 1 < way_.size(); ++i) way_[i].weight -= way_[i + 1].weight;
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
      if (way_.size() == 1 || (way_.size() <= 4 && least->weight > kLeastWeight)) break;
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

  const Rig& rig_;
  std::vector<Influence> way_;  // from the root
};

std::vector<std::array<Influence, 4>> influences_of(const Rig& rig, const std::vector<BoneShare>& shares,
                                                    const std::vector<LowerShare>& lower) {
  std::vector<std::array<Influence, 4>> influences(shares.size());
  Influences made(rig);
  const LowerShare *begin = lower.data(), *const all = begin + lower.size();
  for (std::size_t v = 0; v < shares.size(); ++v) {
    const LowerShare* end = begin;
    while (end != all && end->vertex == static_cast<Index>(v)) ++end;
    influences[v] = made.of(shares[v], begin, end);
    begin = end;
  }
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
    std::stable_sort(merged.begin(), merged.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
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

Rig make_rig(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const RigOptions& options) {
  validate(options);
  check_fit(surface, skeleton);
  const SkeletonTree tree = detail::make_skeleton_tree(skeleton);
  std::vector<char> marked = detail::choose_joints(skeleton, tree, options.joints);
  Rig rig;
  lay_joints(skeleton, tree, marked, rig);
  std::vector<BoneShare> shares = detail::bone_shares(surface, skeleton, tree, rig, options.blend);
  const std::vector<Index> idle = detail::find_idle(surface, rig, shares, first_joints(limbs_of(rig)));
  if (!idle.empty()) {
    for (const Index j : idle) detail::turn_farther_out(tree, rig.joints[j].node, marked);
    lay_joints(skeleton, tree, marked, rig);
    shares = detail::bone_shares(surface, skeleton, tree, rig, options.blend);
  }
  rig.influences = influences_of(rig, shares, detail::bound_slopes(surface, rig, shares));
  while (drop_idle_limbs(rig)) {
  }
  rig.cut = tree.cut;
  detail::name_joints(rig, surface.frame.scale);
  return rig;
}

}  // namespace mspskel
