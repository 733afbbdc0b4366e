// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields that a scenario gives as formulas.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// The value of a field at the reference position X, m, and time t, s.
using Field = std::function<Vec3(const Vec3& X, double t)>;

/// A field with one formula per axis, in X, Y, Z, t and pi: + - * / ^ and the functions of muParser (sin, cos, tan,
/// exp, ln, sqrt, abs, min, max, ..., and c ? a : b).
/// Not for several threads at once.
/// @param what    what messages call it
/// @param origin  added to X: formulas are in the site's coordinates
/// @throws Error ("scenario") for what is no formula, naming it and the place in it. The field itself throws Error
/// where
///         its value is not finite.
Field compile_field(const std::string& what, const std::vector<std::string>& formulas, const Vec3& origin);

/// Why `formula` is none, or empty.
std::string mistake_in_formula(const std::string& formula);

}  // namespace scarp
