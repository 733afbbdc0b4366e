// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/model/frame.hpp"

namespace scarp {

enum class ColourKind {
  scalar,   ///< one number per particle, shown on a colour bar
  classes,  ///< an index per particle ("material", "body"), shown with a legend
  scan      ///< the scan's own colours ("colour")
};

/// One particle field as it is coloured by.
struct ColourField {
  ColourKind kind = ColourKind::scalar;
  std::string label;                  ///< in words: "Displacement", "Von Mises stress", "Velocity x"
  std::string unit;                   ///< SI symbol, "1" if dimensionless
  std::vector<float> values;          ///< scalar: one per particle, SI; may be NaN
  std::vector<std::int32_t> classes;  ///< classes: one per particle
  std::vector<Rgb8> colours;          ///< scan: one per particle; black where no scan point was near
  std::vector<std::int32_t> bodies;   ///< scalar: one per particle; values of two are never blended. Empty: all one
};

/// Evaluates a field by the name of ColourOptions::field: a scalar; of a vector its length; of "stress" the von Mises
/// stress; of "NAME.x" (y, z, or xx, yy, zz, xy, yz, xz, or a number from 0) one component.
/// @throws Error ("render") if the frame has no such field or component, or an array of the wrong length.
ColourField evaluate_field(const Frame& frame, const std::string& name, int threads);

/// The displacement field, of three components.
/// @throws Error ("render") if it is absent: `why` says who needs it.
const std::vector<float>& displacements(const Frame& frame, const std::string& why);

}  // namespace scarp
