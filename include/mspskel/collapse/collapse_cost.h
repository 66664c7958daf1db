// What it costs to collapse an edge of the skeleton mesh (thesis 4.3.2).
#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/axis_angle.h"
#include "mspskel/collapse/merging_set.h"

namespace mspskel {

// max / min of two MSP values, at least 1. 1 where either is unknown (0): no slice is no evidence of a
// difference.
inline double perimeter_ratio(double msp_u, double msp_v) {
  const double low = std::min(msp_u, msp_v), high = std::max(msp_u, msp_v);
  return low > 0 ? high / low : 1.0;
}

// The factors of an edge's cost, each without unit.
struct CostTerms {
  double perimeter_ratio = 1.0;  // max(MSP(u), MSP(v)) / min(MSP(u), MSP(v))
  double relative_length = 0.0;  // ‖e‖ / ‖e_max‖, e_max the longest edge before the first collapse
  double angle = 0.0;            // between the slices' normals as axes, radians, 0 to π/2
  double slice_error = 0.0;      // M_s(e), 0 to 1
};

// M_c(e), Eq. 4.2. A floor under the angle keeps the product from vanishing wherever two slices are parallel,
// where it would order nothing; 0 is the thesis.
inline double compactness_metric(const CostTerms& t, double angle_floor = 0.0) {
  return t.perimeter_ratio * t.perimeter_ratio * t.relative_length * t.relative_length *
         std::max(t.angle, angle_floor) / kPi;
}

// M_s(e), Eq. 4.3: the mean normalised slice error over both merging sets, 0 to 1.
inline double slice_error_metric(const MergingSet& u, const MergingSet& v) {
  const Index count = u.count() + v.count();
  return count > 0 ? (u.error_sum() + v.error_sum()) / count : 0.0;
}

// M(e) = M_c(e) + λ(1 − M_s(e)), Eq. 4.4.
inline double total_cost(const CostTerms& t, double lambda, double angle_floor = 0.0) {
  return compactness_metric(t, angle_floor) + lambda * (1.0 - t.slice_error);
}

}  // namespace mspskel
