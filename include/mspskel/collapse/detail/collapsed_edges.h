// From a complex to the edges of its graph.
#pragma once

#include <algorithm>
#include <vector>

#include "mspskel/collapse/skeleton_decimater.h"

namespace mspskel {
namespace detail {

// The edges that are left, between the numbers of their ends.
inline std::vector<CollapsedEdge> collapsed_edges(const SkeletonComplex& complex,
                                                  const std::vector<Index>& number) {
  std::vector<CollapsedEdge> edges;
  for (const Index e : living_edges(complex)) {
    const auto [u, v] = complex.ends(e);
    const bool forward = number[u] < number[v];
    edges.push_back({std::min(number[u], number[v]), std::max(number[u], number[v]),
                     complex.label(forward ? 2 * e : 2 * e + 1)});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const CollapsedEdge& a, const CollapsedEdge& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return edges;
}

}  // namespace detail
}  // namespace mspskel
