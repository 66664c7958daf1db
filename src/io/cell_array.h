// Polygons and strips as VTK and glTF keep them: a list of points, and where each cell ends in it.
#pragma once

#include <cstdint>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Cell c has the points points[end[c - 1]] .. points[end[c] - 1], the first cell from 0.
struct CellArray {
  std::vector<std::int64_t> points, end;
};

// In a strip each point after the second makes a triangle with the two before it, every second one turned
// round.
enum class CellKind { kPolygons, kStrips };

// Appends the cells, whose points count from `first` and are `count` in number; cells of no points are none.
// Throws ReadError for a point that is not there, and for ends that do not fit the list.
void add_cells(const CellArray& cells, CellKind kind, Index first, Index count, PolygonSoup& soup);

}  // namespace mspskel::detail
