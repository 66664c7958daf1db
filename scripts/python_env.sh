#!/usr/bin/env bash
# Makes the virtual environment build-python/ with what the Python module's build and tests need. Without packages that only the
# comparison with other packages takes it goes on; without the others it fails, saying so.
set -euo pipefail
cd "$(dirname "$0")/.."
done=build-python/complete
wanted=$(sha1sum scripts/python_env.sh)
[[ -f $done && $(<"$done") == "$wanted" ]] && exit 0
python3 -m venv build-python
pip=(build-python/bin/pip --disable-pip-version-check -q install --no-compile)
"${pip[@]}" nanobind numpy pytest networkx pandas scipy trimesh 'dask[distributed]' pyarrow nbclient ipykernel matplotlib ||
  { echo "Python tests are left out: their packages cannot be installed" >&2; exit 1; }
for package in skeletor navis osteoid meshio; do
  "${pip[@]}" "$package" || echo "not compared with $package: it cannot be installed" >&2
done
echo "$wanted" >"$done"
