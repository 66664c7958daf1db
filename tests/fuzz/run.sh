#!/usr/bin/env bash
# Builds the fuzz targets with clang and gives each reader RUNS inputs. usage: run.sh BUILD_DIR [RUNS]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=${1:?usage: run.sh BUILD_DIR [RUNS]}
runs=${2:-2000000}
cmake -S "$here/../.." -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DMSPSKEL_BUILD_FUZZERS=ON \
  -DMSPSKEL_BUILD_TESTS=OFF -DMSPSKEL_BUILD_APPS=OFF -DMSPSKEL_BUILD_EXAMPLES=OFF
cmake --build "$build" --target mspskel_fuzzers
for format in off obj ply stl; do
  grown=$build/corpus/$format
  mkdir -p "$grown"
  echo "== $format"
  "$build/tests/fuzz/fuzz_$format" -runs="$runs" -max_len=2048 -dict="$here/$format.dict" -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$build/$format-" "$grown" "$here/corpus/$format"
done
