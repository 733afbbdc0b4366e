// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/materials/law.hpp"

namespace scarp {

/// A state in which a law bears a stress without having flowed.
struct ElasticState {
  Mat3 F = kIdentity;    ///< of laws without a history, whose stress is in F; else the identity
  PointHistory history;  ///< of laws with one
};

/// The state of principal stresses along x, y and z, in Pa, tension positive; nothing where the law cannot bear them
/// elastically: they lie outside its yield surface, or it is a fluid. Newton's method in the principal logarithmic
/// strains on the law's own stress, so that it knows no law: a new one works without a line here.
std::optional<ElasticState> elastic_state(const PreparedLaw& law, const Vec3& stress);

}  // namespace scarp
