// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "tools/pipeline/stopwatch.hpp"

namespace scarp {

/// Seconds.
struct Times {
  double processor = INFINITY, wall = INFINITY;
};

/// The shortest of several: what other users of the machine add is always more.
template <class F>
Times fastest(int repeats, F&& f) {
  Times best;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    f();
    best.processor = std::min(best.processor, watch.processor());
    best.wall = std::min(best.wall, watch.wall());
  }
  return best;
}

}  // namespace scarp
