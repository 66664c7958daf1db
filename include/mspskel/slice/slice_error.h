// The slice error E_s (Eq. 3.2): how much the slices of the points on a slice disagree with it in direction.
#pragma once

#include <algorithm>

#include "mspskel/base/axis_angle.h"
#include "mspskel/base/progress.h"
#include "mspskel/slice/detail/region_moments.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

enum class SliceErrorAverage {
  kMean,     // over the contour's points
  kSum,      // Eq. 3.2 as printed
  kArcMean,  // over the contour's length: independent of tessellation
};
enum class SliceErrorScale {
  kMinMax,      // (E − E_min) / (E_max − E_min) over the mesh (Eq. 4.3)
  kRightAngle,  // E / (π/2), clamped to 1: one outlier cannot shift it
};

struct SliceErrorOptions {
  SliceErrorAverage average = SliceErrorAverage::kArcMean;
  SliceErrorScale scale = SliceErrorScale::kRightAngle;
};

namespace detail {

// E_s(v) before normalisation, in radians (a sum of radians for kSum). The angle at a crossing is that at the
// edge's ends, weighted by the crossing's position; an end without a slice leaves the word to the other.
inline double raw_slice_error(const SurfaceSnapshot& surface, const VertexSlices& slices, Index v,
                              const Contour& contour, SliceErrorAverage average) {
  const Vector3& n = slices.normal[v];
  const std::size_t count = contour.point.size();
  double sum = 0, weight = 0, length = 0;
  double first = 0, previous = 0;
  Index counted = 0;
  bool at_vertex = false;
  // Consecutive edges share an end, so each crossing brings one vertex: the angles to the slices at the ends,
  // from the negative to the positive one.
  Index end[2] = {kNone, kNone};
  double weight_of[2] = {0, 0}, angle_to[2] = {0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const Index h = contour.halfedge[i], ends[2] = {surface.origin[h], surface.target(h)};
    for (int k = 0; k < 2; ++k) {
      if (ends[k] != end[k])
        angle_to[k] = slices.valid[ends[k]] ? axis_angle(n, slices.normal[ends[k]]) : 0.0;
      end[k] = ends[k];
    }
    weight_of[0] = slices.valid[end[0]] ? 1.0 - contour.weight[i] : 0.0;
    weight_of[1] = slices.valid[end[1]] ? contour.weight[i] : 0.0;
    const double total = weight_of[0] + weight_of[1];
    const double angle =
        total > 0 ? (weight_of[0] * angle_to[0] + weight_of[1] * angle_to[1]) / total : kPi / 2;
    // The contour meets every edge of its fan at v in v itself: one point of the slice.
    if (end[1] != v || !at_vertex) {
      sum += angle;
      ++counted;
    }
    at_vertex = at_vertex || end[1] == v;
    if (i > 0) {
      length = (contour.point[i] - contour.point[i - 1]).norm();
      weight += length * 0.5 * (angle + previous);
    } else {
      first = angle;
    }
    previous = angle;
  }
  weight += (contour.point.front() - contour.point.back()).norm() * 0.5 * (first + previous);
  switch (average) {
    case SliceErrorAverage::kMean:
      return sum / counted;
    case SliceErrorAverage::kSum:
      return sum;
    case SliceErrorAverage::kArcMean:
      return weight / contour.perimeter;
  }
  return 0;
}

inline Vector3 contour_centre(const Contour& contour) {
  Vector3 sum = Vector3::Zero();
  double total = 0;
  for (std::size_t i = 0, n = contour.point.size(); i < n; ++i) {
    const Vector3 &a = contour.point[i], &b = contour.point[i + 1 == n ? 0 : i + 1];
    const double length = (b - a).norm();
    sum += 0.5 * length * (a + b);
    total += length;
  }
  return sum / total;
}

inline double contour_half_width(const Contour& contour, const Vector3& normal) {
  const Vector3 u = normal.unitOrthogonal(), w = normal.cross(u);
  RegionMoments moments;
  const Vector3& origin = contour.point.front();
  double ax = 0, ay = 0;
  for (const Vector3& point : contour.point) {
    const Vector3 b = point - origin;
    const double bx = u.dot(b), by = w.dot(b);
    moments.add(ax, ay, bx, by);
    ax = bx;
    ay = by;
  }
  return moments.half_width();
}

}  // namespace detail

// Fills in the errors, areas, half widths, centres and numbers of points of every vertex with a slice. Cost:
// one trace a vertex. Throws Cancelled.
inline void compute_slice_errors(const SliceTracer& tracer, const SliceErrorOptions& options,
                                 VertexSlices& slices, const Execution& execution = {}) {
  const SurfaceSnapshot& surface = tracer.surface();
  std::vector<std::int64_t> steps(surface.vertex_count(), 0);
  parallel_for(
      surface.vertex_count(), "slice error", execution, [] { return Contour(); },
      [&](Index v, Contour& contour) {
        if (!slice_contour(tracer, slices, v, contour)) return;
        steps[v] = static_cast<std::int64_t>(contour.point.size());
        slices.area[v] = contour.area;
        slices.half_width[v] = detail::contour_half_width(contour, slices.normal[v]);
        slices.centre[v] = detail::contour_centre(contour);
        slices.contour_points[v] = static_cast<Index>(contour.point.size());
        slices.error[v] = detail::raw_slice_error(surface, slices, v, contour, options.average);
      });
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    slices.steps += steps[v];
    if (!slices.valid[v]) continue;
    low = std::min(low, slices.error[v]);
    high = std::max(high, slices.error[v]);
  }
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (!slices.valid[v]) {
      slices.error[v] = 1.0;
    } else if (options.scale == SliceErrorScale::kMinMax) {
      slices.error[v] = high > low ? (slices.error[v] - low) / (high - low) : 0.0;
    } else {
      slices.error[v] = std::min(1.0, slices.error[v] / (kPi / 2));
    }
  }
}

}  // namespace mspskel
