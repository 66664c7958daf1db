// Cone refinement of the MSP function (thesis 3.2, Fig. 3.6): where a slice is doubtful, slices along
// directions in a cone round the vertex normal are tried as well.
#pragma once

#include <cstdint>

#include "mspskel/slice/minimum_slice_perimeter.h"

namespace mspskel {

struct ConeOptions {
  bool enabled = true;
  double threshold = 0.25;  // refine where the normalised slice error exceeds this; 0 to 1
  double min_angle = 25.0;  // half angle of the cone at the threshold, degrees; 0 to 90
  double max_angle = 55.0;  // half angle of the cone at error 1, degrees; min_angle to 90
  int directions = 15;      // in the cone, 1 to 1000; each gets as many planes as the vertex normal had
  std::uint64_t seed = 1;   // turns the pattern of directions about the normal
};

inline void validate(const ConeOptions& o) {
  if (!(o.threshold >= 0 && o.threshold <= 1)) throw UsageError("cone threshold must be from 0 to 1");
  if (!(o.min_angle >= 0 && o.min_angle <= o.max_angle && o.max_angle < 90))
    throw UsageError("cone angles must satisfy 0 <= min <= max < 90 degrees");
  if (o.directions < 1 || o.directions > 1000) throw UsageError("cone directions must be from 1 to 1000");
}

// Refines the slices whose error exceeds the threshold; the old slice stays a candidate. Errors are those of
// before: call compute_slice_errors once afterwards. Cost: directions · N slices a refined vertex. Throws
// UsageError, Cancelled.
void refine_slices(const SliceTracer& tracer, const SamplingOptions& sampling, const ConeOptions& options,
                   VertexSlices& slices, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/slice/detail/cone_refinement_impl.h"
#endif
