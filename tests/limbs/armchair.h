// An armchair of boxes: plates that meet each other, on legs.
#pragma once

#include "topology/voxel_solids.h"

namespace mspskel::test::armchair {

// Of its square seat, and how far the others reach beyond it; all are one thick.
constexpr int kWidth = 10, kBack = 10, kArm = 6, kLeg = 6;

inline VoxelSolid cells() {
  VoxelSolid chair;
  chair.box({0, 0, 0}, {kWidth, kWidth, 1});
  chair.box({0, kWidth - 1, 0}, {kWidth, kWidth, 1 + kBack});
  for (const int x : {0, kWidth - 1}) {
    chair.box({x, 0, 0}, {x + 1, kWidth, 1 + kArm});
    for (const int y : {0, kWidth - 1}) chair.box({x, y, -kLeg}, {x + 1, y + 1, 0});
  }
  return chair;
}

}  // namespace mspskel::test::armchair
