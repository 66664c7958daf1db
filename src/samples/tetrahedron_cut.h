// The surface in a tetrahedron whose corners are inside or outside.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Adds the triangles between inside (value < 0) and outside corners, outward for a tetrahedron of positive
// orientation. `cut(i, j)` gives the vertex on the edge between inside corner i and outside corner j; it is
// called in the same order whatever the compiler. With inside corners first, in an even permutation: one
// inside gives the triangle ab ac ad, two the quad ac ad bd bc.
template <class Cut>
void cut_tetrahedron(PolygonSoup& soup, const std::array<double, 4>& value, const Cut& cut) {
  std::array<int, 4> t{};
  int inside = 0, outside = 4, swaps = 0;
  for (int k = 0; k < 4; ++k)
    if (value[static_cast<std::size_t>(k)] < 0)
      t[static_cast<std::size_t>(inside++)] = k;
    else
      t[static_cast<std::size_t>(--outside)] = k;
  if (inside == 0 || inside == 4) return;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) swaps += t[i] > t[j];
  if (swaps % 2 == 1) std::swap(inside == 1 ? t[2] : t[0], inside == 1 ? t[3] : t[1]);
  const auto vertex = [&](std::size_t i, std::size_t j) { return cut(t[i], t[j]); };
  if (inside == 1) {
    const Index ad = vertex(0, 3), ac = vertex(0, 2), ab = vertex(0, 1);
    soup.add_triangle(ab, ac, ad);
  } else if (inside == 3) {
    const Index cd = vertex(2, 3), bd = vertex(1, 3), ad = vertex(0, 3);
    soup.add_triangle(ad, bd, cd);
  } else {
    const Index ac = vertex(0, 2), ad = vertex(0, 3), bd = vertex(1, 3), bc = vertex(1, 2);
    soup.add_triangle(ac, ad, bd);
    soup.add_triangle(ac, bd, bc);
  }
}

// Where a linear function is 0 on the edge between two corners; off the corners, or vertices of several edges
// would coincide there.
inline Vector3 cut_point(const Vector3& a, double value_a, const Vector3& b, double value_b) {
  const double t = std::clamp(value_a / (value_a - value_b), 0.03, 0.97);
  return (1 - t) * a + t * b;
}

}  // namespace mspskel::detail
