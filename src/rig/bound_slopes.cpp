#include "bound_slopes.h"

#include <algorithm>
#include <utility>

#include "keep_sides.h"
#include "share_spread.h"

namespace mspskel::detail {
namespace {

// Whether the vertex may follow by half or more one of `joints` that is the joint or below it, or one
// above.
bool may_lead(const JointWays& ways, Index v, Index joint, const std::vector<char>& joints) {
  if (!ways.is_on_way(v, joint) || ways.at_on_way(v, joint) >= 0.5) return true;
  for (Index j = ways.above(joint); j > 0; j = ways.above(j))
    if (joints[j]) return true;
  return false;
}

}  // namespace

JointWays bound_slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares) {
  ShareSpread spread(surface, rig, shares);
  spread.note_steep(std::vector<char>(spread.count(), 1));
  for (Index j = 1; j < spread.count(); ++j) spread.lower_along_edges(j);
  keep_sides(surface, spread);
  return std::move(spread.ways());
}

// Joints above those asked about lower a vertex only further, so they are not asked where none does already.
// Nor is it asked where else shares of half or more fall, since what falls below half falls from less.
bool may_follow(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares,
                const std::vector<char>& joints) {
  ShareSpread spread(surface, rig, shares);
  const JointWays& ways = spread.ways();
  spread.set_limit(0.5);
  spread.note_steep(joints);
  for (Index j = 1; j < spread.count(); ++j)
    if (joints[j]) spread.lower_along_edges(j);
  std::vector<char> on_way(spread.count(), 0);
  std::vector<Index> followers;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    Index j = ways.of_map(v).joint;
    while (j > 0 && !(joints[j] && ways.at_on_way(v, j) >= 0.5)) j = ways.above(j);
    if (j > 0) followers.push_back(v);
    for (; j > 0; j = ways.above(j)) on_way[j] = 1;
  }
  if (!followers.empty()) spread.note_steep(on_way);
  for (Index j = 1; j < spread.count() && !followers.empty(); ++j) {
    if (!on_way[j]) continue;
    spread.lower_along_edges(j);
    followers.erase(std::remove_if(followers.begin(), followers.end(),
                                   [&](Index v) { return !may_lead(ways, v, j, joints); }),
                    followers.end());
  }
  return !followers.empty();
}

}  // namespace mspskel::detail
