// Arcs enter the solid in the class that the collapse gave them.
#pragma once

#include <vector>

#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

// Where the collapse has its arcs run, on the input surface.
struct CollapseTubes {
  ArcTubes arcs;                        // of make_arc_graph
  std::vector<Index> node_of_vertex;    // per vertex of the input; kNone: in no tube
  std::vector<CocycleLabel> to_vertex;  // per vertex of the input: the way to it from its node's origin
  std::vector<CocycleLabel> halfedge;   // per half-edge of the input
};

// What keeps the classes of cycles while arcs move. Without handles there is nothing to keep, and the default
// says so.
struct ArcClasses {
  CrossingLabels crossings;
  CollapseTubes tubes;
};

struct ClassRouting {
  Index checked = 0;    // arcs that are part of a cycle, or lead from one to another
  Index routed = 0;     // of these, arcs that were led anew
  Index abandoned = 0;  // of these, arcs for which no way was found: they stay as they were
};

// Per arc whether it is left when leaf arcs are taken away for as long as there are any: part of a cycle, or
// on the way from one to another.
std::vector<bool> arcs_of_cycles(const ArcGraph& graph);

// Each node of the collapse stands for a part of the surface, so an arc has a tube: the parts of its nodes,
// one after the other. A path along the edges of the mesh within the tube has the arc's class, and the same
// path between the middles of the inward chords has it too where the crossings of each step say so. An arc
// that leaves the solid, or whose crossings with the cocycles' regions are not those of its tube, takes the
// path of least length / clearance of this kind; just below the surface where there is no other, and past the
// surface where that crosses itself and leaves no way inside. Leaf arcs close no cycle and stay.
//
// Linking numbers are held against those of the same path just below the surface. Expects the arcs of
// make_arc_graph. Cost: a label and a query a point; a shortest path within its tube an arc that is
// led anew. Throws Cancelled.
ClassRouting route_by_class(ArcGraph& graph, const CollapseTubes& tubes, const SurfaceSnapshot& input,
                            const BoundingVolumeHierarchy& solid, const CrossingLabels& crossings,
                            const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/route_by_class_impl.h"
#endif
