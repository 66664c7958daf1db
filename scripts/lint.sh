#!/usr/bin/env bash
# Checks format (.clang-format) and rules (.clang-tidy) of all sources. Needs clang-format and clang-tidy 14 and a
# configured build directory. usage: lint.sh [BUILD_DIR]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
mapfile -t sources < <(git ls-files '*.h' '*.cpp')
clang-format --dry-run -Werror "${sources[@]}"
mapfile -t compiled < <(git ls-files 'src/*.cpp' 'apps/*.cpp')
printf '%s\n' "${compiled[@]}" | xargs -P "$(nproc)" -n 4 \
  clang-tidy --quiet -p "$build" --extra-arg=-std=c++17 --warnings-as-errors='*' 2>/dev/null
echo "format and rules: nothing found"
