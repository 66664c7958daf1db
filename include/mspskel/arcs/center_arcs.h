// Re-centring: arcs are resampled evenly and drawn to the middle of the solid's cross-sections, all at once,
// by one sparse solve a round.
#pragma once

#include <string>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/slice/detail/region_moments.h"

namespace mspskel {

struct CenteringOptions {
  double step = 0.008;        // distance of arc points, share of the model's extent; 0.0005 to 0.5
  int rounds = 5;             // rounds of sections and solve, 0 to 100
  int rays = 16;              // rays a cross-section, 4 to 256
  int tangent_smoothing = 3;  // rounds of neighbour averages before tangents are taken, 0 to 100
  // Weight of |x − mean of neighbours|² against |x − centre|² where the solid is as thick as the step is
  // long; it grows with the square of the thickness, so thin limbs are followed and thick parts get straight
  // arcs. 0.1 to 1e6: with less, neighbouring points do not hold each other, and arcs grow with every round.
  double smoothness = 10.0;
  double damping = 0.5;  // share of the way to the solution that a round goes; above 0, at most 1
};

inline void validate(const CenteringOptions& o) {
  if (!(o.step >= 0.0005 && o.step <= 0.5))
    throw UsageError("arc step must be from 0.0005 to 0.5 of the extent");
  if (o.rounds < 0 || o.rounds > 100) throw UsageError("centring rounds must be from 0 to 100");
  if (o.rays < 4 || o.rays > 256) throw UsageError("centring rays must be from 4 to 256");
  if (o.tangent_smoothing < 0 || o.tangent_smoothing > 100)
    throw UsageError("tangent smoothing must be from 0 to 100");
  if (!(o.smoothness >= 0.1 && o.smoothness <= 1e6)) throw UsageError("smoothness must be from 0.1 to 1e6");
  if (!(o.damping > 0 && o.damping <= 1)) throw UsageError("damping must be above 0 and at most 1");
}

// The part of the solid's cross-section at a point that can be seen from the point.
struct VisibleSection {
  Vector3 centre = Vector3::Zero();  // where rays in opposite directions balance (to first order)
  double radius = 0.0;               // of the disc of equal area
  double mean_ray = 0.0;             // mean length of the rays
  double half_width = 0.0;           // see slice/detail/region_moments.h
  Vector3 wide = Vector3::Zero();    // unit: along its larger principal axis
  double narrowness = 1.0;           // radius of gyration across `wide` by that along it; 1 for a disc
  double roundness = 0.0;            // 4π·area / perimeter², 1 for a disc
  double clearance = 0.0;            // the shortest ray
  bool closed = false;               // every ray met the surface
};

// Rays leave x evenly in the plane across the unit vector `tangent`. With lengths r_i and directions d_i the
// centre is x + 2 mean(r_i d_i): a Newton step towards Σ r_i d_i = 0, exact for a disc. The first ray goes
// along the unit vector `first` across the tangent, or, without one, towards the nearest surface point. Cost:
// `rays` ray queries.
VisibleSection visible_section(const BoundingVolumeHierarchy& solid, const Vector3& x, const Vector3& tangent,
                               const Vector3& first, int rays);
VisibleSection visible_section(const BoundingVolumeHierarchy& solid, const Vector3& x, const Vector3& tangent,
                               int rays);

// Resamples every arc at options.step, those whose half width is below 0.006 of the extent at steps as much
// shorter as they are thinner, and centres it in sections across its direction, which is taken over a stretch
// as long as the solid is thick, less where the arc bends: minimises Σ (x − c)ᵀ W (x − c) + μ Σ|x − mean of
// neighbours|² over all points, with c the section's centre, W = w · roundness^1.5 · narrowness along the
// section's wide axis and w across it, w = 1 / (1 + (|c − x| / 0.7 R)⁴) and
// μ = smoothness · (distance to the surface / own step)² · (0.008 / options.step)². So an arc keeps to the
// middle between near walls and is straight between far ones. Within a ball it does not turn to and fro: μ is
// 1 + 100 waver² times as large (detail/waver.h). Near a joint, within two radii of its ball, sections are
// those of what the arc leaves, so W falls to 0 there with the distance. Leaf ends stay in their section,
// joints are nearly free, and hubs that are `held` stay where they are. Steps that would cut a corner through
// the surface keep the corner between them. A point moves only as far as its edges stay off the surface, so
// what is inside stays inside, and as far as no edge sweeps over a handle, so cycles keep their classes. A
// round that would make the arcs half as long again as they began, and ten steps, is the end: where there is
// hardly any thickness, neighbouring points do not hold each other, and arcs grow with every round. Cost:
// O(points · rays · log faces) a round. Throws UsageError, Cancelled.
void center_arcs(ArcGraph& graph, const BoundingVolumeHierarchy& solid, const CenteringOptions& options,
                 const Execution& execution = {}, const CrossingLabels& crossings = {},
                 const std::vector<Index>& held = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/center_arcs_impl.h"
#endif
