#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs, builds and runs the main job: a scanned hillside becomes a simulation, pictures and distances in
# out/hillside. Arguments go to scarp run (such as --set domain.cell=2).
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/dev/build.sh scarp
echo "== scarp run datasets/hillside/scenario.toml -o out/hillside"
"${SCARP_BUILD:-build}/bin/scarp" run datasets/hillside/scenario.toml -o out/hillside "$@"
echo "== what it made"
find out/hillside -type f | sort | sed -E 's/_[0-9]{6}\./_NNNNNN./' | uniq -c
