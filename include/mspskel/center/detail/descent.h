// Minimising a potential inside a planar region.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mspskel/center/planar_region.h"
#include "mspskel/center/repulsive_force.h"

namespace mspskel::detail::slice_centre {

struct Descent {
  Vector2 position = Vector2::Zero();
  double potential = 0.0;
  Index iterations = 0;
  bool converged = false;
  Index joined = kNone;  // the minimum that it came close to
};

// The eigenvalues of the Hessian, the smaller first, and the smaller one's unit eigenvector.
struct Eigen2 {
  double low, high;
  Vector2 low_axis;

  explicit Eigen2(const FieldValue& f) {
    const double mean = 0.5 * (f.xx + f.yy), half = 0.5 * (f.xx - f.yy), radius = std::hypot(half, f.xy);
    low = mean - radius;
    high = mean + radius;
    // Of the two rows that give the axis of `high`, the one without cancellation.
    const Vector2 axis = half > 0 ? Vector2(half + radius, f.xy) : Vector2(f.xy, radius - half);
    const double norm = axis.norm();
    low_axis = norm > 0 ? turn_left(Vector2(axis / norm)) : Vector2(1, 0);
  }
};

struct DescentRule {
  double tolerance = 1e-3;  // in mean widths
  Index max_iterations = 200;
  // Stay in the cross-section of a valley: no step along the flat axis where its eigenvalue is below this
  // share of the steep one's.
  double flat = -std::numeric_limits<double>::infinity();
};

// Newton's step with the Hessian's eigenvalues replaced by their absolute values, floored: downhill always,
// and away from saddles.
inline Vector2 newton_step(const FieldValue& f, const Eigen2& e, double flat) {
  const Vector2 high_axis = turn_left(e.low_axis);
  const double floor = 1e-3 * std::max(std::abs(e.low), std::abs(e.high));
  if (!(floor > 0)) return Vector2::Zero();
  const Vector2 steep = f.force.dot(high_axis) / std::max(std::abs(e.high), floor) * high_axis;
  if (e.low < flat * e.high) return steep;
  return f.force.dot(e.low_axis) / std::max(std::abs(e.low), floor) * e.low_axis + steep;
}

// Shortens a step that would cross a contour to three quarters of the way there.
inline Vector2 shorten_to_contour(const PlanarRegion& region, const Vector2& from, const Vector2& step) {
  const double hit = region.first_hit(from, step);
  return hit <= 1 ? Vector2(0.75 * hit * step) : step;
}

// Modified Newton with backtracking on the potential. `field(p)` returns a FieldValue, `region` bounds the
// samples, `near(p)` returns the index of a known minimum that p may join, or kNone.
template <class Field, class Near>
Descent descend(const PlanarRegion& region, const Field& field, Vector2 start, const DescentRule& rule,
                const Near& near) {
  constexpr double kMaxStep = 0.25, kArmijo = 1e-4, kSmallest = 1e-9;  // lengths in perimeters
  const double unit = region.perimeter(), small = rule.tolerance * region.mean_width();
  Descent d;
  d.position = start;
  FieldValue value = field(start);
  bool nudged = false;
  while (d.iterations < rule.max_iterations) {
    d.potential = value.potential;
    d.joined = near(d.position);
    if (d.joined != kNone || !std::isfinite(value.potential)) return d;
    const Eigen2 e(value);
    Vector2 step = newton_step(value, e, rule.flat);
    if (step.norm() < small && e.low < 0 && e.low >= rule.flat * e.high && !nudged) {
      // On a saddle: leave it once along its downhill axis, in the direction of the remaining force if there
      // is any.
      step += (step.dot(e.low_axis) < 0 ? -10.0 : 10.0) * small * e.low_axis;
      nudged = true;
    }
    const double length = step.norm();
    if (length > kMaxStep * unit) step *= kMaxStep * unit / length;
    step = shorten_to_contour(region, d.position, step);
    ++d.iterations;
    if (length < small) {  // the last step: its error is of second order, so nothing is left to test
      d.position += step;
      d.converged = true;
      return d;
    }
    if (step.norm() < kSmallest * unit) return d;  // pressed against a contour
    for (;; step *= 0.5) {
      const Vector2 trial = d.position + step;
      const FieldValue next = field(trial);
      if (next.potential <= value.potential - kArmijo * step.dot(value.force)) {
        d.position = trial;
        value = next;
        break;
      }
      // Rounding of the potential hides any smaller gain.
      if (step.norm() < kSmallest * unit) return d;
    }
  }
  d.potential = value.potential;
  return d;
}

}  // namespace mspskel::detail::slice_centre
