// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/pipeline/bench.hpp"

namespace scarp {

/// What a step costs where two slabs of neo-Hookean material, ten cells thick, are pressed together by a face: a
/// twentieth of their particles are of the two layers that touch. The same steps without contact.method, in the same
/// run, are what it is a multiple of. On the first instruction set and number of threads of the options.
std::vector<ContactCost> bench_contact(const BenchOptions& options);

}  // namespace scarp
