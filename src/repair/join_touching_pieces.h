// What hangs on a solid by an edge, or hung on it by something flat, is a part of it.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

//    \ void /                  \ void /
//     \    /                    \    /       Pieces that touch in an edge: what were the two faces of each
//  A   edge   B    becomes   A  =====  B      piece there become two pairs across it, so that the solids are
//     /    \                    /    \       one, over a bridge along the edge. No handle arises, since that
//    / void \                  / void \      is done once between two pieces.
//
// A piece joins one that it touches if its extent is below `share` of that one's, the largest ones first, and
// takes along what touches it and is as small: twigs that decimation pinched off, crumbs of voxel surfaces.
//   What was `cancelled` may be left of material that decimation made flat. It comes back with a thickness
// (flat_pieces.h) where a small piece hangs on a larger one by it, and where it goes on where a solid ends in
// an acute edge, as a flat tip of a twig does. Other pieces without volume join nothing.
//   Adds to `points`; changes `twin` and adds to `faces`. Cost: O(n log n).
struct JoinedPieces {
  Index solid = 0;           // pieces that joined others
  Index flat_triangles = 0;  // cancelled ones that came back
};
JoinedPieces join_touching_pieces(const FaceSet& cancelled, double share, std::vector<Vector3>& points,
                                  FaceSet& faces, std::vector<Index>& twin);

}  // namespace mspskel::detail
