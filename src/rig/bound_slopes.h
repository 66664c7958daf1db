// Shares that change along the surface no faster than a turned joint allows.
#pragma once

#include <vector>

#include "bone_shares.h"

namespace mspskel::detail {

// A joint's share at a vertex where it is less than the vertex's BoneShare says.
struct LowerShare {
  Index vertex = 0, joint = 0;
  double share = 0.0;
};

// A joint that is turned moves what is r from it by up to r times the turn, so a face turns over where the
// joint's weight changes by more than about 1 / r a unit of length. So each joint's share becomes the largest
// one that is nowhere more than it was and changes along each edge of the surface, and over each face that is
// wider than a right angle, by at most a share of length / r. That leaves limbs alone, whose radius is about
// as far as their bones' blends are long; it closes what the surface map tears: two fingers side by side on a
// palm, a fold between an arm and the trunk. Weights come to no vertex that had none, so other limbs stay
// where they are, and no vertex follows a joint more than the one that it hangs on. Ascending by vertex, then
// by joint. O(vertices + n log n) for n vertices and joints that change.
std::vector<LowerShare> bound_slopes(const SurfaceSnapshot& surface, const Rig& rig,
                                     const std::vector<BoneShare>& shares);

// Of the joints, of which none hangs on another, those that no vertex follows by half or more once their
// slopes are bounded.
std::vector<Index> find_idle(const SurfaceSnapshot& surface, const Rig& rig,
                             const std::vector<BoneShare>& shares, const std::vector<Index>& joints);

}  // namespace mspskel::detail
