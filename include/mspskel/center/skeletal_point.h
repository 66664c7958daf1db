// The skeletal point of one slice: the place in its plane where the skeleton passes (thesis 4.2).
#pragma once

#include "mspskel/base/error.h"
#include "mspskel/center/planar_region.h"
#include "mspskel/center/repulsive_force.h"

namespace mspskel {

enum class SkeletalPointMethod {
  kCentre,        // the mean of the outer contour's points by arc length; may lie outside, as the thesis says
  kSampledForce,  // the six steps of 4.2.2 on the sampled force of Eq. 4.1
  kClosedForm,    // the same steps on Eq. 4.1 integrated along the contour, by Newton's method
  kAreaField,     // where the field of the filled region vanishes, from the region's centroid
  kVisibleField,  // where the field of the part visible from the point itself vanishes
  // Closed form, without a vote: from the region's first contour point down into the nearest valley of the
  // potential, and not along it. For regions without one centre, such as the ring of a cup's wall: neighbours
  // on the surface get neighbouring points.
  kNearestValley,
};

struct SkeletalPointOptions {
  SkeletalPointMethod method = SkeletalPointMethod::kClosedForm;
  // Sampled force. Lengths are in perimeters of the outer contour.
  Index moving_samples = 32;   // moving samples, even in arc length, 1 to 10000
  Index force_samples = 64;    // on the outer contour, holes at the same spacing, 3 to 100000
  double displacement = 1e-3;  // a moving sample's first distance from the contour, (0, 0.1]
  double step = 0.25;          // a step, in distances to the contour, (0, 0.9]
  // Sampled force and closed form.
  double merge_radius = 0.02;  // minima closer than this are one, in perimeters, [0, 1]
  // Closed form.
  Index starts = 8;          // descents, even in arc length, 1 to 10000
  double start_depth = 0.5;  // where on the inward chord of its contour point a descent starts, (0, 0.9]
  // Descend on contours resampled to this many segments, then finish on the whole ones: 8 to 1000000; 0:
  // never.
  Index max_segments = 0;
  // Visible field.
  Index rays = 64;  // 8 to 100000
  // Newton: a step shorter than this many mean widths is the last one; its own error is of second order.
  // [1e-12, 0.1]
  double tolerance = 1e-3;
  Index max_iterations = 200;  // a sample's steps at most, 1 to 100000
};

// Throws UsageError naming the first option that is out of its range.
void validate(const SkeletalPointOptions& options);

enum class SkeletalPointStop {
  kConverged,  // a centre, or a minimum that samples converged to
  // Sampled force: the winner stopped where the force grows, as the thesis says, though it has not vanished.
  kShoulder,
  kIterations,  // the winner ran out of iterations or of room for smaller steps
  // The region's centroid lies outside, or the filled or visible region's field has no zero well inside: the
  // nearest valley's point.
  kNearestValleyInstead,
  kDeepestSample,  // no sample got anywhere: the one farthest from the contour
  kDegenerate,     // no region to speak of: the contour's centre
};

inline constexpr std::size_t kSkeletalPointStops = 6;

struct SkeletalPoint {
  Vector2 position = Vector2::Zero();
  Index votes = 0;       // samples that converged to it
  Index samples = 0;     // samples that were traced; the rest could not have changed the vote
  Index minima = 0;      // distinct minima seen
  Index iterations = 0;  // steps of all samples
  SkeletalPointStop stop = SkeletalPointStop::kDegenerate;
};

// The skeletal point of a region, in the region's coordinates. For the force methods and the field methods it
// lies strictly inside the region (unless kDegenerate), and so do all samples at all times: a step that would
// cross a contour is shortened. The winner among several minima is the one with most votes (thesis 4.2.2);
// equal votes go to the lower potential (sampled force: the lower force), then to the first. Everything
// scales and turns with the region. On slices longer than about three widths the repulsive force has a
// minimum near each end and a saddle between; the area field has one zero, in the middle. Throws UsageError
// for bad options. Cost: samples · iterations · segments.
SkeletalPoint find_skeletal_point(const PlanarRegion& region, const SkeletalPointOptions& options = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/skeletal_point_impl.h"
#endif
