#include "mspskel/rig/make_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "close_seams.h"
#include "mspskel/base/error.h"
#include "mspskel/skeleton/check_surface_map.h"
#include "name_joints.h"
#include "skeleton_tree.h"

namespace mspskel {
namespace {

using detail::SkeletonTree;
using detail::Weights;

void add(Weights& weights, Index joint, double weight) {
  const auto at = std::lower_bound(weights.begin(), weights.end(), joint,
                                   [](const auto& entry, Index j) { return entry.first < j; });
  if (at != weights.end() && at->first == joint)
    at->second += weight;
  else
    weights.insert(at, {joint, weight});
}

void check_fit(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty()) throw UsageError("a rig needs a skeleton: this one has no nodes");
  check_surface_map(surface, skeleton);
}

class Skinning {
 public:
  Skinning(const CurveSkeleton& skeleton, const SkeletonTree& tree, const Rig& rig, double blend)
      : tree_(tree),
        rig_(rig),
        joint_(skeleton.nodes.size(), kNone),
        depth_(skeleton.nodes.size(), 0.0),
        width_(rig.joints.size(), 0.0),
        has_child_(rig.joints.size(), 0) {
    for (Index j = 0; j < static_cast<Index>(rig.joints.size()); ++j) joint_[rig.joints[j].node] = j;
    for (const Index n : tree.order)
      if (tree.parent[n] != kNone) depth_[n] = depth_[tree.parent[n]] + tree.above[n];
    for (Index j = 0; j < static_cast<Index>(width_.size()); ++j)
      width_[j] = blend * detail::half_width(skeleton.nodes[rig.joints[j].node]);
    for (Index j = 1; j < static_cast<Index>(width_.size()); ++j) {
      const Index above = rig.joints[j].parent;
      const double bone = depth_[rig.joints[j].node] - depth_[rig.joints[above].node];
      // Nothing follows two bones at the root, so what hangs on it may have all of its bone.
      width_[j] = std::min(width_[j], above == 0 ? bone : 0.5 * bone);
      width_[above] = std::min(width_[above], 0.5 * bone);
      has_child_[above] = 1;
    }
  }

  // Per node: the bone that it is on, and near a joint the bone beyond it.
  std::vector<Weights> of_nodes() const {
    std::vector<Weights> weights(joint_.size());
    for (const Index n : tree_.order) {
      const Index here = bone_of(n);
      add(weights[n], here, 1.0);
      const Index above = rig_.joints[here].parent;
      if (above == kNone) continue;
      const double share = share_of(here, depth_[n] - depth_[rig_.joints[here].node]);
      if (share < 1) weights[n] = two(here, share, above);
    }
    for (Index j = 1; j < static_cast<Index>(rig_.joints.size()); ++j) {
      if (!has_child_[j]) continue;
      const Index above = rig_.joints[j].parent;
      for (Index n = tree_.parent[rig_.joints[j].node]; joint_[n] == kNone; n = tree_.parent[n]) {
        const double share = share_of(j, depth_[n] - depth_[rig_.joints[j].node]);
        // Where chains that leave a joint together have no joint of their own there, the first has it.
        if (share > 0 && weights[n].size() == 1) weights[n] = two(j, share, above);
      }
    }
    return weights;
  }

 private:
  // The joint at the upper end of the bone; an end has none of its own.
  Index bone_of(Index n) const {
    while (joint_[n] == kNone || (joint_[n] != 0 && !has_child_[joint_[n]])) n = tree_.parent[n];
    return joint_[n];
  }
  // How much what is `past` the joint along the skeleton follows it: 0 before, 1 behind, smooth between.
  double share_of(Index joint, double past) const {
    const double width = width_[joint];
    if (!(width > 0)) return past >= 0 ? 1 : 0;
    const double t = std::clamp(0.5 + 0.5 * past / width, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }
  static Weights two(Index joint, double share, Index above) {
    Weights weights;
    add(weights, above, 1 - share);
    add(weights, joint, share);
    return weights;
  }

  const SkeletonTree& tree_;
  const Rig& rig_;
  std::vector<Index> joint_;   // per node; kNone: it is none
  std::vector<double> depth_;  // per node: from the root along the skeleton
  std::vector<double> width_;  // per joint: half of the stretch that follows both bones
  std::vector<char> has_child_;
};

// Averages weights with those of the neighbours on the surface. Rounds reach no farther than an edge each, so
// they leave out what lies in the midst of equal weights.
class Smoothing {
 public:
  Smoothing(const SurfaceSnapshot& surface, Index joints, Index rounds)
      : surface_(surface), rounds_(rounds), sum_(joints, 0.0) {}

  // Each vertex gets the mean of its own and its neighbours', so weights spread along the surface only.
  void run(std::vector<Weights>& weights) {
    const std::vector<Index> first = first_rounds(weights);
    std::vector<Index> moving;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (first[v] < rounds_) moving.push_back(v);
    std::vector<Weights> next = weights;
    for (Index round = 0; round < rounds_; ++round) {
      for (const Index v : moving)
        if (first[v] <= round) average(weights, v, next[v]);
      weights.swap(next);
    }
  }

 private:
  // Per vertex the round in which a neighbour's weights may first differ from its own.
  std::vector<Index> first_rounds(const std::vector<Weights>& weights) const {
    std::vector<Index> first(weights.size(), rounds_), wave;
    for (Index h = 0; h < surface_.halfedge_count(); ++h) {
      const Index v = surface_.origin[h];
      if (first[v] == 0 || weights[v] == weights[surface_.target(h)]) continue;
      first[v] = 0;
      wave.push_back(v);
    }
    for (std::size_t i = 0; i < wave.size(); ++i)
      for_each_neighbour(surface_, wave[i], [&](Index w) {
        if (first[w] <= first[wave[i]] + 1) return;
        first[w] = first[wave[i]] + 1;
        wave.push_back(w);
      });
    return first;
  }
  void give(Index joint, double weight) {
    if (sum_[joint] == 0) touched_.push_back(joint);
    sum_[joint] += weight;
  }
  void average(const std::vector<Weights>& weights, Index v, Weights& into) {
    double count = 1;
    for (const auto& [joint, weight] : weights[v]) give(joint, weight);
    for_each_neighbour(surface_, v, [&](Index w) {
      ++count;
      for (const auto& [joint, weight] : weights[w]) give(joint, weight);
    });
    std::sort(touched_.begin(), touched_.end());
    into.clear();
    for (const Index joint : touched_) {
      into.emplace_back(joint, sum_[joint] / count);
      sum_[joint] = 0;
    }
    touched_.clear();
  }

  const SurfaceSnapshot& surface_;
  const Index rounds_;
  std::vector<double> sum_;     // per joint, and 0 between vertices
  std::vector<Index> touched_;  // joints whose sum is not 0
};

// The ancestor of `joint`, or itself, that hangs on `above`; kNone where it does not hang on it.
Index child_towards(const Rig& rig, Index above, Index joint) {
  while (joint != kNone && rig.joints[joint].parent != above) joint = rig.joints[joint].parent;
  return joint;
}

// Whether each joint hangs on the one before it.
bool is_one_path(const Rig& rig, const Weights& weights) {
  for (std::size_t i = 1; i < weights.size(); ++i) {
    Index joint = weights[i].first;
    while (joint > weights[i - 1].first) joint = rig.joints[joint].parent;
    if (joint != weights[i - 1].first) return false;
  }
  return true;
}

// A vertex follows joints of one way from the root only, so that no limb pulls at another. Where several
// children of a joint pull, the strongest keeps what it has more than the second, and the joint has the rest:
// halfway between two limbs that is all, so weights stay continuous.
Weights on_one_path(const Rig& rig, Weights weights) {
  if (is_one_path(rig, weights)) return weights;
  for (Index here = 0; weights.size() > 1 && here != kNone;) {
    Weights children;
    for (const auto& [joint, weight] : weights)
      if (const Index child = child_towards(rig, here, joint); child != kNone) add(children, child, weight);
    if (children.empty()) break;
    std::stable_sort(children.begin(), children.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    const Index strongest = children[0].first;
    if (children.size() > 1) {
      const double kept = 1 - children[1].second / children[0].second;
      Weights settled;
      for (const auto& [joint, weight] : weights) {
        const Index child = child_towards(rig, here, joint);
        const double share = child == kNone ? 1 : child == strongest ? kept : 0;
        if (share > 0) add(settled, joint, share * weight);
        if (share < 1) add(settled, here, (1 - share) * weight);
      }
      weights = std::move(settled);
    }
    here = strongest;
  }
  return weights;
}

std::array<Influence, 4> strongest(Weights weights) {
  std::sort(weights.begin(), weights.end(), [](const auto& a, const auto& b) {
    return a.second > b.second || (a.second == b.second && a.first < b.first);
  });
  // Less than this nobody sees, and files keep no more than seven digits.
  constexpr double kLeast = 1e-4;
  std::array<Influence, 4> influences{};
  double sum = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, weights.size()); ++i)
    if (i == 0 || weights[i].second > kLeast) {
      influences[i] = {weights[i].first, weights[i].second};
      sum += weights[i].second;
    }
  if (!(sum > 0)) return {{{0, 1.0}, {}, {}, {}}};
  for (Influence& influence : influences) influence.weight /= sum;
  return influences;
}

void lay_joints(const CurveSkeleton& skeleton, const SkeletonTree& tree, Index wanted, Rig& rig) {
  const std::vector<char> marked = detail::choose_joints(skeleton, tree, wanted);
  std::vector<Index> joint(skeleton.nodes.size(), kNone);
  for (const Index n : tree.order) {
    if (!marked[n]) continue;
    const Index above = detail::marked_above(tree, marked, n);
    joint[n] = static_cast<Index>(rig.joints.size());
    rig.joints.push_back({"", above == kNone ? kNone : joint[above], skeleton.nodes[n].position, n, kNone});
  }
}

}  // namespace

void validate(const RigOptions& options) {
  if (options.joints < 0) throw UsageError("rig: joints must not be negative");
  if (!(options.blend >= 0 && options.blend <= 10)) throw UsageError("rig: blend must be from 0 to 10");
  if (options.smoothing < 0 || options.smoothing > 1000)
    throw UsageError("rig: smoothing must be from 0 to 1000");
}

Rig make_rig(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const RigOptions& options) {
  validate(options);
  check_fit(surface, skeleton);
  const SkeletonTree tree = detail::make_skeleton_tree(skeleton);
  Rig rig;
  rig.cut = tree.cut;
  lay_joints(skeleton, tree, options.joints, rig);
  detail::name_joints(rig, surface.frame.scale);
  const std::vector<Weights> of_node = Skinning(skeleton, tree, rig, options.blend).of_nodes();
  std::vector<Weights> weights(surface.vertex_count());
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.vertex_halfedge[v] != kNone) weights[v] = of_node[skeleton.node_of_vertex[v]];
  detail::close_seams(surface, skeleton, tree, weights);
  Smoothing(surface, static_cast<Index>(rig.joints.size()), options.smoothing).run(weights);
  for (Weights& w : weights) rig.influences.push_back(strongest(on_one_path(rig, std::move(w))));
  return rig;
}

}  // namespace mspskel
