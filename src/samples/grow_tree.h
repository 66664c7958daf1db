// Trees of tubes that fork and keep clear of each other.
#pragma once

#include "mspskel/base/random.h"
#include "mspskel/samples/skin_graph.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

// A branch that carries n of the tips has the radius n^exponent, in radii of a tip.
struct TreeRule {
  Index tips = 20;         // besides the root's end
  double exponent = 0.43;  // of Murray's law, about 1/2.3
  double evenness = 0.25;  // the smaller child carries at least this share of the tips, (0, 0.5]
  double length = 6;       // of a branch between its joints' balls, in its own radii; varies by a sixth
  std::uint64_t seed = 1;
};

struct GrownTree {
  BallGraph graph;      // each branch has balls of its own, also where it leaves its joint
  CurveSkeleton truth;  // joints are nodes once
};

// Grows from the root upward (+z), thick branches first, in a random direction that is clear of all others.
// Cost: O(tips). Throws UsageError if there is no room, which other seeds mend.
GrownTree grow_tree(const TreeRule& rule);

}  // namespace mspskel::detail
