#include <benchmark/benchmark.h>

#include "benchmarks.h"
#include "models.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/mesh/build_mesh.h"

namespace mspskel::bench {
namespace {

// Nanoseconds a face, from seconds an iteration.
void count_faces(benchmark::State& state, const Model& model) {
  state.counters["faces"] = model.surface.face_count();
  state.counters["s/face"] =
      benchmark::Counter(model.surface.face_count(),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void read_off(benchmark::State& state, const Model& model) {
  for (auto _ : state) benchmark::DoNotOptimize(read_polygon_soup(model.bytes, MeshFormat::kOff));
  count_faces(state, model);
}

void build(benchmark::State& state, const Model& model) {
  for (auto _ : state) benchmark::DoNotOptimize(build_mesh(model.soup));
  count_faces(state, model);
}

void snapshot(benchmark::State& state, const Model& model) {
  const DefaultMesh mesh = build_mesh(model.soup);
  for (auto _ : state) benchmark::DoNotOptimize(make_snapshot(mesh));
  count_faces(state, model);
}

}  // namespace

void register_mesh_benchmarks() {
  for (const Model& model : models()) {
    const auto add = [&](const char* stage, auto function) {
      benchmark::RegisterBenchmark((stage + model.name).c_str(), [function, &model](benchmark::State& state) {
        function(state, model);
      })->Unit(benchmark::kMillisecond);
    };
    add("read off/", read_off);
    add("build mesh/", build);
    add("snapshot/", snapshot);
  }
}

}  // namespace mspskel::bench
