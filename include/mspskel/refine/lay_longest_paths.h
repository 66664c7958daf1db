// Solids whose arcs came out as stubs: the longest path inside in place of them.
#pragma once

#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {

// A bent body, a plate or a sheet has a way through its middle that is as long as it, whatever its centroid
// says. Every component of genus 0 whose arcs together are shorter than kLeastPieceLength of its extent gets
// one arc between two vertices that are far apart on the surface, through the solid as near to its middle as
// the way goes, and centred at steps of `step`. Components where no path is found that is longer than what
// they have stay as they are, and so do vessels among the components marked in `shells` (one mark each):
// a bowl keeps what its axis has of the solid. `inner` is of the surface and solid of the graph. Returns the
// number of paths laid. Cost: O(vertices + arcs); for each path shortest ways over the surface, a shortest
// path inside and some 1200 rays.
Index lay_longest_paths(ArcGraph& graph, detail::InnerGraph& inner, const std::vector<bool>& shells,
                        double step);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/lay_longest_paths_impl.h"
#endif
