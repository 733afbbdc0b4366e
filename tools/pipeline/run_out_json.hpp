// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "solver/core/run_out.hpp"

namespace scarp {

/// The section "run_out" of summary.json: null for what there is none of, and why in "why_null".
/// @param origin  of local coordinates in the site's
nlohmann::ordered_json run_out_json(const RunOut& run_out, const Vec3& origin);

}  // namespace scarp
