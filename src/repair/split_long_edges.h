// Long edges tell of a surface, but carry no vertices for what is measured at them.
#pragma once

#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Halves the edges of closed, manifold triangles that are longer than the lesser limit of the two triangles
// beside them, those that exceed it most first, until there are as many triangles as `most`. O(n log n).
void split_long_edges(PolygonSoup& soup, std::vector<double> limit_of_triangle, Index most);

}  // namespace mspskel::detail
