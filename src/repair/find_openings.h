// Which boundary loops are ends of tubes.
#pragma once

#include <optional>
#include <vector>

#include "close_loop.h"
#include "face_set.h"

namespace mspskel::detail {

struct TubeEnd {
  LoopShape shape;      // of the loop when its notches are filled
  LoopClosing closing;  // corners are places in the rim; its size is that of the centre
};

// What closes a loop that is the end of a tube. `rim`: the loop as seen from outside, counter-clockwise.
//   The wall is the faces connected to the loop within a radius of it. It is a tube's if it runs along an
//   axis
// within 30 degrees of the hole's normal, rather than across, as round a hole in a wall: the mean squared
// cosine between the axis and the normals of the faces is below 1/4 (a cone whose side is 30 degrees from its
// axis). Notches between teeth are filled then, and what is left has to be a mouth: its centre sees all of
// it, and it is no slit, whose area is below a quarter of a circle's of its length.
//   The wall is among the first faces, as many as `visited` has; those after them close other holes and say
// nothing about it. O(faces near the loop), by way of `visited`, all zero before and after.
std::optional<TubeEnd> tube_end(const std::vector<Vector3>& points, const FaceSet& faces,
                                const std::vector<Index>& twin, const std::vector<Index>& loop,
                                const std::vector<Vector3>& rim, std::vector<char>& visited);

// Twice the area by the length: the radius of a round loop.
double loop_radius(const LoopShape& shape);

}  // namespace mspskel::detail
