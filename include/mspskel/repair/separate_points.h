// Vertices that lie in one place, as coordinates that were rounded have them.
#pragma once

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

// A closed, manifold surface whose vertices all lie in places of their own: of several in one place all but
// the first are drawn towards their neighbours, by a thousandth of their shortest edge and little more. Most
// readers take vertices in one place for one, and the surface would not be manifold to them. Corners have to
// be in range. O(n log n); a surface without such vertices comes back as it is.
PolygonSoup separate_points(PolygonSoup soup);

}  // namespace mspskel
