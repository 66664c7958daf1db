// Limbs that the skeleton misses get an arc: the surface tells which parts no maximal ball comes near.
#pragma once

#include "mspskel/graph/aim_ends.h"
#include "mspskel/graph/limb_tips.h"
#include "mspskel/graph/route_inside.h"
#include "mspskel/graph/zip_arcs.h"

namespace mspskel {

// Leads an arc to every tip that no leaf arc stands for. Then, in components that have limbs and lie within
// an arc's ball's radius of the skeleton's balls but for 15 % of their surface, takes the vertex farthest
// outside all balls, leads an arc to it from the nearest point of the skeleton (straight where that is free,
// else along the middle of the solid), and keeps the arc if is_missed_limb; then the next vertex, until none
// protrudes by 3.5 smallest features. A new arc is a leaf, so the homotopy type stays. It takes the vertices
// that it covers better, and its end becomes a tip as well. Returns the number of arcs added. Cost:
// O(vertices · points) once, O(vertices · points of the arc) and a few queries an arc tried; at most 64 are
// tried.
Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const VertexSlices& slices, std::vector<LimbTip>& tips, const LimbOptions& options,
                     double step);
// With the paths of `inner`, which is of the same surface and solid.
Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const VertexSlices& slices, std::vector<LimbTip>& tips, const LimbOptions& options,
                     double step, detail::InnerGraph& inner, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/graph/detail/complete_limbs_impl.h"
#endif
