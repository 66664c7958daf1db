// Arcs that leave the solid are led back through it, along the middle of the chords that start at the
// surface.
#pragma once

#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

namespace detail {
class InnerGraph;
class InnerPaths;
}  // namespace detail

struct RoutingResult {
  Index hubs_moved = 0;  // hubs that lay outside
  Index routed = 0;      // stretches of arcs replaced by a path inside
  Index unroutable = 0;  // stretches for which no path was found: they stay as they were
};

// Moves hubs that lie outside to the nearest chord middle of their part, and replaces every stretch of an arc
// that leaves the solid by the path of least length / clearance along edges of the mesh whose ends were moved
// to the middle of their inward chord. Such a path stays close to the medial surface and follows thin walls.
// Does nothing where all is inside. Cost: O(points · log faces), and a shortest path over the mesh for each
// stretch.
RoutingResult route_inside(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                           const SurfaceSnapshot& surface);
// In the solid of `inner`, with its paths. Throws UsageError if the graph's map is not of the vertices of its
// surface.
RoutingResult route_inside(ArcGraph& graph, detail::InnerGraph& inner);

// The same for arcs alone: hubs stay, the graph's map is not read, and the paths may be those of any surface
// within the solid. Arcs that are marked in `held`, where it is given, stay as they are.
RoutingResult route_arcs_inside(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                detail::InnerPaths& inner, const std::vector<bool>& held = {});

// Edges of the arcs that meet the surface. A query a point.
Index count_crossing_edges(const ArcGraph& graph, const BoundingVolumeHierarchy& solid);

// Removes leaf arcs that leave the solid: where a surface crosses itself, parts of what it bounds may be out
// of one another's reach. Returns their number. Cost: a query a point.
Index remove_crossing_leaves(ArcGraph& graph, const BoundingVolumeHierarchy& solid);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/route_inside_impl.h"
#endif
