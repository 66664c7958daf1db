// Slices and skeletal points: the stages that share the vertices of one surface among the threads.
#pragma once

#include <optional>

#include "mspskel/extract_skeleton.h"
#include "mspskel/pipeline/detail/stage_clock.h"

namespace mspskel {
namespace detail {

inline void run_slice_stages(const SliceTracer& tracer, const ExtractOptions& options, ExtractResult& result,
                             StageClock& clock) {
  if (options.slices == SliceMethod::kSearch) {
    result.slices = search_minimum_slice_perimeters(tracer, options.search, options.execution);
    clock.lap("slices");
    compute_slice_errors(tracer, options.error, result.slices, options.execution);
    clock.lap("slice_error");
    result.initial_slices = result.slices;
    return;
  }
  result.slices = compute_minimum_slice_perimeters(tracer, options.sampling, options.execution);
  clock.lap("slices");
  compute_slice_errors(tracer, options.error, result.slices, options.execution);
  clock.lap("slice_error");
  result.initial_slices = result.slices;
  if (!options.cone.enabled) return;
  refine_slices(tracer, options.sampling, options.cone, result.slices, options.execution);
  clock.lap("cone_refinement");
  compute_slice_errors(tracer, options.error, result.slices, options.execution);
  clock.lap("slice_error");
}

// Slices and skeletal points, on one surface: the stages that share their vertices among the threads.
// `of_surface` is the surface's own hierarchy, where there is one.
inline void run_vertex_stages(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy* of_surface,
                              const ExtractOptions& options, ExtractResult& result, StageClock& clock) {
  SkeletonMeshOptions points = options.points;
  // Holes of a slice are contours of the surface that was sliced.
  std::optional<BoundingVolumeHierarchy> own;
  std::optional<SliceTracer> tracer;
  run_beside(
      options.execution, [&] { tracer.emplace(surface); },
      [&](const Execution& aside) {
        if (of_surface == nullptr && points.holes != HoleSearch::kIgnore)
          own.emplace(surface, aside.progress);
      });
  run_slice_stages(*tracer, options, result, clock);
  points.solid = own ? &*own : of_surface;
  result.skeleton_mesh = make_skeleton_mesh(*tracer, result.slices, points, options.execution);
  clock.lap("skeletal_points");
}

}  // namespace detail
}  // namespace mspskel
