// Parts that no arc of a skeleton stands for: a box on a box, the foot of a vase.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CreasePartOptions {
  // Two parts stay apart where their border costs at most so many times the square root of the smaller one's
  // area; [0, 100]. Round an open disc it is 2 sqrt(pi) = 3.5.
  double cost = 0.5;
  // Parts below this share of the surface do not stay apart; [0, 1].
  double smallest = 0.005;
  Index most = 0;   // at most so many parts, though never fewer than there were; 0: no limit
  Index least = 0;  // at least so many, as far as there are faces
};

// Throws UsageError naming the option.
void validate(const CreasePartOptions& options);

// Grows each part anew from its single faces: of all pairs of pieces that touch, the one whose border costs
// most for its smaller piece becomes one, as long as that is more than `cost` or creases take less than half
// of what the border would cost by its length. What stays apart lies within a ring of creases. `costs` are
// those of border_costs. Writes `part_of_face`, numbered by the least face. Throws UsageError for options out
// of range. O(faces log faces) on meshes whose pieces have few neighbours.
void split_at_creases(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                      std::vector<Index>& part_of_face, const CreasePartOptions& options = {});

}  // namespace mspskel
