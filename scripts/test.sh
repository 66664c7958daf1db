#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests; ctest's summary comes last. usage: test.sh [PRESET]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
further=()
if [[ $preset == tsan ]]; then further=(clang libclang-rt-14-dev libomp-dev); fi
scripts/install_packages.sh "${further[@]}"
python=(-DMSPSKEL_BUILD_PYTHON=OFF)
if [[ $preset == release ]] && scripts/python_env.sh; then
  python=(-DMSPSKEL_BUILD_PYTHON=ON "-DPython_EXECUTABLE=$PWD/build-python/bin/python")
fi
cmake --preset "$preset" "${python[@]}"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
