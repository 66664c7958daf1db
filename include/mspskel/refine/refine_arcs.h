// From the collapse's graph to the finished arcs of the default mode: routed inside, pruned, centred, grown
// into the tips.
#pragma once

#include <optional>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/arcs/extend_ends.h"
#include "mspskel/arcs/route_by_class.h"
#include "mspskel/arcs/route_inside.h"
#include "mspskel/arcs/zip_arcs.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {

struct RefinementOptions {
  bool enabled = true;
  LimbOptions limbs;
  CenteringOptions centering;
  ExtensionOptions extension;
  ZipOptions zip;
  // Distance of the finished nodes along an arc, share of the model's extent, 0.0005 to 0.5; without it about
  // centering.step. It only spaces the nodes: the arcs are those that the stages made.
  std::optional<double> node_spacing;
  Index nodes = 0;             // budget of nodes, 0: none
  double joint_overlap = 1.0;  // joints closer than this many radii of the smaller ball are one, 0 to 10
};

inline void validate(const RefinementOptions& o) {
  validate(o.limbs);
  validate(o.centering);
  validate(o.extension);
  validate(o.zip);
  if (o.node_spacing && !(*o.node_spacing >= 0.0005 && *o.node_spacing <= 0.5))
    throw UsageError("node spacing must be from 0.0005 to 0.5 of the extent");
  if (o.nodes < 0) throw UsageError("nodes must be at least 0");
  if (!(o.joint_overlap >= 0 && o.joint_overlap <= 10))
    throw UsageError("joint overlap must be from 0 to 10 radii");
}

struct RefinementCounts {
  Index axes = 0;    // components without limbs that got a straight arc
  Index paths = 0;   // components whose arcs were stubs and that got their longest path inside
  Index pruned = 0;  // leaf arcs removed
  Index joints_merged = 0;
  Index completed = 0;  // arcs added for limbs that had none
  Index zips = 0;       // pairs of arcs joined from their joint to where they part
  Index corners = 0;    // that rounded arcs got
  RoutingResult routing;
  ClassRouting classes;
};

// Every step keeps the number of components and of independent cycles: leaf arcs go, arcs that are no loops
// contract, points move. With `classes`, arcs enter the solid in the class that the collapse gave them, and
// no step changes it: what would is not done, or only as far as it does not. `slices`, `tips` and the graph's
// map are of the vertices of `surface`; `input` is the surface that bounds `solid`, and the same one unless
// `surface` is coarser. Throws UsageError, Cancelled, and NoSkeletonError if a step broke that promise, which
// would be a bug.
RefinementCounts refine_arcs(ArcGraph& graph, const SurfaceSnapshot& surface, const SurfaceSnapshot& input,
                             const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                             std::vector<LimbTip> tips, const RefinementOptions& options,
                             const Execution& execution = {}, const ArcClasses& classes = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/refine_arcs_impl.h"
#endif
