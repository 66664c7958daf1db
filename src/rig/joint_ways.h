// Per vertex what it follows of each joint on its way from the root.
#pragma once

#include <cstddef>
#include <vector>

#include "bone_shares.h"

namespace mspskel::detail {

// Less weight than this nobody sees, and files keep no more than seven digits.
constexpr double kLeastWeight = 1e-4;

// A vertex follows the joints from the root to that of its BoneShare, and of each at most as much as of the
// one that it hangs on. Shares can only be lowered; vertices where none is take no room of their own.
class JointWays {
 public:
  // Keeps references.
  JointWays(const Rig& rig, const std::vector<BoneShare>& shares);

  const BoneShare& of_map(Index v) const { return shares_[v]; }
  bool is_lowered(Index v) const { return begin_[v] != kNone; }
  Index above(Index joint) const { return rig_.joints[joint].parent; }
  // On joints beside the vertex's way and below it, 0.
  double at(Index v, Index joint) const {
    if (!is_on_way(v, joint)) return 0;
    if (!is_lowered(v)) return joint == shares_[v].joint ? shares_[v].share : 1.0;
    return level_[joint] < top_[v] ? 1.0 : lowered_[begin_[v] + level_[joint] - top_[v]];
  }
  bool is_on_way(Index v, Index joint) const {
    return hangs_on_[static_cast<std::size_t>(joint) * rig_.joints.size() + shares_[v].joint] != 0;
  }
  // The joint is on the vertex's way and its share becomes less.
  void lower(Index v, Index joint, double share);

 private:
  const Rig& rig_;
  const std::vector<BoneShare>& shares_;
  std::vector<char> hangs_on_;  // per joint, for each: whether it is this one or below it
  std::vector<Index> level_;    // per joint: how many are above it
  // Per vertex: its shares from level `top_` on are lowered_[begin_] and the following; kNone: as the map
  // says.
  std::vector<Index> begin_, top_;
  std::vector<double> lowered_;
};

}  // namespace mspskel::detail
