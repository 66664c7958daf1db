// Surfaces cut out of a grid have slivers wherever they pass near a node.
#pragma once

#include "mspskel/base/watch.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Edges of a cut surface that tell nothing, in cells.
constexpr double kShortEdge = 0.6;

// The closed, manifold triangles with edges shorter than `length` merged into their best points (as
// coarsen_surface places them), the shortest first, where the surface stays manifold, of the same genus and
// unfolded. O(n log n).
PolygonSoup without_short_edges(const PolygonSoup& soup, double length, Watch& watch);

}  // namespace mspskel::detail
