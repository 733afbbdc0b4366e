// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// What counts as moved, and which way run-out is measured.
struct RunOutOptions {
  std::optional<double> threshold;
  std::optional<Vec3> direction;

  template <class V>
  void describe(V&& v) {
    v("threshold", threshold,
      Spec{.text = "material points displaced by at least this have moved; default: a cell of the domain",
           .unit = "m",
           .above = 0});
    v("direction", direction,
      Spec{.text = "run-out is measured along the horizontal part of this; default: the mean displacement of what has "
                   "moved"});
  }
};

}  // namespace scarp
