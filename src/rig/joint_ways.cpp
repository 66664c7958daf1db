#include "joint_ways.h"

namespace mspskel::detail {

JointWays::JointWays(const Rig& rig, const std::vector<BoneShare>& shares)
    : shares_(shares), level_(rig.joints.size(), 0), rows_(shares.size()) {
  const std::size_t count = rig.joints.size();
  hangs_on_.assign(count * count, 0);
  for (std::size_t j = 0; j < count; ++j) {
    above_.push_back(rig.joints[j].parent);
    if (above_[j] != kNone) level_[j] = level_[above_[j]] + 1;
    for (Index up = static_cast<Index>(j); up != kNone; up = above_[up]) hangs_on_[up * count + j] = 1;
  }
}

void JointWays::make_room(Index v, Index joint) {
  const std::size_t begin = lowered_.size();
  lowered_.resize(begin + level_[shares_[v].joint] - level_[joint] + 1);
  std::size_t at_level = lowered_.size();
  for (Index j = shares_[v].joint; j != above(joint); j = above(j)) lowered_[--at_level] = at_on_way(v, j);
  rows_[v] = {static_cast<Index>(begin) - level_[joint], level_[joint]};
}

}  // namespace mspskel::detail
