// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/elastic_parameters.hpp"

namespace scarp {

struct LinearElastic : ElasticParameters {
  static constexpr std::string_view name = "linear-elastic";

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
  }
};

}  // namespace scarp
