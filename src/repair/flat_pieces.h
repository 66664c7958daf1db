// What decimation made flat, as pieces with a thickness.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

// Each triangle that two opposite faces cancelled becomes two pyramids, base on base, a tenth as high as its
// shortest edge. Those that hang together over edges are one piece. Where they close a ring over edges it
// stays open at one of them, so that a piece is a sphere.
//
// Adds the tips of the pyramids to `points`, six faces a triangle to `faces` and their twins. The first three
// of the six run along the triangle's edges as it does. O(n log n).
void add_flat_pieces(const FaceSet& cancelled, std::vector<Vector3>& points, FaceSet& faces,
                     std::vector<Index>& twin);

// Joins the surfaces on both sides of two half-edges that run between the same points, the same way: each
// goes on over the edge on the other one.
void bridge_edge(Index h, Index g, std::vector<Index>& twin);

}  // namespace mspskel::detail
