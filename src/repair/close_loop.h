// Triangles across a hole.
#pragma once

#include <array>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

struct LoopShape {
  Vector3 centre = Vector3::Zero();  // weighted by length
  Vector3 area = Vector3::Zero();    // along the normal round which the loop runs counter-clockwise
  double length = 0.0;
};
LoopShape loop_shape(const std::vector<Vector3>& loop);

struct LoopClosing {
  std::vector<std::array<Index, 3>>
      triangles;  // corners are places in the loop, counter-clockwise as it runs
};

// A fan round the centre, if from there the whole loop is seen counter-clockwise.
bool is_star_shaped(const std::vector<Vector3>& loop, const LoopShape& shape);
LoopClosing fan_round_centre(Index size);

// The triangulation of least area without further points (Barequet and Sharir 1995, "Filling gaps in the
// boundary of a polyhedron"). Longer loops than 128 edges are shortened first by the ears of shortest
// diagonals. O(size log size), and 128³ / 6.
LoopClosing least_area_triangles(const std::vector<Vector3>& loop);

}  // namespace mspskel::detail
