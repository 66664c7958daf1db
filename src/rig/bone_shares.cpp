#include "bone_shares.h"

#include <algorithm>

namespace mspskel::detail {
namespace {

class Bones {
 public:
  Bones(const CurveSkeleton& skeleton, const SkeletonTree& tree, const Rig& rig, double blend)
      : skeleton_(skeleton),
        tree_(tree),
        rig_(rig),
        turning_(turning_joints(rig)),
        depth_(skeleton.nodes.size(), 0.0),
        bone_(skeleton.nodes.size(), 0),
        next_(skeleton.nodes.size(), kNone),
        down_(skeleton.nodes.size(), kNone),
        width_(rig.joints.size(), 0.0) {
    for (const Index n : tree.order)
      if (tree.parent[n] != kNone) depth_[n] = depth_[tree.parent[n]] + tree.above[n];
    set_widths(blend);
    set_bones();
  }

  // Of what lies `past` the node along the skeleton, which may be negative.
  BoneShare at(Index n, double past) const {
    const double depth = depth_[n] + past;
    const Index here = bone_[n], below = next_[n];
    const double share = here == 0 ? 1.0 : share_of(here, depth);
    if (share >= 1 && below != kNone)
      if (const double beyond = share_of(below, depth); beyond > 0) return {below, beyond};
    return share > 0 ? BoneShare{here, share} : BoneShare{rig_.joints[here].parent, 1.0};
  }
  // Whether all that maps to the node follows one joint wholly, as far as half way to its neighbours.
  bool is_within_bone(Index n) const {
    const double back = tree_.parent[n] == kNone ? 0 : 0.5 * tree_.above[n];
    const double on = down_[n] == kNone ? 0 : 0.5 * tree_.above[down_[n]];
    return at(n, -back) == at(n, on);
  }
  // From the node to the foot of x on the skeleton's edges towards the root and away from it.
  double past(Index n, const Vector3& x) const {
    const Index up = tree_.parent[n], down = down_[n];
    double along = 0;
    if (up != kNone) along -= std::clamp(projected(n, up, x), 0.0, 0.5) * tree_.above[n];
    if (down != kNone) along += std::clamp(projected(n, down, x), 0.0, 0.5) * tree_.above[down];
    return along;
  }

 private:
  // As a share of the way from a to b.
  double projected(Index a, Index b, const Vector3& x) const {
    const Vector3 way = skeleton_.nodes[b].position - skeleton_.nodes[a].position;
    const double square = way.squaredNorm();
    return square > 0 ? (x - skeleton_.nodes[a].position).dot(way) / square : 0.0;
  }
  double share_of(Index joint, double depth) const {
    const double past = depth - depth_[rig_.joints[joint].node], width = width_[joint];
    if (!(width > 0)) return past >= 0 ? 1 : 0;
    return std::clamp(0.5 + 0.5 * past / width, 0.0, 1.0);
  }
  void set_widths(double blend) {
    for (std::size_t j = 0; j < width_.size(); ++j)
      width_[j] = blend * half_width(skeleton_.nodes[rig_.joints[j].node]);
    for (std::size_t j = 1; j < width_.size(); ++j) {
      const Index above = rig_.joints[j].parent;
      const double bone = depth_[rig_.joints[j].node] - depth_[rig_.joints[above].node];
      // Nothing follows two bones at the root, so what hangs on it may have all of its bone.
      width_[j] = std::min(width_[j], above == 0 ? bone : 0.5 * bone);
      width_[above] = std::min(width_[above], 0.5 * bone);
    }
  }
  // Per node the joint that its bone hangs on, and of the joints below it on its bone the one that reaches it
  // first, with the edge towards it.
  void set_bones() {
    std::vector<Index> joint(skeleton_.nodes.size(), kNone);
    for (Index j = 0; j < static_cast<Index>(width_.size()); ++j) joint[rig_.joints[j].node] = j;
    for (const Index n : tree_.order) {
      if (tree_.parent[n] != kNone) bone_[n] = bone_[tree_.parent[n]];
      if (joint[n] != kNone && turning_[joint[n]]) bone_[n] = joint[n];
      if (tree_.parent[n] != kNone && tree_.child_count[tree_.parent[n]] == 1) down_[tree_.parent[n]] = n;
    }
    std::vector<double> reached(skeleton_.nodes.size(), 0.0);
    for (Index j = 1; j < static_cast<Index>(width_.size()); ++j) {
      if (!turning_[j]) continue;
      Index from = rig_.joints[j].node;
      for (Index n = tree_.parent[from]; n != kNone; from = n, n = tree_.parent[n]) {
        const double short_of = depth_[rig_.joints[j].node] - depth_[n] - width_[j];
        if (next_[n] == kNone || short_of < reached[n]) {
          next_[n] = j;
          down_[n] = from;
          reached[n] = short_of;
        }
        if (joint[n] != kNone && turning_[joint[n]]) break;
      }
    }
  }

  const CurveSkeleton& skeleton_;
  const SkeletonTree& tree_;
  const Rig& rig_;
  const std::vector<char> turning_;  // per joint
  std::vector<double> depth_;        // per node: from the root along the skeleton
  std::vector<Index> bone_, next_;   // per node: joints
  std::vector<Index> down_;    // per node: the neighbour that its bone goes on to; kNone: several or none
  std::vector<double> width_;  // per joint: half of the stretch that follows both bones
};

}  // namespace

std::vector<char> turning_joints(const Rig& rig) {
  std::vector<char> turning(rig.joints.size(), 0);
  turning[0] = 1;
  for (const RigJoint& joint : rig.joints)
    if (joint.parent != kNone) turning[joint.parent] = 1;
  return turning;
}

std::vector<BoneShare> bone_shares(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                   const SkeletonTree& tree, const Rig& rig, double blend) {
  const Bones bones(skeleton, tree, rig, blend);
  std::vector<BoneShare> of_node;
  std::vector<char> within(skeleton.nodes.size());
  for (Index n = 0; n < static_cast<Index>(within.size()); ++n) {
    of_node.push_back(bones.at(n, 0));
    within[n] = bones.is_within_bone(n) ? 1 : 0;
  }
  std::vector<BoneShare> shares(surface.vertex_count());
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone) continue;
    const Index n = skeleton.node_of_vertex[v];
    shares[v] =
        within[n] ? of_node[n] : bones.at(n, bones.past(n, surface.frame.to_model(surface.position[v])));
  }
  return shares;
}

}  // namespace mspskel::detail
