// Arcs that leave a joint side by side through the same limb are one arc up to where they part.
#pragma once

#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct ZipOptions {
  // Two arcs run side by side while their distance is below this share of the smaller maximal ball's radius;
  // 0 to 2, 0 zips nothing.
  double closeness = 0.75;
};

inline void validate(const ZipOptions& o) {
  if (!(o.closeness >= 0 && o.closeness <= 2))
    throw UsageError("closeness of zipped arcs must be from 0 to 2 radii");
}

// Zips pairs of arcs from their common joint to where they part, the longest common way first; the joint
// moves there along one common stem. A leaf arc that never parts from its neighbour goes, unless it ends at
// one of the hubs that are kept (a mark for each, or none), as the ends of two toes. Identifying two
// paths with a common start keeps the homotopy type. Vertices of the arcs go to the stem where that is
// nearer. Two arcs are zipped only as far as what lies between them goes round no handle. Returns the number
// of zips. Cost: O(arcs² · points) distance queries a joint, then after each zip for the pairs whose arcs it
// changed.
// Throws UsageError, Cancelled.
Index zip_arcs(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
               const ZipOptions& options, const CrossingLabels& crossings = {},
               const Execution& execution = {}, const std::vector<bool>& kept = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/zip_arcs_impl.h"
#endif
