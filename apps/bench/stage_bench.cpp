// The default mode's stages one by one, each on what the stages before it make of the model.
#include <benchmark/benchmark.h>

#include <map>

#include "benchmarks.h"
#include "models.h"
#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/center/spatial_coherence.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/refine/find_digits.h"
#include "mspskel/refine/reach_digits.h"

namespace mspskel::bench {
namespace {

// What lies between the stages, made as extract_skeleton_of_snapshot makes it.
struct Stages {
  explicit Stages(const SurfaceSnapshot& surface)
      : input(surface),
        solid(surface),
        coarse(coarsen_surface(surface, options.coarsening)),
        working(coarse.surface),
        tracer(working),
        own(working) {
    options.points.solid = &own;
    slices = search_minimum_slice_perimeters(tracer, options.search);
    compute_slice_errors(tracer, options.error, slices);
    points = make_skeleton_mesh(tracer, slices, options.points);
    coherent = points;
    apply_spatial_coherence(working, options.coherence, coherent);
    cocycles = compute_volume_cocycles(working, slice_candidates(slices), options.cocycles);
    collapsed = collapse_skeleton_mesh(working, coherent, cocycles.label, options.collapse);
    graph = make_arc_graph(collapsed);
    refined = graph;
    tips = find_limb_tips(working, solid, slices, options.refinement.limbs);
    refine_arcs(refined, working, input, solid, slices, tips, options.refinement);
    carry_over();
  }

  void carry_over() {
    const std::vector<Index>& from = coarse.coarse_vertex;
    refined.arc_of_vertex = carried_over(refined.arc_of_vertex, from, kNone);
    refined.hub_of_vertex = carried_over(refined.hub_of_vertex, from, kNone);
    perimeter = carried_over(coherent.perimeter, from, 0.0);
    error = carried_over(coherent.error, from, 1.0);
    input_slices = carried_over(slices, from);
    input_cocycles = compute_volume_cocycles(input, slice_candidates(input_slices), options.cocycles);
    with_digits = refined;
    lead_into_digits(with_digits, {});
  }

  Index lead_into_digits(ArcGraph& arcs, const Execution& execution) const {
    return reach_digits(arcs, input, solid,
                        find_digits(arcs, input, solid, options.refinement.limbs, execution),
                        options.refinement.centering.step, options.refinement.joint_overlap);
  }

  ExtractOptions options = default_options();
  const SurfaceSnapshot& input;
  BoundingVolumeHierarchy solid;
  CoarseSurface coarse;
  const SurfaceSnapshot& working;  // the coarse surface
  SliceTracer tracer;
  BoundingVolumeHierarchy own;  // of the coarse surface
  VertexSlices slices, input_slices;
  SkeletonMesh points, coherent;
  VolumeCocycles cocycles, input_cocycles;
  CollapsedSkeleton collapsed;
  ArcGraph graph, refined, with_digits;
  std::vector<LimbTip> tips;
  std::vector<double> perimeter, error;  // per input vertex
};

const Stages& stages_of(const Model& model) {
  static std::map<const Model*, Stages> all;
  return all.try_emplace(&model, model.surface).first->second;
}

// `done` per iteration, of `vertices` vertices; seconds are wall time, so s/step falls with threads.
void count_steps(benchmark::State& state, Index vertices, std::int64_t slices, std::int64_t steps) {
  using benchmark::Counter;
  const auto done = static_cast<double>(steps);
  state.counters["slices/vertex"] = static_cast<double>(slices) / vertices;
  state.counters["steps/vertex"] = done / vertices;
  state.counters["s/step"] = Counter(done, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void hierarchy(benchmark::State& state, const Stages& s, const Execution&) {
  for (auto _ : state) benchmark::DoNotOptimize(BoundingVolumeHierarchy(s.input));
}

void coarsening(benchmark::State& state, const Stages& s, const Execution& execution) {
  for (auto _ : state) benchmark::DoNotOptimize(coarsen_surface(s.input, s.options.coarsening, execution));
  state.counters["vertices"] = s.working.vertex_count();
}

void slices(benchmark::State& state, const Stages& s, const Execution& execution) {
  VertexSlices found;
  for (auto _ : state) found = search_minimum_slice_perimeters(s.tracer, s.options.search, execution);
  count_steps(state, s.working.vertex_count(), found.slices, found.steps);
}

void slice_error(benchmark::State& state, const Stages& s, const Execution& execution) {
  VertexSlices found = s.slices;
  for (auto _ : state) {
    found.steps = 0;
    compute_slice_errors(s.tracer, s.options.error, found, execution);
  }
  count_steps(state, s.working.vertex_count(), s.working.vertex_count(), found.steps);
}

void skeletal_points(benchmark::State& state, const Stages& s, const Execution& execution) {
  SkeletonMesh mesh;
  for (auto _ : state) mesh = make_skeleton_mesh(s.tracer, s.slices, s.options.points, execution);
  state.counters["iterations/vertex"] =
      static_cast<double>(mesh.iterations) / static_cast<double>(mesh.vertex_count());
}

void coherence(benchmark::State& state, const Stages& s, const Execution&) {
  for (auto _ : state) {
    SkeletonMesh mesh = s.points;
    apply_spatial_coherence(s.working, s.options.coherence, mesh);
    benchmark::DoNotOptimize(mesh);
  }
}

// On both surfaces: the collapse needs labels of the coarse one, the result those of the input.
void cocycles(benchmark::State& state, const Stages& s, const Execution&) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        compute_volume_cocycles(s.working, slice_candidates(s.slices), s.options.cocycles));
    benchmark::DoNotOptimize(
        compute_volume_cocycles(s.input, slice_candidates(s.input_slices), s.options.cocycles));
  }
  state.counters["rank"] = s.cocycles.rank;
}

void collapse(benchmark::State& state, const Stages& s, const Execution& execution) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        collapse_skeleton_mesh(s.working, s.coherent, s.cocycles.label, s.options.collapse, execution));
}

void arcs(benchmark::State& state, const Stages& s, const Execution& execution) {
  for (auto _ : state) {
    ArcGraph graph = s.graph;
    benchmark::DoNotOptimize(
        refine_arcs(graph, s.working, s.input, s.solid, s.slices, s.tips, s.options.refinement, execution));
  }
  state.counters["arcs"] = s.graph.arc_count();
}

void digits(benchmark::State& state, const Stages& s, const Execution& execution) {
  Index added = 0;
  for (auto _ : state) {
    ArcGraph graph = s.refined;
    added = s.lead_into_digits(graph, execution);
  }
  state.counters["added"] = added;
}

void result(benchmark::State& state, const Stages& s, const Execution& execution) {
  CurveSkeleton skeleton;
  for (auto _ : state) {
    ArcGraph graph = s.with_digits;
    skeleton = make_curve_skeleton(graph, s.input, s.solid, s.perimeter, s.error, execution);
  }
  state.counters["nodes"] = static_cast<double>(skeleton.nodes.size());
}

}  // namespace

void register_stage_benchmarks() {
  const int most = thread_count({});
  for (const Model& model : models()) {
    const auto add = [&](const char* stage, auto function, bool parallel = true) {
      const auto run = [function, &model](benchmark::State& state) {
        function(state, stages_of(model), Execution{static_cast<int>(state.range(0)), {}});
      };
      auto* stage_case = benchmark::RegisterBenchmark((stage + model.name).c_str(), run);
      stage_case->Unit(benchmark::kMillisecond)->UseRealTime()->ArgName("threads")->Arg(1);
      if (parallel && most > 1) stage_case->Arg(most);
    };
    add("stage hierarchy/", hierarchy, false);
    add("stage coarsening/", coarsening, false);
    add("stage slices/", slices);
    add("stage slice error/", slice_error);
    add("stage skeletal points/", skeletal_points);
    add("stage coherence/", coherence, false);
    add("stage cocycles/", cocycles, false);
    add("stage collapse/", collapse, false);
    add("stage arcs/", arcs);
    add("stage digits/", digits);
    add("stage result/", result);
  }
}

}  // namespace mspskel::bench
