#include "joint_ways.h"

#include <algorithm>

namespace mspskel::detail {

JointWays::JointWays(const Rig& rig, const std::vector<BoneShare>& shares)
    : shares_(shares), level_(rig.joints.size(), 0), rows_(shares.size()) {
  const std::size_t count = rig.joints.size();
  hangs_on_.assign(count * count, 0);
  lowered_.reserve(shares.size());
  for (std::size_t j = 0; j < count; ++j) {
    above_.push_back(rig.joints[j].parent);
    if (above_[j] != kNone) level_[j] = level_[above_[j]] + 1;
    for (Index up = static_cast<Index>(j); up != kNone; up = above_[up]) hangs_on_[up * count + j] = 1;
  }
}

void JointWays::make_room(Index v, Index joint) {
  const Row old = rows_[v];
  const Index first = level_[joint], last = level_[shares_[v].joint];
  rows_[v] = {static_cast<Index>(lowered_.size()) - first, first};
  for (Index level = first; level < std::min(old.top, last); ++level) lowered_.push_back(1.0);
  if (old.top > last) lowered_.push_back(shares_[v].share);
  for (Index level = old.top; level <= last; ++level) lowered_.push_back(lowered_[old.begin + level]);
}

}  // namespace mspskel::detail
