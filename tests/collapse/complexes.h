// Small complexes with known answers, and random ones.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mspskel/collapse/skeleton_complex.h"

namespace mspskel::test {

// A complex from triangles of distinct vertices; label_of(u, v) for u < v.
template <class LabelOf>
SkeletonComplex complex_of(Index vertices, const std::vector<std::array<Index, 3>>& faces, LabelOf label_of) {
  SkeletonComplex complex(vertices);
  std::map<std::pair<Index, Index>, Index> edge;
  const auto dart = [&](Index u, Index v) {
    const std::pair<Index, Index> key = std::minmax(u, v);
    return 2 * edge.at(key) + (u > v ? 1 : 0);
  };
  for (const auto& f : faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair<Index, Index> key = std::minmax(f[i], f[(i + 1) % 3]);
      edge.insert({key, 0});
    }
  for (auto& [ends, e] : edge)
    e = complex.add_edge(ends.first, ends.second, label_of(ends.first, ends.second));
  for (const auto& f : faces) complex.add_face(dart(f[0], f[1]), dart(f[1], f[2]), dart(f[2], f[0]));
  return complex;
}

inline CocycleLabel no_label(Index, Index) { return {}; }

inline SkeletonComplex tetrahedron_complex() {
  return complex_of(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, no_label);
}

// Möbius and Császár's torus: vertex i + 2j of Z/7 at the lattice point (i, j). Every two vertices are
// joined.
inline std::vector<std::array<Index, 3>> seven_vertex_torus_faces() {
  std::vector<std::array<Index, 3>> faces;
  for (Index i = 0; i < 7; ++i) {
    faces.push_back({i, (i + 1) % 7, (i + 3) % 7});
    faces.push_back({i, (i + 3) % 7, (i + 2) % 7});
  }
  return faces;
}

// Labels a and b for the two steps 1 and 2 of the lattice Z² whose quotient by the kernel of (i, j) → i + 2j
// mod 7 is the torus: an edge's label is the coordinate vector of its step minus that of a fixed section of
// the vertices.
inline SkeletonComplex seven_vertex_torus(const CocycleLabel& a, const CocycleLabel& b) {
  const auto times = [](const CocycleLabel& label, int n) {
    CocycleLabel sum;
    for (int i = 0; i < std::abs(n); ++i) n > 0 ? sum += label : sum -= label;
    return sum;
  };
  // The kernel is spanned by (7, 0) and (-2, 1); in that basis vertex k's lift (k, 0) is (k/7, 0), and the
  // steps 1, 2, 3 to a lift (m, 0) with j rows passed make the loops j and the wraps of the first coordinate.
  return complex_of(7, seven_vertex_torus_faces(), [&](Index u, Index v) {
    const Index difference = (v - u + 7) % 7;
    const bool forward = difference <= 3;  // the step is +1, +2 or +3, or the reverse of one
    const Index step = forward ? difference : 7 - difference;
    const Index from = forward ? u : v;
    const int rows = step >= 2 ? 1 : 0;  // steps 2 and 3 go one row up
    const int wraps = from + step >= 7 ? 1 : 0;
    const CocycleLabel label = times(a, wraps) + times(b, rows);
    return forward ? label : -label;
  });
}

}  // namespace mspskel::test
