// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/free_surface.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// The values of a field if it has type T, one row of `components` per particle; nullptr if the frame has no such
/// field.
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

double magnitude(const float* row, std::size_t components) {
  double squared = 0;
  for (std::size_t c = 0; c < components; ++c) squared += static_cast<double>(row[c]) * row[c];
  return std::sqrt(squared);
}

}  // namespace

PointCloud free_surface(const Frame& frame) {
  const auto* surface = values_of<std::uint8_t>(frame, "surface", "uint8, 1 on the free surface");
  if (!surface || surface->size() != frame.positions.size())
    throw Error("compare", "the frame does not say which particles form the free surface",
                surface ? "a vector field" : "no field", "a uint8 field \"surface\" with one value per particle");
  const auto* displacement = values_of<float>(frame, "displacement", "float32");
  PointCloud cloud;
  cloud.site = frame.site;
  PointScalar moved{"displacement", "m", {}};
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    if ((*surface)[i] != 1) continue;
    cloud.positions.push_back(frame.positions[i]);
    if (!displacement) continue;
    const std::size_t components = displacement->size() / frame.positions.size();
    moved.values.push_back(magnitude(displacement->data() + i * components, components));
  }
  if (cloud.empty())
    throw Error("compare", "the frame has no free surface",
                "0 of " + std::to_string(frame.positions.size()) + " particles",
                "at least 1 particle whose field \"surface\" is 1");
  if (displacement) cloud.scalars.push_back(std::move(moved));
  return cloud;
}

}  // namespace scarp
