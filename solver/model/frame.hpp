// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/site.hpp"

namespace scarp {

/// One array of a frame, `components` values per particle, row-major.
struct FrameField {
  std::string name;
  std::string unit;  ///< "1" when dimensionless
  int components = 1;
  std::variant<std::vector<float>, std::vector<std::int64_t>, std::vector<std::int32_t>, std::vector<std::uint8_t>>
      values;
};

/// The material points at one instant, ready to be written, drawn or compared.
struct Frame {
  double time = 0;  ///< s
  std::int64_t step = 0;
  std::vector<Vec3> positions;  ///< m, local; double, so that a comparison does not see the storage
  std::vector<FrameField> fields;
  SiteFrame site;
};

/// The field of that name, or nullptr.
inline const FrameField* find_field(const Frame& frame, const std::string& name) {
  for (const FrameField& field : frame.fields)
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace scarp
