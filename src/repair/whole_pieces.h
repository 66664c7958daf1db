// What a cut or a grid leaves of a surface, without crumbs.
#pragma once

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

struct WholePieces {
  PolygonSoup soup;
  Index genus = 0;     // of all of them
  Index solids = 0;    // pieces turned outward
  Index cavities = 0;  // the others
  Index crumbs = 0;    // pieces left out
};

// Closed, manifold triangles without the pieces whose box's diagonal is below 0.025 of the largest one's, and
// without the cavities below `pocket` times the volume of all solids.
WholePieces without_crumbs(const PolygonSoup& soup, double pocket = 0);

}  // namespace mspskel::detail
