#include "joint_ways.h"

namespace mspskel::detail {

JointWays::JointWays(const Rig& rig, const std::vector<BoneShare>& shares)
    : rig_(rig),
      shares_(shares),
      level_(rig.joints.size(), 0),
      begin_(shares.size(), kNone),
      top_(shares.size(), 0) {
  const std::size_t count = rig.joints.size();
  hangs_on_.assign(count * count, 0);
  for (std::size_t j = 0; j < count; ++j) {
    if (rig.joints[j].parent != kNone) level_[j] = level_[rig.joints[j].parent] + 1;
    for (Index up = static_cast<Index>(j); up != kNone; up = rig.joints[up].parent)
      hangs_on_[up * count + j] = 1;
  }
}

void JointWays::lower(Index v, Index joint, double share) {
  if (!is_lowered(v) || level_[joint] < top_[v]) {
    const std::size_t begin = lowered_.size();
    lowered_.resize(begin + level_[shares_[v].joint] - level_[joint] + 1);
    std::size_t at_level = lowered_.size();
    for (Index j = shares_[v].joint; j != above(joint); j = above(j)) lowered_[--at_level] = at(v, j);
    begin_[v] = static_cast<Index>(begin);
    top_[v] = level_[joint];
  }
  lowered_[begin_[v] + level_[joint] - top_[v]] = share;
}

}  // namespace mspskel::detail
