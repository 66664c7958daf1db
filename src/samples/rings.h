// Surfaces made of rings: two neighbouring rings of any number of vertices are joined by one strip of
// triangles.
#pragma once

#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// A closed chain of vertices. `turn` increases and spans less than one turn; it decides who faces whom across
// a strip.
struct Ring {
  std::vector<double> turn;
  std::vector<Index> vertex;

  Index size() const { return static_cast<Index>(vertex.size()); }
};

// Joins ring a to ring b. Both run counter-clockwise seen from b's side looking back at a, for normals that
// point outward.
void zip(PolygonSoup& soup, const Ring& a, const Ring& b);

// Fan from a ring to one vertex that lies behind it (where zip's a would be) or before it (where b would be).
void close_behind(PolygonSoup& soup, const Ring& ring, Index apex);
void close_before(PolygonSoup& soup, const Ring& ring, Index apex);

Index add_point(PolygonSoup& soup, const Vector3& point);

}  // namespace mspskel::detail
