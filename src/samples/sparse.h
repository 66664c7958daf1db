// Long triangles where a surface is flat or bent one way only, as machine-made models have them.
#pragma once

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Collapses edges by quadric error (Garland, Heckbert 1997) while faces turn by at most 15 degrees and the
// surface moves by at most `error`, model units > 0. Keeps the topology. Cost: O(n log n).
PolygonSoup with_long_triangles(const PolygonSoup& soup, double error);

}  // namespace mspskel::detail
