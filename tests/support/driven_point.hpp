// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/motion.hpp"

namespace scarp::test {

/// A point that is driven from one F to the next, as the solver does it.
template <class M>
struct DrivenPoint {
  explicit DrivenPoint(const M& parameters) : law(parameters) {}
  Sym6 move(const Mat3& next) {
    const Sym6 sigma = law.stress(make_motion(F, next), history);
    F = next;
    return sigma;
  }
  typename M::Law law;
  PointHistory history;
  Mat3 F = kIdentity;
};

}  // namespace scarp::test
