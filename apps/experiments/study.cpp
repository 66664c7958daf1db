#include "study.h"

#include <algorithm>
#include <numeric>

#include "baseline.h"
#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/base/stopwatch.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/skeleton/make_curve_skeleton.h"

namespace mspskel::experiments {
namespace {

void run_planes(const SliceTracer& tracer, const Execution& execution, Study& study) {
  for (const int planes : kPlanes) {
    PlaneRun run;
    run.planes = planes;
    if (planes == kPlanes.back()) {  // what the thesis mode's run has done
      run.seconds = study.seconds("slices");
      run.perimeter = study.thesis.initial_slices.perimeter;
    } else {
      const Stopwatch watch;
      run.perimeter = compute_minimum_slice_perimeters(tracer, {planes}, execution).perimeter;
      run.seconds = watch.seconds();
    }
    study.planes.push_back(std::move(run));
  }
  const std::vector<double>& best = study.planes.back().perimeter;
  for (PlaneRun& run : study.planes) {
    Index counted = 0;
    for (std::size_t v = 0; v < best.size(); ++v) {
      if (!(run.perimeter[v] > 0 && best[v] > 0)) continue;
      run.excess += run.perimeter[v] / best[v] - 1;
      ++counted;
    }
    if (counted > 0) run.excess /= counted;
  }
}

// The normalised error of each mesh has a scale of its own; degrees compare.
double mean_error_degrees(const SliceTracer& tracer, VertexSlices slices, const Execution& execution) {
  compute_slice_errors(tracer, {SliceErrorAverage::kMean, SliceErrorScale::kRightAngle}, slices, execution);
  double sum = 0;
  Index counted = 0;
  for (std::size_t v = 0; v < slices.valid.size(); ++v) {
    if (!slices.valid[v]) continue;
    sum += 90 * slices.error[v];
    ++counted;
  }
  return counted > 0 ? sum / counted : 0;
}

double mean_jump(const SurfaceSnapshot& surface, const VertexSlices& slices) {
  double sum = 0;
  Index counted = 0;
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index a = surface.origin[h], b = surface.target(h);
    if (surface.twin[h] < h || !slices.valid[a] || !slices.valid[b]) continue;
    sum +=
        2 * std::abs(slices.perimeter[a] - slices.perimeter[b]) / (slices.perimeter[a] + slices.perimeter[b]);
    ++counted;
  }
  return counted > 0 ? sum / counted : 0;
}

double triangles_area(const SurfaceSnapshot& surface, const std::vector<Vector3>& position) {
  double twice = 0;
  for (Index h = 0; h < surface.halfedge_count(); h += 3) {
    const Vector3 &a = position[surface.origin[h]], &b = position[surface.origin[h + 1]],
                  &c = position[surface.origin[h + 2]];
    twice += (b - a).cross(c - a).norm();
  }
  return twice / 2;
}

double triangles_volume(const SurfaceSnapshot& surface, const std::vector<Vector3>& position) {
  double six = 0;
  for (Index h = 0; h < surface.halfedge_count(); h += 3)
    six += position[surface.origin[h]].dot(
        position[surface.origin[h + 1]].cross(position[surface.origin[h + 2]]));
  return six / 6;
}

void run_skeleton_meshes(const SliceTracer& tracer, const Execution& execution, Study& study) {
  SkeletonMeshOptions centre;
  centre.point.method = SkeletalPointMethod::kCentre;
  study.skeleton_meshes = {make_skeleton_mesh(tracer, study.thesis.initial_slices, centre, execution),
                           make_skeleton_mesh(tracer, study.thesis.slices, centre, execution),
                           study.thesis.skeleton_mesh};
  const SurfaceSnapshot& surface = study.thesis.surface;
  for (std::size_t i = 0; i < study.skeleton_meshes.size(); ++i) {
    const std::vector<Vector3>& moved = study.skeleton_meshes[i].position;
    study.area_share[i] = triangles_area(surface, moved) / triangles_area(surface, surface.position);
    study.volume_share[i] = triangles_volume(surface, moved) / triangles_volume(surface, surface.position);
  }
}

// The saturation threshold enters with the collapse; all before it is shared.
void run_sweep(const BoundingVolumeHierarchy& solid, const ExtractOptions& options, Study& study) {
  const ExtractResult& thesis = study.thesis;
  for (const double threshold : kThresholds) {
    CollapseOptions collapse = options.collapse;
    collapse.saturation_threshold = threshold;
    const CollapsedSkeleton collapsed = collapse_skeleton_mesh(
        thesis.surface, thesis.skeleton_mesh, thesis.cocycles.label, collapse, options.execution);
    SkeletonRun run;
    run.skeleton =
        make_curve_skeleton(filter_branches(collapsed, options.filter).skeleton, thesis.surface.frame);
    run.checks = check_skeleton(thesis.surface, solid, run.skeleton, options.execution);
    study.sweep.push_back(std::move(run));
  }
}

double total(const std::vector<std::pair<std::string, double>>& seconds) {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0,
                         [](double sum, const auto& lap) { return sum + lap.second; });
}

void run_skeletons(const BoundingVolumeHierarchy& solid, const Execution& execution, Study& study) {
  study.skeletons.push_back({"thesis mode", total(study.thesis.seconds), study.thesis.skeleton, {}});
  ExtractOptions options = default_options();
  options.execution = execution;
  ExtractResult result = extract_skeleton_of_snapshot(study.thesis.surface, options);
  study.skeletons.push_back({"default mode", total(result.seconds), std::move(result.skeleton), {}});
  const Stopwatch watch;
  CurveSkeleton baseline = baseline_skeleton(study.thesis.surface);
  const double seconds = watch.seconds();
  if (!baseline.nodes.empty()) study.skeletons.push_back({"contraction", seconds, std::move(baseline), {}});
  for (SkeletonRun& run : study.skeletons)
    run.checks = check_skeleton(study.thesis.surface, solid, run.skeleton, execution);
}

// Vertices in the order of the nodes that they map to, these arc by arc: neighbours on a limb are neighbours
// in the walk, whatever the file's order.
std::vector<Index> walk_along(const CurveSkeleton& skeleton) {
  std::vector<Index> rank(skeleton.nodes.size(), kNone);
  Index next = 0;
  for (const Branch& branch : branches(skeleton))
    for (const Index node : branch.nodes)
      if (rank[node] == kNone) rank[node] = next++;
  std::vector<Index> walk;
  for (Index v = 0; v < static_cast<Index>(skeleton.node_of_vertex.size()); ++v)
    if (skeleton.node_of_vertex[v] != kNone) walk.push_back(v);
  std::stable_sort(walk.begin(), walk.end(), [&](Index a, Index b) {
    return rank[skeleton.node_of_vertex[a]] < rank[skeleton.node_of_vertex[b]];
  });
  return walk;
}

}  // namespace

double Study::seconds(const std::string& stage) const {
  for (const auto& [name_of_lap, lap] : thesis.seconds)
    if (name_of_lap == stage) return lap;
  return 0;
}

Study run_study(const std::string& name, const SurfaceSnapshot& surface, const Execution& execution) {
  Study study;
  study.name = name;
  ExtractOptions options = thesis_options();
  options.execution = execution;
  study.thesis = extract_skeleton_of_snapshot(surface, options);
  for (const Index genus : study.thesis.cocycles.genus) study.genus += genus;

  const ExtractResult& thesis = study.thesis;
  const SliceTracer tracer(thesis.surface);
  const BoundingVolumeHierarchy solid(thesis.surface);
  run_planes(tracer, execution, study);
  const auto refined = std::count(thesis.slices.refined.begin(), thesis.slices.refined.end(), 1);
  study.refined_share = static_cast<double>(refined) / surface.vertex_count();
  study.error = {mean_error_degrees(tracer, thesis.initial_slices, execution),
                 mean_error_degrees(tracer, thesis.slices, execution)};
  study.jump = {mean_jump(thesis.surface, thesis.initial_slices), mean_jump(thesis.surface, thesis.slices)};
  run_skeleton_meshes(tracer, execution, study);
  run_sweep(solid, options, study);
  run_skeletons(solid, execution, study);
  study.walk = walk_along(study.skeletons[1].skeleton);
  return study;
}

void drop_bulk(Study& study) {
  for (PlaneRun& run : study.planes) run.perimeter = {};
  SurfaceSnapshot counts;
  counts.position.resize(study.thesis.surface.position.size());
  counts.origin.resize(study.thesis.surface.origin.size());
  std::vector<std::pair<std::string, double>> seconds = std::move(study.thesis.seconds);
  study.thesis = {};
  study.thesis.seconds = std::move(seconds);
  study.thesis.surface = std::move(counts);
  study.skeleton_meshes = {};
  study.walk = {};
}

}  // namespace mspskel::experiments
