#pragma once

#include <algorithm>

#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// Labels of ways within the classes, breadth first from the first vertex of each.
inline std::vector<CocycleLabel> labels_within_classes(const SurfaceSnapshot& input,
                                                       const std::vector<CocycleLabel>& halfedge_label,
                                                       const std::vector<Index>& coarse_vertex) {
  std::vector<CocycleLabel> within(input.position.size());
  std::vector<bool> reached(input.position.size(), false);
  std::vector<Index> queue;
  for (Index root = 0; root < input.vertex_count(); ++root) {
    if (reached[root] || input.vertex_halfedge[root] == kNone) continue;
    reached[root] = true;
    queue.assign(1, root);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Index v = queue[i], first = input.vertex_halfedge[v];
      Index h = first;
      do {
        const Index w = input.target(h);
        if (!reached[w] && coarse_vertex[w] == coarse_vertex[root]) {
          reached[w] = true;
          within[w] = within[v];
          within[w] += halfedge_label[h];
          queue.push_back(w);
        }
        h = input.next_outgoing(h);
      } while (h != first);
    }
  }
  return within;
}

inline Index halfedge_between(const SurfaceSnapshot& surface, Index from, Index to) {
  const Index first = surface.vertex_halfedge[from];
  Index h = first;
  do {
    if (surface.target(h) == to) return h;
    h = surface.next_outgoing(h);
  } while (h != first);
  return kNone;
}

}  // namespace detail

MSPSKEL_INLINE CoarseLabels carry_labels_over(const SurfaceSnapshot& input,
                                              const std::vector<CocycleLabel>& halfedge_label,
                                              const SurfaceSnapshot& coarse,
                                              const std::vector<Index>& coarse_vertex) {
  CoarseLabels result;
  result.halfedge.resize(coarse.origin.size());
  if (std::all_of(halfedge_label.begin(), halfedge_label.end(),
                  [](const CocycleLabel& label) { return label.is_zero(); }))
    return result;
  result.within = detail::labels_within_classes(input, halfedge_label, coarse_vertex);
  std::vector<bool> known(coarse.origin.size(), false);
  for (Index h = 0; h < input.halfedge_count(); ++h) {
    const Index v = input.origin[h], w = input.target(h);
    const Index a = coarse_vertex[v], b = coarse_vertex[w];
    if (a == b) continue;
    const Index edge = detail::halfedge_between(coarse, a, b);
    if (edge == kNone || known[edge]) continue;
    known[edge] = known[coarse.twin[edge]] = true;
    CocycleLabel label = result.within[v] + halfedge_label[h] - result.within[w];
    result.halfedge[coarse.twin[edge]] = -label;
    result.halfedge[edge] = std::move(label);
  }
  return result;
}

}  // namespace mspskel
