// From polygons to triangles whose three corners differ.
#pragma once

#include "face_set.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Corners are named by point_of[corner]. Corners that follow their like are left out; a polygon that comes
// back to a point falls into parts there; parts of fewer than three corners are dropped, and so are polygons
// that name a point that is not finite or not there. `degenerate` counts polygons of which nothing is left.
FaceSet clean_faces(const PolygonSoup& soup, const std::vector<Index>& point_of, Index& degenerate);

}  // namespace mspskel::detail
