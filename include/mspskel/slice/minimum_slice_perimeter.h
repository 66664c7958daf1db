// The minimum slice perimeter (MSP) function of thesis 3.1: per vertex the shortest of N planar slices.
#pragma once

#include <string>

#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/slice/vertex_frame.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

struct SamplingOptions {
  int planes = 25;  // N planes a vertex at equal steps of angle (thesis 5.2), 1 to 1000
};

inline void validate(const SamplingOptions& options) {
  if (options.planes < 1 || options.planes > 1000)
    throw UsageError("slices must be from 1 to 1000, not " + std::to_string(options.planes));
}

namespace detail {

// Best slice so far at one vertex, and the work spent.
struct BestSlice {
  SliceTracer::Shortest shortest;
  Vector3 normal = Vector3::Zero();
  std::int64_t slices = 0, steps = 0;

  void try_plane(const SliceTracer& tracer, Index v, const Vector3& plane) {
    ++slices;
    const auto found = tracer.shortest_through(v, plane, shortest.perimeter, steps);
    if (found.perimeter < shortest.perimeter) {
      shortest = found;
      normal = plane;
    }
  }
};

// N planes that contain the line p + s·axis (Eq. 3.1), at equal angles from u.
inline void try_planes_round(const SliceTracer& tracer, Index v, const Vector3& axis, const Vector3& u,
                             int planes, BestSlice& best) {
  const Vector3 w = axis.cross(u);
  for (int i = 0; i < planes; ++i) best.try_plane(tracer, v, plane_normal(u, w, kPi * i / planes));
}

// Stores the best slice as v's.
inline void store_slice(Index v, const BestSlice& best, VertexSlices& slices) {
  if (best.shortest.start == kNone) return;
  slices.perimeter[v] = best.shortest.perimeter;
  slices.normal[v] = best.normal;
  slices.start[v] = best.shortest.start;
  slices.valid[v] = 1;
}

}  // namespace detail

// f(p) of thesis 3.1 at every vertex, over N planes that contain the vertex normal (Eq. 3.1). Errors and
// what the whole contour tells are left to compute_slice_errors. Cost: O(N · crossings) a vertex, about √V
// crossings a slice; OpenMP over vertices, the result does not depend on the number of threads. Throws
// UsageError, Cancelled.
inline VertexSlices compute_minimum_slice_perimeters(const SliceTracer& tracer,
                                                     const SamplingOptions& options,
                                                     const Execution& execution = {}) {
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  VertexSlices slices;
  slices.resize(surface.vertex_count());
  std::vector<std::array<std::int64_t, 2>> work(surface.vertex_count(), {0, 0});
  parallel_for(
      surface.vertex_count(), "slices", execution, [] { return 0; },
      [&](Index v, int) {
        if (surface.vertex_halfedge[v] == kNone) return;
        const VertexFrame frame = make_vertex_frame(surface, v);
        detail::BestSlice best;
        detail::try_planes_round(tracer, v, frame.normal, frame.u, options.planes, best);
        detail::store_slice(v, best, slices);
        work[v] = {best.slices, best.steps};
      });
  for (const auto& [planes, steps] : work) {
    slices.slices += planes;
    slices.steps += steps;
  }
  return slices;
}

}  // namespace mspskel
