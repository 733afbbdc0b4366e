// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/compare_options.hpp"

namespace CLI {
class App;
}

namespace scarp {

/// Gives a verb an option for every key of a comparison that its schema describes: "normal_radii" of "m3c2" becomes
/// --normal-radii, and those of "tolerance" --tolerance-mean. Types, units, ranges and sentences are the schema's. The
/// two sides themselves are not options.
void add_compare_arguments(CLI::App& verb, CompareOptions& options);

}  // namespace scarp
