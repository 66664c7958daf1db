// From the collapse's nodes and edges to hubs and arcs, and from those to the finished skeleton.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/collapse/skeleton_decimater.h"
#include "mspskel/skeleton/curve_skeleton.h"
#include "mspskel/skeleton/radius.h"
#include "mspskel/skeleton/surface_map.h"

namespace mspskel {

// Hubs are the nodes that do not have exactly two edge ends, and one node of every closed chain. Hubs and
// arcs are numbered by place in a frame that turns with the nodes. Cost: O(size · log size).
ArcGraph make_arc_graph(const CollapsedSkeleton& collapsed);

// What the collapse knows of an arc: its nodes from one hub to the other, and the label of each step.
struct ArcTube {
  std::vector<Index> nodes;
  std::vector<CocycleLabel> step;  // from nodes[i] to nodes[i + 1]
};
struct ArcTubes {
  std::vector<ArcTube> tube;       // per arc
  std::vector<Index> node_of_hub;  // per hub
};
ArcGraph make_arc_graph(const CollapsedSkeleton& collapsed, ArcTubes& tubes);

// The finished skeleton: hubs and arc points become nodes with radii, loops and parallel arcs get nodes of
// their own, each vertex goes to the nearest node of its arc (of the arcs at its hub), in connected patches.
// `perimeter` and `error` are per vertex and averaged over what maps to a node. Cost: O(vertices · points of
// an arc).
CurveSkeleton make_curve_skeleton(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                  const BoundingVolumeHierarchy& solid, const std::vector<double>& perimeter,
                                  const std::vector<double>& error, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/collapsed_arcs_impl.h"
#endif
