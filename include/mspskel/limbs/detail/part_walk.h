// The parts of a surface beyond a level, and what lies beside them.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The Euler characteristic of some vertices with the edges and triangles between them, 1 for a disc. `holds`
// tells whether a vertex is one of them. O(part).
template <class Holds>
Index euler_characteristic(const SurfaceSnapshot& surface, const std::vector<Index>& part, Holds holds) {
  Index twice_edges = 0, thrice_faces = 0;
  for (const Index v : part) {
    const Index first = surface.vertex_halfedge[v];
    Index h = first;
    do {
      const bool next = holds(surface.target(h));
      twice_edges += next;
      thrice_faces += next && holds(surface.apex(h));
      h = surface.next_outgoing(h);
    } while (h != first);
  }
  return static_cast<Index>(part.size()) - twice_edges / 2 + thrice_faces / 3;
}

// Walks on the vertices of one surface, by one distance. Cost of each: O(the vertices that it comes by).
class PartWalk {
 public:
  PartWalk(const SurfaceSnapshot& surface, const std::vector<double>& distance)
      : surface_(surface), distance_(distance), walked_(surface.position.size(), 0) {}

  // Those beyond a level that hang together with a top.
  std::vector<Index> beyond(Index top, double level) {
    ++walk_;
    std::vector<Index> part{top};
    walked_[top] = walk_;
    for (std::size_t i = 0; i < part.size(); ++i)
      for_each_neighbour(surface_, part[i], [&](Index w) {
        if (walked_[w] == walk_ || distance_[w] < level) return;
        walked_[w] = walk_;
        part.push_back(w);
      });
    return part;
  }

  // Those next to a part that has just been walked.
  std::vector<Index> ring(const std::vector<Index>& part) {
    const Index inside = walk_++;
    std::vector<Index> round;
    for (const Index v : part)
      for_each_neighbour(surface_, v, [&](Index w) {
        if (walked_[w] == inside || walked_[w] == walk_) return;
        walked_[w] = walk_;
        round.push_back(w);
      });
    for (const Index v : part) walked_[v] = walk_;
    return round;
  }

  // The ring round a part that has just been walked, and the surface beyond it as far as `reach`.
  std::vector<Index> surface_beside(std::vector<Index> round, const Vector3& middle, double reach) {
    for (std::size_t i = 0; i < round.size(); ++i)
      for_each_neighbour(surface_, round[i], [&](Index w) {
        if (walked_[w] == walk_ || (surface_.position[w] - middle).squaredNorm() >= reach * reach) return;
        walked_[w] = walk_;
        round.push_back(w);
      });
    return round;
  }

  // Whether the last walk came by.
  bool holds(Index v) const { return walked_[v] == walk_; }

 private:
  const SurfaceSnapshot& surface_;
  const std::vector<double>& distance_;
  std::vector<Index> walked_;  // the last walk that came by
  Index walk_ = 0;
};

}  // namespace detail
}  // namespace mspskel
