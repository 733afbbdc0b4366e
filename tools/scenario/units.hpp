// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quantities with units in a scenario: "10 MPa", "1.8 t/m3", "9.81 m/s^2", "34 deg".
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scarp {

/// Powers of kilogram, metre, second and degree.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

/// One of it is factor * 10^power of ten base units. The power of ten is kept apart so that conversions by it
/// are exact in the last bit: "9.7 kPa" is the same double as 9700.
struct Unit {
  Dimension dimension;
  double factor = 1;
  int power_of_ten = 0;
};

/// A product of unit symbols: `kg/m3`, `kN m`, `m/s^2`, `1/m2`, `J/(kg s)`; prefixes n, u, m, c, d, k, M, G on SI
/// symbols. Empty text or "1" is the dimensionless unit.
/// @return nothing if the text is not a unit.
std::optional<Unit> parse_unit(std::string_view text);

/// "a length", "a pressure", ...; base units for what has no name ("kg m^-1 s").
std::string name_of_dimension(const Dimension& dimension);

struct Conversion {
  double value = 0;
  std::string problem;  ///< empty, or what is wrong: "must be a length, not a mass"
};

/// The number that `text` (a number, then a unit) means in `unit`, a unit that parse_unit accepts.
Conversion convert_quantity(std::string_view text, std::string_view unit);

}  // namespace scarp
