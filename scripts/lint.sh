#!/usr/bin/env bash
# Checks format (.clang-format) and rules (.clang-tidy) of all sources. Needs clang-format and clang-tidy 14 and a
# configured build directory, of the preset dev unless another is named. usage: lint.sh [BUILD_DIR]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build-dev}
mapfile -t sources < <(git ls-files '*.h' '*.cpp')
clang-format --dry-run -Werror "${sources[@]}"
# clang-tidy goes on with rules of its own where it cannot read ours.
mistakes=$(clang-tidy --dump-config 2>&1 >/dev/null)
[[ -z $mistakes ]] || { echo "$mistakes" >&2; exit 1; }
compiled=()
for source in $(git ls-files 'src/*.cpp' 'apps/*.cpp'); do
  if grep -q "$PWD/$source\"" "$build/compile_commands.json"; then
    compiled+=("$source")
  else
    echo "not looked at, since $build does not compile it: $source"
  fi
done
printf '%s\n' "${compiled[@]}" | xargs -P "$(nproc)" -n 4 \
  clang-tidy --quiet -p "$build" --extra-arg=-std=c++17 --extra-arg=-Wno-unknown-warning-option \
    --warnings-as-errors='*' 2>/dev/null
echo "format and rules: nothing found"
