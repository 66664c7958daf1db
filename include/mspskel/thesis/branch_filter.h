// Skeleton structure filtering (thesis 6.1): unwanted branches go, joints that are one are combined.
#pragma once

#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/collapse/skeleton_decimater.h"

namespace mspskel {

// The thesis names this step and prints no rule. Ours judges by a node's ball, whose radius is that of a
// circle with the node's mean MSP: MSP / 2π. What lies within a joint's ball is part of the joint.
struct BranchFilterOptions {
  bool drop_branches =
      true;  // remove leaf branches that do not leave the ball of the joint that they start at
  bool combine_joints = true;  // merge joints that an edge connects and that lie within each other's ball
  double ball_scale = 1.0;     // times the radius, 0 to 100; 0 keeps everything but coincident nodes
};

// Throws UsageError naming the option.
inline void validate(const BranchFilterOptions& options) {
  if (!(options.ball_scale >= 0 && options.ball_scale <= 100))
    throw UsageError("ball_scale: must be from 0 to 100");
}

struct BranchFilterResult {
  CollapsedSkeleton skeleton;  // counts are those of the collapse
  Index dropped_branches = 0;
  Index dropped_nodes = 0;    // that lay on them
  Index combined_joints = 0;  // joints that merged into another
  Index refused_joints = 0;   // kept apart, since a loop would have become a single or a double edge
};

// Repeats both steps until neither changes anything. Dropping a leaf branch and contracting an edge between
// different nodes keep the homotopy type, and cycles are never touched: b0, b1 and the labels' rank stay.
// Vertices of a dropped branch map to its joint, which stays in place; a combined joint lies where Eq. 4.6
// puts it. Throws UsageError for options out of range or a skeleton with loops at one node. Cost: O(nodes ·
// rounds).
BranchFilterResult filter_branches(const CollapsedSkeleton& skeleton,
                                   const BranchFilterOptions& options = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/thesis/detail/branch_filter_impl.h"
#endif
