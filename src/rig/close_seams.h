// Weights that stay smooth where the surface map jumps from one limb to another.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"
#include "skeleton_tree.h"

namespace mspskel::detail {

// Joints and weights of one node or vertex, ascending by joint.
using Weights = std::vector<std::pair<Index, double>>;

// Neighbours on the surface whose nodes are far apart along the tree move apart when a joint between them is
// turned: by as much as the way between them is long. So the weights change over a stretch of that length:
// one step of diffusion, whose reach at each vertex is a share of the longest such way near it. Elsewhere
// weights stay. O(vertices + joints * n^1.5) for n vertices near such seams.
void close_seams(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const SkeletonTree& tree,
                 std::vector<Weights>& weights);

}  // namespace mspskel::detail
