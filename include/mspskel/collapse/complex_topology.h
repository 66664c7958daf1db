// Betti numbers of a skeleton complex's graph, the rank of its labels, and the edges that it has too many.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "mspskel/collapse/label_rank.h"
#include "mspskel/collapse/skeleton_complex.h"

namespace mspskel {

// A disjoint-set forest whose members know the label of a path to their root.
class LabelledForest {
 public:
  explicit LabelledForest(Index size) : parent_(static_cast<std::size_t>(size)), to_parent_(parent_.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // Joins the trees of both ends along an edge u → v with the given label and returns true; if they are one
  // tree already, returns false and sets `loop` to the label of the loop that the edge closes.
  bool join(Index u, Index v, const CocycleLabel& label, CocycleLabel& loop) {
    const Index root_u = find(u), root_v = find(v);
    // root_u ← u → v → root_v, the path between the roots.
    CocycleLabel between = label + to_root(v) - to_root(u);
    if (root_u == root_v) {
      loop = std::move(between);
      return false;
    }
    to_parent_[root_u] = std::move(between);
    parent_[root_u] = root_v;
    return true;
  }

 private:
  // Afterwards the parent of x is its root.
  Index find(Index x) {
    path_.clear();
    while (parent_[x] != x) {
      path_.push_back(x);
      x = parent_[x];
    }
    for (std::size_t i = path_.size(); i-- > 1;) {
      to_parent_[path_[i - 1]] += to_parent_[path_[i]];
      parent_[path_[i - 1]] = x;
    }
    return x;
  }
  CocycleLabel to_root(Index x) const { return parent_[x] == x ? CocycleLabel{} : to_parent_[x]; }

  std::vector<Index> parent_;
  std::vector<CocycleLabel> to_parent_;
  std::vector<Index> path_;
};

// Edges that are joined in this order make a forest of edges without crossings, as far as there is one, which
// leaves short labels for the cycles.
inline bool has_fewer_crossings(const CocycleLabel& a, const CocycleLabel& b) {
  return a.entries().size() < b.entries().size();
}

struct ComplexTopology {
  Index components = 0;  // b0
  Index cycles =
      0;  // edges − vertices + b0: the graph's first Betti number, the complex's once no face is left
  Index label_rank =
      0;  // rank of the labels of the loops, at most `cycles`; the complex's b1 is never below it
};

namespace detail {

// Goes through the edges in the given order; calls surplus(e) for each that closes a loop whose label depends
// on those of the loops before it.
template <class Surplus>
ComplexTopology walk_loops(const SkeletonComplex& complex, const std::vector<Index>& order, Surplus surplus) {
  ComplexTopology topology;
  LabelledForest forest(complex.vertex_capacity());
  LabelRank rank;
  CocycleLabel loop;
  topology.components = complex.vertex_count();
  for (const Index e : order) {
    const auto [u, v] = complex.ends(e);
    if (forest.join(u, v, complex.label(2 * e), loop)) {
      --topology.components;
    } else {
      ++topology.cycles;
      if (!rank.insert(loop)) surplus(e);
    }
  }
  topology.label_rank = rank.rank();
  return topology;
}

inline std::vector<Index> living_edges(const SkeletonComplex& complex) {
  std::vector<Index> edges;
  for (Index e = 0; e < complex.edge_capacity(); ++e)
    if (complex.is_edge(e)) edges.push_back(e);
  return edges;
}

}  // namespace detail

// Cost: O(edges + cycles · rank · g).
inline ComplexTopology complex_topology(const SkeletonComplex& complex) {
  return detail::walk_loops(complex, detail::living_edges(complex), [](Index) {});
}

// The edges without which the graph has as many components and the same rank of labels, but no other loops:
// b1 = rank. Edges are vectors (boundary, label) of a linear matroid, so keeping greedily in the order of
// `keep_first` (shorter edges first, say) drops a set of largest total length. Cost: a sort and
// complex_topology().
template <class Less>
std::vector<Index> surplus_edges(const SkeletonComplex& complex, Less keep_first) {
  std::vector<Index> order = detail::living_edges(complex), surplus;
  std::stable_sort(order.begin(), order.end(), keep_first);
  detail::walk_loops(complex, order, [&](Index e) { surplus.push_back(e); });
  return surplus;
}

}  // namespace mspskel
