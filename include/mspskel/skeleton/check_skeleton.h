// How good a curve skeleton is for a surface: topology, containment, centredness, coverage, smoothness.
#pragma once

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/solid_hierarchies.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Lengths are fractions of the diagonal of the surface's axis-parallel bounding box, unless said otherwise.
struct SkeletonChecks {
  double diagonal = 0.0;  // model units

  // Topology: the graph has the surface's pieces and as many independent cycles as the surface has handles.
  Index components = 0, genus = 0;  // of the surface
  Index b0 = 0, b1 = 0;             // of the skeleton: pieces and independent cycles
  bool topology = false;            // b0 == components and b1 == genus

  Index nodes = 0, edges = 0, leaves = 0, joints = 0;
  Index spurs = 0;  // leaf branches whose tip lies in the maximal ball of the joint that they leave
  double length = 0.0, longest_edge = 0.0;

  // Containment, in the solid of the component that each piece stands for: exact, by nodes and edges; then
  // the share of the length, by samples every 0.0025.
  Index outside_nodes = 0;
  Index crossing_edges = 0;  // edges that meet the surface between their ends
  bool contained = false;    // no node outside and no edge crossing: every point of the skeleton is inside
  double inside = 0.0;       // 0 to 1; of the nodes if there is no edge

  // Off-centre measure at the samples inside: |Σ r d| / Σ r over 24 rays of unit direction d and length r to
  // the surface, across the skeleton. 0: centred; 1: at the wall. 0 if nothing was measured.
  Index centredness_samples = 0;
  double off_centre_mean = 0.0, off_centre_p90 = 0.0;

  // Distance from (about 2,000) surface vertices to the union of maximal balls round the samples inside of
  // the same component.
  double cover_mean = 0.0, cover_p95 = 0.0;

  // Mean turning angle, degrees, along the branches after resampling at 0.01. 0 if there is nothing to turn.
  double bend = 0.0;

  double radius_error = 0.0;  // largest |stored radius − distance to the surface| over the nodes
};

// Throws UsageError that names the first node that is not finite, or edge that names a node that is not there
// or the same node twice, or entry of the surface map that is neither a node nor kNone.
void validate(const CurveSkeleton& skeleton);

// The skeleton is in model units, hierarchy that of the snapshot. O(samples · log faces + samples · 2000),
// parallel; does not depend on the threads. Throws UsageError for a skeleton that is not valid,
// NoSkeletonError for one without nodes, Cancelled if the progress callback asks to stop.
SkeletonChecks check_skeleton(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                              const CurveSkeleton& skeleton, const Execution& execution = {});
// The same with the components' solids at hand.
SkeletonChecks check_skeleton(const SurfaceSnapshot& snapshot, const SolidHierarchies& solids,
                              const CurveSkeleton& skeleton, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/skeleton/detail/check_skeleton_impl.h"
#endif
