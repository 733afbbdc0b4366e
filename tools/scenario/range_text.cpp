// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/range_text.hpp"

#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {

std::string range_text(const Spec& spec, std::string_view unit) {
  const std::string tail = unit.empty() ? "" : " " + std::string(unit);
  if (std::isfinite(spec.at_least) && std::isfinite(spec.at_most))
    return "from " + shortest(spec.at_least) + " to " + shortest(spec.at_most) + tail;
  std::string low, high;
  if (std::isfinite(spec.at_least)) low = "at least " + shortest(spec.at_least);
  if (std::isfinite(spec.above)) low = "above " + shortest(spec.above);
  if (std::isfinite(spec.at_most)) high = "at most " + shortest(spec.at_most);
  if (std::isfinite(spec.below)) high = "below " + shortest(spec.below);
  if (low.empty() && high.empty()) return "";
  return low + (low.empty() || high.empty() ? "" : " and ") + high + tail;
}

bool is_within(double value, const Spec& spec) {
  return std::isfinite(value) && value >= spec.at_least && value > spec.above && value <= spec.at_most &&
         value < spec.below;
}

}  // namespace scarp
