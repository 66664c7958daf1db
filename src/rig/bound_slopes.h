// Shares that change along the surface no faster than a turned joint allows.
#pragma once

#include <vector>

#include "joint_ways.h"

namespace mspskel::detail {

// A joint that is turned moves what is r from it by up to r times the turn, so a face turns over where the
// joint's weight changes by more than about 1 / r a unit of length. So each joint's share becomes the largest
// one that is nowhere more than it was and changes along each edge of the surface by at most a share of
// length / r. Where a face turns over even so (see TurnedFace), it changes half as much along that face's
// edges, until it does not. That leaves limbs alone, whose radius is about as far as their bones' blends are
// long; it closes what the surface map tears: two fingers side by side on a palm, a fold between an arm and
// the trunk. Weights come to no vertex that had none, so other limbs stay where they are; no vertex follows a
// joint more than the one that it hangs on, or more than four. O(vertices + n log n) for n vertices and
// joints that change, and again for those about each face that is halved.
JointWays bound_slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares);

// Whether a vertex may follow one of the joints that are not 0 in `joints` by half or more: looks at the
// edges only.
bool may_follow(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares,
                const std::vector<char>& joints);

}  // namespace mspskel::detail
