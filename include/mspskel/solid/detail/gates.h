// Where a surface of few triangles is so thin that three edges go round it.
#pragma once

#include <array>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Three edges that close up and are no face: the cross-section of a limb as thin as its mesh allows. Its
// middle is a gate, since the middles of the chords of so few vertices may not see each other through it.
struct Gate {
  std::array<Index, 3> corner;
};

// In the order of their corners. Cost: O(edges · valence).
inline std::vector<Gate> find_gates(const SurfaceSnapshot& surface) {
  std::vector<Gate> gates;
  std::vector<Index> beside(surface.position.size(), kNone);  // the last vertex that each is beside
  for (Index a = 0; a < surface.vertex_count(); ++a) {
    for_each_neighbour(surface, a, [&](Index b) { beside[b] = a; });
    const Index first = surface.vertex_halfedge[a];
    if (first == kNone) continue;
    Index h = first;
    do {
      const Index b = surface.target(h), left = surface.apex(h), right = surface.apex(surface.twin[h]);
      if (a < b)
        for_each_neighbour(surface, b, [&](Index c) {
          if (c > b && beside[c] == a && c != left && c != right) gates.push_back({{a, b, c}});
        });
      h = surface.next_outgoing(h);
    } while (h != first);
  }
  return gates;
}

}  // namespace detail
}  // namespace mspskel
