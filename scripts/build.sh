#!/usr/bin/env bash
# Installs what is missing, builds build/mspskel, and makes a skeleton of the bundled sample and its picture in out/.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
cmake --preset release
cmake --build --preset release --target mspskel_cli
mkdir -p out
build/mspskel data/quadruped.off out/quadruped.skel out/quadruped.obj
build/mspskel render data/quadruped.off out/quadruped.skel out/quadruped.png
echo "made build/mspskel, out/quadruped.skel, out/quadruped.obj and out/quadruped.png"
