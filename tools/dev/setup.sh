#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what scarp builds and runs with, on Debian 12. Does nothing, quickly, when all of it is there.
set -euo pipefail
cd "$(dirname "$0")/../.."

packages=(g++ make cmake ninja-build ccache pkg-config git ca-certificates
  libeigen3-dev libhdf5-dev libisal-dev libtbb-dev libgtest-dev libtoml11-dev libmuparser-dev libcli11-dev nlohmann-json3-dev libssl-dev libnanoflann-dev
  libcgal-dev libpcl-dev
  libopencv-dev libopencv-contrib-dev libgdal-dev
  fonts-dejavu-core python3 python3-numpy python3-h5py python3-vtk9)
# Node.js runs the LAZ decoder; another installation of it in the PATH serves as well.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
  echo "== installing ${#missing[@]} Debian packages: ${missing[*]}"
  as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "please install, as root: apt-get install ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
if [[ ! tools/laz2las/node_modules/laz-perf -nt tools/laz2las/package-lock.json ]]; then
  echo "== installing the LAZ decoder (npm package laz-perf)"
  npm ci --prefix tools/laz2las --no-audit --no-fund --loglevel=error
  touch tools/laz2las/node_modules/laz-perf
fi
