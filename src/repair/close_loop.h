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

// Whether the centre sees the loop counter-clockwise, all but a twentieth of the area: where an edge is short
// beside the coordinates, or runs along the line of sight, its turn is anyone's.
bool is_star_shaped(const std::vector<Vector3>& loop, const LoopShape& shape);

struct TubeWall {
  Vector3 centre, axis;  // unit
  bool faces_outward;
};

// Teeth hold the loop off the tube's mouth: fills the notches between them with triangles that continue the
// wall, those of short chords first, until none is left that runs along the axis, to within 30 degrees, faces
// as the wall does, and spans less than a quarter of a turn. Returns the corners that are left.
std::vector<Index> fill_notches(const std::vector<Vector3>& loop, const TubeWall& wall, LoopClosing& closing);

// Triangles from a centre to the edges between the corners.
void add_fan(const std::vector<Index>& corners, Index centre, LoopClosing& closing);

// The triangulation of least area without further points (Barequet and Sharir 1995, "Filling gaps in the
// boundary of a polyhedron"). Longer loops than 128 edges are shortened first by the ears of shortest
// diagonals. O(size log size), and 128³ / 6.
LoopClosing least_area_triangles(const std::vector<Vector3>& loop);

}  // namespace mspskel::detail
