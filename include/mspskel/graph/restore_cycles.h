// Arcs whose cycle does not go round its handle are led round it.
#pragma once

#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/graph/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

struct CycleRestoration {
  Index cycles = 0;     // independent cycles of the graph
  Index rank = 0;       // of their signed crossings, after the restoration
  Index restored = 0;   // arcs that got another way
  Index abandoned = 0;  // arcs for which none was found: they stay as they were
};

// The collapse's labels say that the graph's cycles are independent in the solid, but its points may lie
// outside, and an arc that is brought back inside may take the wrong side of a handle. Goes through the arcs,
// those given in `doubtful` last; where an arc closes a cycle whose crossings depend on those of the cycles
// before it, the arc takes the cheapest way through the solid that makes them independent: along edges of the
// mesh whose ends were moved to the middle of their inward chord, or just below the surface where there is no
// other way, found by a shortest path among pairs of vertex and label (a finite piece of a covering space).
// Does nothing where all cycles are independent. Expects arcs that lie inside. Cost: O(points · rank);
// O(vertices · log vertices · log faces) an arc that is led anew.
CycleRestoration restore_cycles(ArcGraph& graph, const SurfaceSnapshot& surface,
                                const BoundingVolumeHierarchy& solid, const VolumeCocycles& cocycles,
                                const std::vector<bool>& doubtful = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/graph/detail/restore_cycles_impl.h"
#endif
