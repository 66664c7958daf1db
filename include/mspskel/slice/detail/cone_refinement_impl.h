#pragma once

#include <glm/gtc/quaternion.hpp>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/base/random.h"

namespace mspskel {
namespace detail {

// (ξx, ξy) of Eq. 3.3: equal steps in ξx and the golden ratio's recurrence in ξy spread any number of
// directions evenly; the seed turns the pattern about the normal.
inline std::vector<std::pair<double, double>> cone_pattern(const ConeOptions& options) {
  constexpr double kGolden = 0.6180339887498949;
  const double turn = Random(options.seed).uniform();
  std::vector<std::pair<double, double>> pattern;
  for (int i = 0; i < options.directions; ++i) {
    const double y = turn + kGolden * i;
    pattern.emplace_back((i + 0.5) / options.directions, y - std::floor(y));
  }
  return pattern;
}

inline glm::dvec3 to_glm(const Vector3& a) { return {a.x(), a.y(), a.z()}; }
inline Vector3 from_glm(const glm::dvec3& a) { return {a.x, a.y, a.z}; }

// S_c of Eq. 3.4: Y_local is the vertex normal, Z_local lies across it. ξx of Eq. 3.3 is scaled so that
// θ = 2 arccos √(1 − ξx) stays within the cone's half angle.
inline Vector3 cone_direction(const VertexFrame& frame, double half_angle, double xi_x, double xi_y) {
  const double limit = std::sin(half_angle / 2) * std::sin(half_angle / 2);
  const double theta = 2 * std::acos(std::sqrt(1 - limit * xi_x)), phi = 2 * kPi * xi_y;
  const glm::dquat about_y = glm::angleAxis(phi, to_glm(frame.normal)),
                   about_z = glm::angleAxis(theta, to_glm(frame.v));
  return from_glm(about_y * (about_z * to_glm(frame.normal)));
}

// The half angle grows linearly with the error from the threshold to 1 (thesis 3.2). Radians.
inline double cone_half_angle(const ConeOptions& options, double error) {
  const double t = options.threshold < 1 ? (error - options.threshold) / (1 - options.threshold) : 1.0;
  return (options.min_angle + std::min(1.0, std::max(0.0, t)) * (options.max_angle - options.min_angle)) *
         kPi / 180;
}

}  // namespace detail

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
