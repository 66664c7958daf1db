// Solids made of blocks along the axes: what a workshop makes, with axes that are known.
#pragma once

#include <vector>

#include "mspskel/samples/polygonise.h"

namespace mspskel {

// A box, or a cylinder in it whose axis is one of the box's. Its ends are flat.
struct Block {
  enum class Shape { kBox, kRoundX, kRoundY, kRoundZ };  // the axis of the cylinder; its section is square
  Vector3 low, high;
  Shape shape = Shape::kBox;
};

// The block whose axis leads from one end's middle to the other's, along a coordinate axis, of a square or
// round section of that half width. Throws UsageError for another direction, or without a length or width.
Block bar(const Vector3& from, const Vector3& to, double half_width, bool round);

// The union of boxes with sharp edges, as a closed surface of about `vertices` vertices, more where that is
// needed for the corners: the planes of all sides cut space into boxes, and each rectangle between an inner
// and an outer one is cut into equal pieces. Vertices stray on the surface by up to `irregularity` of an
// edge, [0, 0.3], those on sharp edges along them. Precondition: no two boxes meet in an edge alone. Throws
// UsageError for a block that is round or has no extent. Cost: O(vertices + cells inside).
PolygonSoup make_boxes(const std::vector<Block>& blocks, Index vertices, double irregularity,
                       std::uint64_t seed);

// The union of blocks of either shape, convex edges rounded with `rounding`, which is positive and at most
// half of the least side; concave edges stay sharp.
ImplicitSolid blocks_solid(const std::vector<Block>& blocks, double rounding);

// Distance to a box round the origin with the given half sides, its edges rounded; negative inside.
double rounded_box_distance(const Vector3& p, const Vector3& half, double rounding);

}  // namespace mspskel
