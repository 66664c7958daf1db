// mspskel-bench: time and work of every stage. --help lists Google Benchmark's options.
#include <benchmark/benchmark.h>

#include "benchmarks.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  mspskel::bench::register_mesh_benchmarks();
  mspskel::bench::register_slice_benchmarks();
  mspskel::bench::register_stage_benchmarks();
  mspskel::bench::register_pipeline_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
