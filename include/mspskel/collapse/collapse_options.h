// Options of the collapse from skeleton mesh to skeleton.
#pragma once

#include <cmath>
#include <functional>

#include "mspskel/base/error.h"
#include "mspskel/collapse/collapse_cost.h"

namespace mspskel {

// What becomes of an edge without faces.
enum class EdgePolicy {
  kSaturation,  // thesis: it collapses while its saturation is below the threshold
  kKeep,        // it never collapses, so limbs keep their arcs; branches are for a later stage to judge
};

enum class CollapseOrder {
  kCost,           // thesis: by Eq. 4.4, ties by length
  kShortestFirst,  // by length alone
};

// The way on when faces are left whose edges are all refused because their labels differ.
enum class DeadEnd {
  // Thin the sheet: a face goes with its longest edge that no other face has; where no face has such an edge,
  // the
  // largest face goes. Loops keep three nodes and their width.
  kOpenFaces,
  // The cheapest refused edge collapses and leaves parallel edges, as long as there is one; then as above.
  kParallelEdges,
};

struct CollapseOptions {
  double lambda = 0.1;  // λ of Eq. 4.4, weight of the slice error in the cost, at least 0
  // An edge without faces whose saturation is below it is noise, at least 0. The thesis prints no value; 0.1
  // eats all arms of its octopus, which Fig. 5.18 shows with them.
  double saturation_threshold = 0.05;
  double angle_floor = 0.0;  // radians, 0 to π/2: least angle in Eq. 4.2; 0 is the thesis
  EdgePolicy one_dimensional = EdgePolicy::kSaturation;
  CollapseOrder order = CollapseOrder::kCost;
  DeadEnd dead_end = DeadEnd::kOpenFaces;
  // Merge edges only if their labels agree, so that no handle is lost and none is made. Off: the thesis's
  // literal behaviour, which ignores labels and merges all parallel edges.
  bool keep_topology = true;
  // Replaces Eq. 4.4 if set; not a number counts as infinite. Called once an edge and change.
  std::function<double(const CostTerms&)> cost;
};

// Throws UsageError naming the option.
inline void validate(const CollapseOptions& options) {
  if (!(options.lambda >= 0) || !std::isfinite(options.lambda))
    throw UsageError("lambda: must be a number of at least 0");
  if (!(options.saturation_threshold >= 0)) throw UsageError("saturation_threshold: must be at least 0");
  if (!(options.angle_floor >= 0 && options.angle_floor <= kPi / 2))
    throw UsageError("angle_floor: must be from 0 to pi/2 radians");
}

}  // namespace mspskel
