#pragma once

#include "mspskel/base/linkage.h"
#include "mspskel/slice/detail/cone_directions.h"

namespace mspskel {

MSPSKEL_INLINE void refine_slices(const SliceTracer& tracer, const SamplingOptions& sampling,
                                  const ConeOptions& options, VertexSlices& slices,
                                  const Execution& execution) {
  validate(sampling);
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  const auto pattern = detail::cone_pattern(options);
  std::vector<std::array<std::int64_t, 2>> work(surface.vertex_count(), {0, 0});
  parallel_for(
      surface.vertex_count(), "cone refinement", execution, [] { return 0; },
      [&](Index v, int) {
        if (surface.vertex_halfedge[v] == kNone || (slices.valid[v] && slices.error[v] <= options.threshold))
          return;
        const VertexFrame frame = make_vertex_frame(surface, v);
        const double half_angle = detail::cone_half_angle(options, slices.error[v]);
        detail::BestSlice best;
        if (slices.valid[v]) best.try_plane(tracer, v, slices.normal[v]);
        for (const auto& [xi_x, xi_y] : pattern) {
          const Vector3 axis = detail::cone_direction(frame, half_angle, xi_x, xi_y);
          const Vector3 across = frame.u - frame.u.dot(axis) * axis;
          detail::try_planes_round(tracer, v, axis, across.normalized(), sampling.planes, best);
        }
        detail::store_slice(v, best, slices);
        slices.refined[v] = 1;
        work[v] = {best.slices, best.steps};
      });
  for (const auto& [planes, steps] : work) {
    slices.slices += planes;
    slices.steps += steps;
  }
}

}  // namespace mspskel
