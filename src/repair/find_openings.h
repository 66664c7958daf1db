// Which boundary loops are ends of tubes.
#pragma once

#include <vector>

#include "close_loop.h"
#include "face_set.h"

namespace mspskel::detail {

// Whether the wall round the hole runs along the hole's normal, as a tube's does, rather than across, as
// round a hole in a wall: the mean squared cosine between the normals of faces and hole, over the faces
// connected to the loop within a radius of it, is below 1/4 (a cone whose side is 30 degrees from its axis).
// Slits, whose area is below a quarter of a circle's of their length, are none. `shape` is that of the loop
// as seen from outside, counter-clockwise. The faces are the first ones, as many as `visited` has; those
// after them close other holes and say nothing about the wall. O(faces near the loop), by way of `visited`,
// all zero before and after.
bool is_tube_end(const std::vector<Vector3>& points, const FaceSet& faces, const std::vector<Index>& twin,
                 const std::vector<Index>& loop, const LoopShape& shape, std::vector<char>& visited);

// Twice the area by the length: the radius of a round loop.
double loop_radius(const LoopShape& shape);

}  // namespace mspskel::detail
