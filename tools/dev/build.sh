#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Configures and builds into build/ (or $SCARP_BUILD), with the compiler cache inside it. Arguments: ninja targets.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/dev/setup.sh
build=${SCARP_BUILD:-build}
mkdir -p "$build"
echo "== configuring $build"
cmake -S . -B "$build" -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 >"$build/configure.log" 2>&1 ||
  { tail -n 30 "$build/configure.log" >&2; exit 1; }
echo "== building with $(nproc) jobs"
ninja -C "$build" --quiet "$@"
