#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests; ctest's summary comes last. usage: test.sh [PRESET]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
scripts/install_packages.sh
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
