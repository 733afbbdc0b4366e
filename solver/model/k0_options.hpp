// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "solver/model/schema.hpp"

namespace scarp {

/// Ratio of horizontal to vertical effective stress at rest.
enum class K0Rule { jaky, elastic };
template <>
struct enum_names<K0Rule> {
  static constexpr std::array<std::pair<std::string_view, K0Rule>, 2> value{
      {{"jaky", K0Rule::jaky}, {"elastic", K0Rule::elastic}}};
};

/// A start under the weight of what lies above each point.
struct K0Options {
  std::optional<double> ratio;
  K0Rule rule = K0Rule::jaky;

  template <class V>
  void describe(V&& v) {
    v("ratio", ratio,
      Spec{.text = "horizontal over vertical effective stress, of all materials; default: by the rule", .above = 0});
    v("rule", rule,
      Spec{.text =
               "\"jaky\": 1 - sin(friction_angle), and the elastic one where a law has none; \"elastic\": nu / (1 - "
               "nu), of confined compression"});
  }
};

}  // namespace scarp
