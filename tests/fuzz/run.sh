#!/usr/bin/env bash
# Builds the fuzz targets with clang, gives each reader RUNS inputs, the pipeline and mending SECONDS each; see docs/fuzzing.md.
# usage: run.sh BUILD_DIR [RUNS [SECONDS]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=${1:?usage: run.sh BUILD_DIR [RUNS [SECONDS]]}
runs=${2:-2000000}
seconds=${3:-7200}
cmake -S "$here/../.." -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -D_GLIBCXX_ASSERTIONS" -DMSPSKEL_SANITIZE=fuzzer-no-link,address,undefined \
  -DMSPSKEL_BUILD_FUZZERS=ON -DMSPSKEL_BUILD_TESTS=OFF -DMSPSKEL_BUILD_APPS=OFF -DMSPSKEL_BUILD_EXAMPLES=OFF
cmake --build "$build" --target mspskel_fuzzers
for format in off obj ply stl; do
  ((runs)) || break
  grown=$build/corpus/$format
  mkdir -p "$grown"
  echo "== $format"
  "$build/tests/fuzz/fuzz_$format" -runs="$runs" -max_len=2048 -dict="$here/$format.dict" -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$build/$format-" "$grown" "$here/corpus/$format"
done
((seconds)) || exit 0
for target in pipeline mending; do
  grown=$build/corpus/$target
  mkdir -p "$grown"
  echo "== $target"
  OMP_NUM_THREADS=2 "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=128 -timeout=300 -rss_limit_mb=4096 \
    -print_final_stats=1 -artifact_prefix="$build/$target-" "$grown"
done
