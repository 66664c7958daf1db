// How thick a shape is at each node of its skeleton, as the radius of a circle of the same perimeter.
#pragma once

#include <vector>

#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

// Mean minimum slice perimeters over 2 pi, averaged by area over the nodes within one inscribed ball along
// the skeleton. Nodes that know no perimeter have the ball's radius.
std::vector<double> cross_sections(const CurveSkeleton& skeleton,
                                   const std::vector<std::vector<Index>>& neighbours);

}  // namespace mspskel::detail
