// What hangs on a solid by an edge, or hung on it by a flat triangle, is a part of it.
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
// Where a pair of opposite triangles was `cancelled` that had one edge in each of two pieces, they touch in
// the point v between the edges, and the pair is what is left of the material between them, as where
// decimation made a twig flat: it comes back, each triangle paired with one face across either edge.
//
// A piece joins one that it touches if its extent is below `share` of that one's, the largest ones first, and
// takes along what touches it and is as small: twigs that decimation pinched off, crumbs of voxel surfaces.
// Pieces without volume join nothing. Changes `twin` and adds to `faces`; returns how many pieces joined
// others. Cost: O(n log n).
Index join_touching_pieces(const std::vector<Vector3>& points, const FaceSet& cancelled, Index wall_count,
                           double share, FaceSet& faces, std::vector<Index>& twin);

}  // namespace mspskel::detail
