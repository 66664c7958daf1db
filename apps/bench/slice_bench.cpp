#include <benchmark/benchmark.h>

#include "benchmarks.h"
#include "models.h"
#include "mspskel/slice/cone_refinement.h"
#include "mspskel/slice/plane_search.h"
#include "mspskel/slice/slice_error.h"

namespace mspskel::bench {
namespace {

// One thread, so that nanoseconds a step mean what they say. Seconds print with a unit prefix: "s/step=20n".
constexpr int kThreads = 1;

void count_work(benchmark::State& state, const SurfaceSnapshot& surface, std::int64_t slices,
                std::int64_t steps) {
  using benchmark::Counter;
  const double done = static_cast<double>(steps);
  state.counters["steps/vertex"] = done / surface.vertex_count();
  state.counters["s/step"] = Counter(done, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["slices/s"] = Counter(static_cast<double>(slices), Counter::kIsIterationInvariantRate);
}

void sampled_slices(benchmark::State& state, const SurfaceSnapshot& surface) {
  const SliceTracer tracer(surface);
  VertexSlices slices;
  for (auto _ : state)
    slices = compute_minimum_slice_perimeters(tracer, SamplingOptions{}, Execution{kThreads, {}});
  count_work(state, surface, slices.slices, slices.steps);
}

void searched_slices(benchmark::State& state, const SurfaceSnapshot& surface) {
  const SliceTracer tracer(surface);
  VertexSlices slices;
  for (auto _ : state)
    slices = search_minimum_slice_perimeters(tracer, SearchOptions{}, Execution{kThreads, {}});
  count_work(state, surface, slices.slices, slices.steps);
}

void slice_error(benchmark::State& state, const SurfaceSnapshot& surface) {
  const SliceTracer tracer(surface);
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, SamplingOptions{});
  const std::int64_t before = slices.steps;
  std::int64_t runs = 0;
  for (auto _ : state) {
    compute_slice_errors(tracer, SliceErrorOptions{}, slices, Execution{kThreads, {}});
    ++runs;
  }
  count_work(state, surface, surface.vertex_count(), (slices.steps - before) / runs);
}

void cone_refinement(benchmark::State& state, const SurfaceSnapshot& surface) {
  const SliceTracer tracer(surface);
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, SamplingOptions{});
  compute_slice_errors(tracer, SliceErrorOptions{}, slices);
  VertexSlices refined;
  for (auto _ : state) {
    refined = slices;
    refine_slices(tracer, SamplingOptions{}, ConeOptions{}, refined, Execution{kThreads, {}});
  }
  count_work(state, surface, refined.slices - slices.slices, refined.steps - slices.steps);
}

}  // namespace

void register_slice_benchmarks() {
  for (const Model& model : models()) {
    const auto add = [&](const char* stage, auto function) {
      benchmark::RegisterBenchmark((stage + model.name).c_str(), [function, &model](benchmark::State& state) {
        function(state, model.surface);
      })->Unit(benchmark::kMillisecond);
    };
    add("MSP by sampling/", sampled_slices);
    add("MSP by search/", searched_slices);
    add("slice error/", slice_error);
    add("cone refinement/", cone_refinement);
  }
}

}  // namespace mspskel::bench
