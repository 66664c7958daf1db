// Which component of a surface each piece of a skeleton stands for.
#pragma once

#include <array>
#include <vector>

#include "mspskel/mesh/solid_hierarchies.h"

namespace mspskel {

// A skeleton as points and straight edges, normalised units. Parallel edges and loops are allowed.
struct PolylineGraph {
  std::vector<Vector3> position;
  std::vector<std::array<Index, 2>> edges;
  // Per node the component of the surface that it stands for, as far as it is known: kNone, or empty.
  std::vector<Index> component;
};

// The component that each node stands for, from the map of the surface's vertices to nodes (kNone entries are
// skipped). Throws UsageError for a node out of range.
std::vector<Index> component_of_nodes(const SurfaceSnapshot& surface, Index node_count,
                                      const std::vector<Index>& node_of_vertex);

// Per node the smallest node of its piece.
std::vector<Index> pieces_of(const PolylineGraph& graph);

// Per node. What the graph knows stays; other nodes have the component of their piece. A piece of which
// nothing is known stands for the component whose solid holds most of its nodes: of several, one that no
// other piece stands for, then the smallest solid, which lies inside the others. Where no solid holds a node,
// it is the component of the face nearest to the piece's first node. `piece` is of pieces_of, `whole` the
// hierarchy of all faces. Cost: O(nodes · components around a node · log faces).
std::vector<Index> find_components(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& whole,
                                   const SolidHierarchies& solids, const PolylineGraph& graph,
                                   const std::vector<Index>& piece);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/piece_components_impl.h"
#endif
