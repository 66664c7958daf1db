// The rims of the holes that a surface has.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

// Half-edges without a twin, each list running once round one hole with the surface on its left. A loop
// passes no point twice: where a longer one does it is cut there into several, so that holes which touch at
// a point are closed one by one, and the faces between them stay one surface. Loops of two half-edges are
// matched at once; the number of edges closed in that way is added to `stitched`.
std::vector<std::vector<Index>> boundary_loops(const FaceSet& faces, std::vector<Index>& twin,
                                               Index point_count, Index& stitched);

}  // namespace mspskel::detail
