#pragma once

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/component_extents.h"

namespace mspskel {
namespace detail {

// Per node the component of its piece; kNone where no vertex maps to the piece.
inline std::vector<Index> components_of_nodes(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  std::vector<Index> component(skeleton.nodes.size(), kNone), known;
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v)
    if (skeleton.node_of_vertex[v] != kNone) component[skeleton.node_of_vertex[v]] = surface.component[v];
  for (std::size_t i = 0; i < component.size(); ++i)
    if (component[i] != kNone) known.push_back(static_cast<Index>(i));
  const std::vector<std::vector<Index>> next = adjacency(skeleton);
  for (std::size_t k = 0; k < known.size(); ++k)
    for (const Index i : next[known[k]])
      if (component[i] == kNone) {
        component[i] = component[known[k]];
        known.push_back(i);
      }
  return component;
}

}  // namespace detail

MSPSKEL_INLINE UselessPieces find_useless_pieces(const SurfaceSnapshot& surface,
                                                 const CurveSkeleton& skeleton) {
  constexpr double kRounding = 1e-9;
  const std::vector<double> extent = component_extents(surface);
  const std::vector<Index> component = detail::components_of_nodes(surface, skeleton);
  const double scale = surface.frame.scale;
  std::vector<double> length(extent.size(), 0.0);
  for (const auto& [a, b] : skeleton.edges)
    if (component[a] != kNone)
      length[component[a]] += (skeleton.nodes[a].position - skeleton.nodes[b].position).norm() / scale;
  UselessPieces useless;
  for (std::size_t c = 0; c < extent.size(); ++c)
    if (!(length[c] >= kLeastPieceLength * extent[c])) ++useless.stubs;
  for (std::size_t i = 0; i < component.size(); ++i)
    if (component[i] != kNone && !(skeleton.nodes[i].radius / scale > kRounding * extent[component[i]]))
      ++useless.on_surface;
  return useless;
}

}  // namespace mspskel
