#!/usr/bin/env bash
# Runs the Python tests on an extension with the address and undefined behaviour sanitizers, in build-asan-python/. It fails
# too if nanobind reports a leak at the interpreter's end; the interpreter's own leaks are not looked for.
# usage: python_asan.sh [PYTEST_ARGUMENT...]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
scripts/python_env.sh
build=$PWD/build-asan-python python=$PWD/build-python/bin/python
cmake --preset asan -B "$build" -DMSPSKEL_BUILD_PYTHON=ON "-DPython_EXECUTABLE=$python" -DMSPSKEL_WITH_CGAL=OFF -DMSPSKEL_BUILD_TESTS=OFF \
  -DMSPSKEL_BUILD_APPS=OFF -DMSPSKEL_BUILD_EXAMPLES=OFF
cmake --build "$build" --target mspskel_python
# The interpreter is not instrumented, so the sanitizers' libraries come before it.
libraries=$(g++ -print-file-name=libasan.so):$(g++ -print-file-name=libubsan.so):$(g++ -print-file-name=libstdc++.so.6)
report=$(mktemp)
trap 'rm -f "$report"' EXIT
env LD_PRELOAD="$libraries" ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 PYTHONPATH="$build/python" \
  PYTHONDONTWRITEBYTECODE=1 PYTHONDEVMODE=1 "$python" -m pytest -q -p no:cacheprovider python/tests "$@" 2>&1 | tee "$report"
if grep -F "nanobind: leaked" "$report"; then
  echo "the extension leaks" >&2
  exit 1
fi
