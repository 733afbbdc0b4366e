#!/usr/bin/env bash
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Formats every C++ file; with --check only says which would change and fails if any would.
set -euo pipefail
cd "$(dirname "$0")/../.."
mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
if [[ ${1:-} == --check ]]; then clang-format --dry-run --Werror "${files[@]}"; else clang-format -i "${files[@]}"; fi
