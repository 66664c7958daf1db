// The boundary of a union of solids, from a grid.
#pragma once

#include <vector>

#include "crossing_shells.h"
#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Of the solids that `members` of the shells bound, each thickened by `margin`: closed, manifold triangles,
// counter-clockwise as seen from outside, in the surface's coordinates.
PolygonSoup boundary_of_union(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                              const std::vector<Index>& members, double cell, double margin,
                              const Execution& execution);

}  // namespace mspskel::detail
