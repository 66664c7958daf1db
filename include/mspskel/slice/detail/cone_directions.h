// The cone about a vertex normal of Eq. 3.3 and 3.4: which directions it has, and how wide it is.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>
#include <vector>

#include "mspskel/base/random.h"
#include "mspskel/base/types.h"
#include "mspskel/slice/cone_refinement.h"
#include "mspskel/slice/vertex_frame.h"

namespace mspskel::detail {

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

}  // namespace mspskel::detail
