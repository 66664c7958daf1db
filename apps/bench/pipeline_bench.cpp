#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "benchmarks.h"
#include "models.h"
#include "mspskel/extract_skeleton.h"

namespace mspskel::bench {
namespace {

// From the snapshot to the skeleton, on all threads; a counter a stage, in seconds.
void whole(benchmark::State& state, const SurfaceSnapshot& surface, const ExtractOptions& options) {
  std::map<std::string, double> seconds;
  for (auto _ : state) {
    const ExtractResult result = extract_skeleton_of_snapshot(surface, options);
    for (const auto& [stage, time] : result.seconds) seconds[stage] += time;
  }
  for (const auto& [stage, time] : seconds)
    state.counters[stage] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
}

}  // namespace

void register_pipeline_benchmarks() {
  for (const Model& model : models()) {
    const auto add = [&](const char* mode, const ExtractOptions& options) {
      benchmark::RegisterBenchmark(
          (mode + model.name).c_str(),
          [options, &model](benchmark::State& state) { whole(state, model.surface, options); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("default mode/", default_options());
    add("thesis mode/", thesis_options());
  }
}

}  // namespace mspskel::bench
