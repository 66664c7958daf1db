// The surface of the collapse's tubes: the vertices of each node, and the labels of ways over the surface.
#pragma once

#include <vector>

#include "mspskel/arcs/detail/chord_points.h"
#include "mspskel/arcs/route_by_class.h"
#include "mspskel/base/progress.h"

namespace mspskel {
namespace detail {

class TubeClasses {
 public:
  // Cost: O(vertices), and a step below the surface a half-edge where some cocycle is a linking number.
  TubeClasses(const CollapseTubes& tubes, const SurfaceSnapshot& surface, const CrossingLabels& crossings,
              const ChordPoints& points, const Execution& execution)
      : tubes_(tubes), surface_(surface), points_(points) {
    index_nodes();
    if (!crossings.has_loops()) return;
    parallel_for(
        static_cast<Index>(vertices_.size()), "arcs", execution, [] { return 0; },
        [&](Index i, int) { points_(vertices_[i], ChordPoints::kShallow); });
    find_potential();
  }

  // Calls visit(v) for the vertices of the node's part, ascending.
  template <class Visit>
  void for_each_vertex(Index node, Visit visit) const {
    for (Index i = begin_[node]; i < begin_[node + 1]; ++i) visit(vertices_[i]);
  }

  // Of a way from the origin of its node to the vertex. What the origins' potential adds cancels along a
  // tube.
  CocycleLabel to_vertex(Index v) const {
    if (potential_.empty()) return tubes_.to_vertex[v];
    return tubes_.to_vertex[v] + potential_[v];
  }
  CocycleLabel along_halfedge(Index h) const {
    if (potential_.empty()) return tubes_.halfedge[h];
    return tubes_.halfedge[h] + potential_[surface_.target(h)] - potential_[surface_.origin[h]];
  }

 private:
  void index_nodes() {
    Index nodes = 0;
    for (const Index node : tubes_.node_of_vertex) nodes = std::max(nodes, node + 1);
    begin_.assign(static_cast<std::size_t>(nodes) + 1, 0);
    for (const Index node : tubes_.node_of_vertex)
      if (node != kNone) ++begin_[node + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    vertices_.resize(static_cast<std::size_t>(begin_.back()));
    std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
    for (std::size_t v = 0; v < tubes_.node_of_vertex.size(); ++v)
      if (const Index node = tubes_.node_of_vertex[v]; node != kNone)
        vertices_[fill[node]++] = static_cast<Index>(v);
  }

  // The surface's labels and the linking numbers of the straight steps below its edges differ by a potential
  // of the vertices. It is carried along steps that stay inside; the few others, at edges as sharp as a step
  // is deep, may pass on the wrong side of a loop.
  void find_potential() {
    potential_.resize(tubes_.node_of_vertex.size());
    std::vector<bool> reached(potential_.size(), false);
    std::vector<Index> queue, doubtful;
    const auto reach = [&](Index h) {
      const Index v = surface_.origin[h], w = surface_.target(h);
      reached[w] = true;
      potential_[w] = potential_[v] + points_.below(h) - points_.part(tubes_.halfedge[h], false);
      queue.push_back(w);
    };
    for (const Index root : vertices_) {
      if (reached[root]) continue;
      reached[root] = true;
      queue.push_back(root);
      while (!queue.empty() || !doubtful.empty()) {
        if (queue.empty()) {
          const Index h = doubtful.back();
          doubtful.pop_back();
          if (!reached[surface_.target(h)]) reach(h);
          continue;
        }
        const Index v = queue.back();
        queue.pop_back();
        for_each_outgoing(v, [&](Index h) {
          if (reached[surface_.target(h)]) return;
          if (points_.stays_below(h))
            reach(h);
          else
            doubtful.push_back(h);
        });
      }
    }
  }
  template <class Visit>
  void for_each_outgoing(Index v, Visit visit) const {
    const Index first = surface_.vertex_halfedge[v];
    Index h = first;
    do {
      visit(h);
      h = surface_.next_outgoing(h);
    } while (h != first);
  }

  const CollapseTubes& tubes_;
  const SurfaceSnapshot& surface_;
  const ChordPoints& points_;
  std::vector<Index> begin_, vertices_;  // of each node
  std::vector<CocycleLabel> potential_;  // per vertex; empty where all cocycles are regions
};

}  // namespace detail
}  // namespace mspskel
