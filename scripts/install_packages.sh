#!/usr/bin/env bash
# Installs what scripts/packages.txt lists and the machine lacks. Debian or Ubuntu, as root or with sudo.
# usage: install_packages.sh [FURTHER_PACKAGE...]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
missing=()
for package in $(grep -v '^#' "$here/packages.txt") "$@"; do
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true) == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0
echo "installing: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || { echo "please install as root: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get -q update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends "${missing[@]}"
