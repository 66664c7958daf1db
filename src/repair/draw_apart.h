// Moves vertices by so little that the shape stays, so that no two lie in one place.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

enum class Way { kIntoMaterial, kIntoVoid, kToNeighbours };

// Moves vertices by a share of their shortest edge that has a length; towards their neighbours also where
// there is no normal. A vertex whose neighbours lie in its own place stays.
void nudge(const FaceSet& faces, const std::vector<Index>& vertices, double share, Way where,
           std::vector<Vector3>& positions);

// Draws vertices apart, so that what touched lies beside and no two vertices of the surface coincide: first
// `vertices` into the material behind each, then, where several lie in the same place still, all but the
// first towards their neighbours, or any way where these lie in the same place, too. O(n log n) a round; one
// round is the rule.
void draw_apart(const FaceSet& faces, const std::vector<Index>& vertices, std::vector<Vector3>& positions);

}  // namespace mspskel::detail
