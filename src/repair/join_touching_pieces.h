// What hangs on a solid by an edge is a part of it.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

//    \ void /                  \ void /
//     \    /                    \    /       Pieces that touch in an edge of four faces: what were the two
//  A   edge   B    becomes   A  =====  B      faces of each piece there become two pairs across it, so that
//     /    \                    /    \       the solids are one, over a bridge along the edge. No handle
//    / void \                  / void \      arises, since that is done once between two pieces.
//
// A piece joins one that it touches if its extent is below `share` of that one's, the largest ones first, and
// takes along what touches it and is as small: twigs that decimation pinched off, crumbs of voxel surfaces.
// Pieces without volume join nothing. Changes `twin`; returns how many pieces joined others.
// Cost: O(n log n).
Index join_touching_pieces(const std::vector<Vector3>& points, const FaceSet& faces, Index wall_count,
                           double share, std::vector<Index>& twin);

}  // namespace mspskel::detail
