#pragma once

#include <chrono>

namespace mspskel {
namespace detail {

class StageClock {
 public:
  explicit StageClock(std::vector<std::pair<std::string, double>>& seconds) : seconds_(seconds) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    seconds_.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  std::vector<std::pair<std::string, double>>& seconds_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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

inline void report_shells(const ExtractResult& result, std::vector<std::string>& warnings) {
  if (result.skeleton_mesh.without_slice > 0)
    warnings.push_back(std::to_string(result.skeleton_mesh.without_slice) +
                       " vertices have no valid slice; their neighbours' skeletal points stand in");
  if (result.refinement.routing.unroutable > 0)
    warnings.push_back(std::to_string(result.refinement.routing.unroutable) +
                       " stretches of the skeleton leave the solid and no way inside was found");
}

}  // namespace detail

inline ExtractOptions default_options() {
  ExtractOptions o;
  // The repulsive force has a minimum in each lobe of a wide slice, the filled region's field one in the
  // middle.
  o.points.point.method = SkeletalPointMethod::kAreaField;
  o.points.holes = HoleSearch::kProbe;
  o.collapse.lambda = 0;
  o.collapse.angle_floor = 0.3;
  o.collapse.one_dimensional = EdgePolicy::kKeep;
  return o;
}

inline ExtractOptions thesis_options() {
  ExtractOptions o;
  o.mode = Mode::kThesis;
  o.slices = SliceMethod::kSampling;
  o.error = {SliceErrorAverage::kMean, SliceErrorScale::kMinMax};
  o.points.point.method = SkeletalPointMethod::kSampledForce;
  o.coherence.enabled = false;
  o.filter_branches = true;
  o.refinement.enabled = false;
  return o;
}

inline void validate(const ExtractOptions& options) {
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

inline ExtractResult extract_skeleton_of_snapshot(SurfaceSnapshot surface, const ExtractOptions& options) {
  validate(options);
  ExtractResult result;
  detail::StageClock clock(result.seconds);
  result.surface = std::move(surface);
  const SurfaceSnapshot& s = result.surface;
  const SliceTracer tracer(s);
  const BoundingVolumeHierarchy solid(s);
  clock.lap("prepare");
  detail::run_slice_stages(tracer, options, result, clock);

  SkeletonMeshOptions points = options.points;
  points.solid = &solid;
  result.skeleton_mesh = make_skeleton_mesh(tracer, result.slices, points, options.execution);
  clock.lap("skeletal_points");
  if (options.coherence.enabled) {
    apply_spatial_coherence(s, options.coherence, result.skeleton_mesh);
    clock.lap("coherence");
  }
  result.cocycles = compute_volume_cocycles(s, slice_candidates(result.slices), options.cocycles,
                                            options.execution.progress);
  clock.lap("cocycles");
  result.collapsed = collapse_skeleton_mesh(s, result.skeleton_mesh, result.cocycles.label, options.collapse,
                                            options.execution);
  clock.lap("collapse");
  if (options.filter_branches) {
    result.filter = filter_branches(result.collapsed, options.filter);
    result.collapsed = std::move(result.filter.skeleton);
    clock.lap("filter");
  }
  if (options.refinement.enabled) {
    ArcGraph arcs = make_arc_graph(result.collapsed);
    result.refinement = refine_arcs(arcs, s, solid, result.slices, options.refinement, options.execution);
    clock.lap("arcs");
    result.skeleton = make_curve_skeleton(arcs, s, solid, result.skeleton_mesh.perimeter,
                                          result.skeleton_mesh.error, options.execution);
  } else {
    result.skeleton = make_curve_skeleton(result.collapsed, s.frame);
    set_radii(s, solid, result.skeleton, options.execution);
  }
  clock.lap("result");
  detail::report_shells(result, result.warnings);
  return result;
}

template <class Mesh>
ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options) {
  return extract_skeleton_of_snapshot(make_snapshot(mesh), options);
}

}  // namespace mspskel
