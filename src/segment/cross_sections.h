// How thick a shape is at each node of its skeleton, as the radius of a circle of the same perimeter.
#pragma once

#include <vector>

#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

// Mean minimum slice perimeters over 2 pi, averaged by area over the nodes of the same arc, its ends
// included, within one inscribed ball along it. Nodes that know no perimeter have the ball's radius. A joint
// is as thick as the thickest arc is next to it.
std::vector<double> cross_sections(const CurveSkeleton& skeleton,
                                   const std::vector<std::vector<Index>>& neighbours);

}  // namespace mspskel::detail
