#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/pipeline/detail/carry_over.h"
#include "mspskel/pipeline/detail/extract_components.h"
#include "mspskel/pipeline/detail/warnings.h"

namespace mspskel {

MSPSKEL_INLINE ExtractOptions default_options() {
  ExtractOptions o;
  // The repulsive force has a minimum in each lobe of a wide slice, the filled region's field one in the
  // middle.
  o.points.point.method = SkeletalPointMethod::kAreaField;
  o.points.point.tolerance = 0.01;  // its square is the error
  o.points.holes = HoleSearch::kProbe;
  o.collapse.lambda = 0;
  o.collapse.angle_floor = 0.3;
  o.collapse.one_dimensional = EdgePolicy::kKeep;
  return o;
}

MSPSKEL_INLINE ExtractOptions thesis_options() {
  ExtractOptions o;
  o.mode = Mode::kThesis;
  o.coarsen = false;
  o.slices = SliceMethod::kSampling;
  o.error = {SliceErrorAverage::kMean, SliceErrorScale::kMinMax};
  o.points.point.method = SkeletalPointMethod::kSampledForce;
  o.coherence.enabled = false;
  o.filter_branches = true;
  o.refinement.enabled = false;
  return o;
}

MSPSKEL_INLINE void validate(const ExtractOptions& options) {
  validate(options.coarsening);
  validate(options.subdivision);
  if (options.limb_vertices < 4) throw UsageError("limb vertices must be at least 4");
  validate(options.search);
  validate(options.sampling);
  validate(options.cone);
  validate(options.points);
  validate(options.coherence);
  validate(options.cocycles);
  validate(options.collapse);
  validate(options.filter);
  validate(options.refinement);
}

MSPSKEL_INLINE ExtractResult extract_skeleton_of_snapshot(SurfaceSnapshot surface,
                                                          const ExtractOptions& options) {
  validate(options);
  std::optional<SubdividedSurface> fine;
  if (options.coarsen && has_long_edge(surface, options.subdivision))
    fine = subdivide_surface(surface, options.subdivision, options.execution);
  ExtractResult result;
  if (fine && fine->cuts > 0) {
    result = detail::extract_pieces(std::move(fine->surface), options);
    detail::restrict_to_input(std::move(surface), fine->vertex, options, result);
  } else {
    result = detail::extract_pieces(std::move(surface), options);
  }
  detail::collect_warnings(result);
  return result;
}

}  // namespace mspskel
