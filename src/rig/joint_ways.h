// Per vertex what it follows of each joint on its way from the root.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "bone_shares.h"

namespace mspskel::detail {

// Less weight than this nobody sees, and files keep no more than seven digits.
constexpr double kLeastWeight = 1e-4;

// A vertex follows the joints from the root to that of its BoneShare, and of each at most as much as of the
// one that it hangs on. Shares can only be lowered; vertices where none is take no room of their own.
class JointWays {
 public:
  // Keeps a reference to the shares.
  JointWays(const Rig& rig, const std::vector<BoneShare>& shares);

  const BoneShare& of_map(Index v) const { return shares_[v]; }
  bool is_lowered(Index v) const { return rows_[v].top != kNoRow; }
  Index above(Index joint) const { return above_[joint]; }
  // How many joints are above it.
  Index level(Index joint) const { return level_[joint]; }
  // On joints beside the vertex's way and below it, 0.
  double at(Index v, Index joint) const { return is_on_way(v, joint) ? at_on_way(v, joint) : 0.0; }
  // The joint is on the vertex's way.
  double at_on_way(Index v, Index joint) const {
    const Row& row = rows_[v];
    if (level_[joint] >= row.top) return lowered_[row.begin + level_[joint]];
    return joint == shares_[v].joint ? shares_[v].share : 1.0;
  }
  bool is_on_way(Index v, Index joint) const {
    return hangs_on_[static_cast<std::size_t>(joint) * above_.size() + shares_[v].joint] != 0;
  }
  // The joint is on the vertex's way and its share becomes less.
  void lower(Index v, Index joint, double share) {
    if (level_[joint] < rows_[v].top) make_room(v, joint);
    lowered_[rows_[v].begin + level_[joint]] = share;
  }

 private:
  static constexpr Index kNoRow = std::numeric_limits<Index>::max();
  // A vertex's shares from level `top` on are in lowered_, that of level 0 would be at `begin`.
  struct Row {
    Index begin = 0, top = kNoRow;  // kNoRow: as the map says
  };

  void make_room(Index v, Index joint);

  const std::vector<BoneShare>& shares_;
  std::vector<Index> above_;    // per joint: the one that it hangs on
  std::vector<char> hangs_on_;  // per joint, for each: whether it is this one or below it
  std::vector<Index> level_;    // per joint: how many are above it
  std::vector<Row> rows_;       // per vertex
  std::vector<double> lowered_;
};

}  // namespace mspskel::detail
