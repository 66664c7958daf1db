#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests; ctest's summary comes last. usage: test.sh [PRESET]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
further=()
if [[ $preset == tsan ]]; then further=(clang libclang-rt-14-dev libomp-dev); fi
scripts/install_packages.sh "${further[@]}"
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
