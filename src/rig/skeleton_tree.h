// A skeleton as one rooted tree with the nodes that become joints.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

inline constexpr const char* kRigStage = "rig";

struct SkeletonTree {
  std::vector<Index> order;        // all nodes, parents first; order[0] is the root
  std::vector<Index> parent;       // per node; kNone at the root. Roots of other pieces have the root
  std::vector<double> above;       // per node: length along the skeleton to its parent
  std::vector<Index> child_count;  // per node
  std::vector<std::array<Index, 2>> cut;

  Index root() const { return order.front(); }
};

// Of the cross-section: a palm is wider than its inscribed ball.
double half_width(const SkeletonNode& node);

// Shortest ways along the skeleton from the node of least summed distance to the surface's area, moved to a
// junction whose ball reaches it. O(nodes log nodes) for trees.
SkeletonTree make_skeleton_tree(const CurveSkeleton& skeleton);

// Per node whether it becomes a joint. See make_rig. Throws Cancelled. O(joints * nodes).
std::vector<char> choose_joints(const CurveSkeleton& skeleton, const SkeletonTree& tree, Index wanted,
                                const ProgressCallback& progress);

// Moves the mark of a limb's first joint, at `node`, to half the length between it and the next mark below
// it, or takes it away where no node lies between.
void turn_farther_out(const SkeletonTree& tree, Index node, std::vector<char>& marked);

// The next node towards the root that is marked; kNone at the root.
Index marked_above(const SkeletonTree& tree, const std::vector<char>& marked, Index node);

}  // namespace mspskel::detail
