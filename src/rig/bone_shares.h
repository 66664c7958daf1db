// How much of each joint's turn what lies along the skeleton follows.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/rig/rig.h"
#include "mspskel/skeleton/curve_skeleton.h"
#include "skeleton_tree.h"

namespace mspskel::detail {

// A place follows the joints above `joint` with all of their bones, `joint` itself with `share` in (0, 1],
// and none below it or beside it. Shares are linear along the skeleton; smooth_share gives the joint's
// weight.
struct BoneShare {
  Index joint = 0;
  double share = 1.0;

  bool operator==(const BoneShare& other) const { return joint == other.joint && share == other.share; }
};

// 0 at 0, 1 at 1, level at both; at most 1.5 times as steep as its argument.
inline double smooth_share(double t) { return t * t * (3 - 2 * t); }

// Per joint whether another hangs on it: an end turns nothing.
std::vector<char> turning_joints(const Rig& rig);

// Per vertex, where its foot on the skeleton beside its node is: half at a joint, all from `blend` half
// widths of the cross-section behind it, though at most half a bone, or all of one that hangs on the root.
// Isolated vertices follow the root. O(vertices + joints * nodes).
std::vector<BoneShare> bone_shares(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                   const SkeletonTree& tree, const Rig& rig, double blend);

}  // namespace mspskel::detail
