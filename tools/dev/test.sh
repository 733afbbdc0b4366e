#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs, builds and runs every test that is not a benchmark. Arguments go to ctest (such as -L unit).
# Real data is found through $SCARP_DATA, by default ../shared/data; tests that need it say so when it is absent.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/dev/build.sh
echo "== testing"
ctest --test-dir "${SCARP_BUILD:-build}" --output-on-failure -LE bench "$@"
