#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds, runs all validation tests and writes their table: tests/validation/README.md, and its summary in README.md.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/dev/build.sh scarp validation
build=${SCARP_BUILD:-build}
ctest --test-dir "$build" --output-on-failure -L validation -E validation_table
/usr/bin/python3 tests/validation/table.py "$build/validation_rows" --write
