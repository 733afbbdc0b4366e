// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "solver/model/schema.hpp"

namespace scarp {

/// What stands for the observed surface between its points.
enum class LocalModel { nearest, plane, quadric };
template <>
struct enum_names<LocalModel> {
  static constexpr std::array<std::pair<std::string_view, LocalModel>, 3> value{
      {{"nearest", LocalModel::nearest}, {"plane", LocalModel::plane}, {"quadric", LocalModel::quadric}}};
};

struct C2cOptions {
  LocalModel local_model = LocalModel::nearest;
  int model_neighbours = 12;

  template <class V>
  void describe(V&& v) {
    v("local_model", local_model,
      Spec{.text =
               "what stands for the observed surface: its nearest point, or a least-squares plane or quadratic height "
               "function of the points around that"});
    v("model_neighbours", model_neighbours,
      Spec{.text = "observed points of which a local model is made", .at_least = 6, .at_most = 1000});
  }
};

}  // namespace scarp
