// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/error.hpp"
#include "solver/model/frame.hpp"

namespace scarp {

/// The values of a field of a frame if it has type T, one row of `components` per particle; nullptr if there is no
/// such field. `type` names what is allowed. @throws Error ("compare") for another type or a length that does not fit.
template <class T>
const std::vector<T>* values_of(const Frame& frame, const std::string& name, const char* type) {
  const FrameField* field = find_field(frame, name);
  if (!field) return nullptr;
  const auto* values = std::get_if<std::vector<T>>(&field->values);
  if (!values) throw Error("compare", "field \"" + name + "\" of the frame has another type", "", type);
  const std::size_t expected = frame.positions.size() * static_cast<std::size_t>(std::max(field->components, 0));
  if (field->components < 1 || values->size() != expected)
    throw Error("compare", "field \"" + name + "\" of the frame does not fit its particles",
                std::to_string(values->size()) + " values of " + std::to_string(field->components) + " components",
                "one row for each of " + std::to_string(frame.positions.size()) + " particles");
  return values;
}

}  // namespace scarp
