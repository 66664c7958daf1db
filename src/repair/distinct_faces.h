// Triangles that add nothing: copies, opposite pairs, flaps.
#pragma once

#include "face_set.h"
#include "mspskel/repair/mend_soup.h"

namespace mspskel::detail {

// One triangle for each three points, turned as most of its copies are. Where as many are turned either way
// the triangle is two-sided; a connected set of those is kept if the edges that it shares with others are
// closed by it, and dropped if they are closed without it. A set that shares no edge is kept. What is dropped
// so are the `cancelled` ones, one for each three points.
struct DistinctFaces {
  FaceSet faces, cancelled;
};
DistinctFaces distinct_faces(const FaceSet& faces, Index point_count, MendCounts& counts);

// Drops flaps and inner walls: patches (triangles connected over edges of two faces) that hang on edges of
// an odd number of faces, more than two, and whose removal closes more edges than it opens. Of the patches
// that meet at such an edge the smallest one is looked at first.
FaceSet without_flaps(const std::vector<Vector3>& points, const FaceSet& faces, MendCounts& counts);

}  // namespace mspskel::detail
