// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A specimen in a triaxial cell, one material point: axial strain is prescribed along x.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/driven_point.hpp"

namespace scarp::test {

inline double pressure_of(const Sym6& s) { return -(s[0] + s[1] + s[2]) / 3; }
/// sqrt(3 J2).
inline double deviator_of(const Sym6& s) {
  const double m = -pressure_of(s), x = s[0] - m, y = s[1] - m, z = s[2] - m;
  return std::sqrt(1.5 * (x * x + y * y + z * z + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])));
}

template <class M>
struct Triaxial : DrivenPoint<M> {
  using DrivenPoint<M>::DrivenPoint;

  /// Logarithmic axial compression at constant volume.
  Sym6 undrained(double axial) {
    const double side = std::exp(axial / 2);
    return this->move({std::exp(-axial), 0, 0, 0, side, 0, 0, 0, side});
  }

  /// The same at constant lateral pressure, by secants on the lateral stretch.
  Sym6 drained(double axial, double lateral_pressure) {
    const auto tried = [&](double side) {
      PointHistory copy = this->history;
      const Mat3 next{std::exp(-axial), 0, 0, 0, side, 0, 0, 0, side};
      return this->law.stress(make_motion(this->F, next), copy)[1] + lateral_pressure;
    };
    double a = this->F[4], b = a * (1 + 1e-6), fa = tried(a), fb = tried(b);
    for (int i = 0; i < 100 && std::abs(fb) > 1e-9 * lateral_pressure && fb != fa; ++i) {
      const double step = std::clamp((fa - fb) == 0 ? 0.0 : fb * (b - a) / (fa - fb), -1e-2, 1e-2);
      a = b;
      fa = fb;
      b += step;
      fb = tried(b);
    }
    return this->move({std::exp(-axial), 0, 0, 0, b, 0, 0, 0, b});
  }
};

}  // namespace scarp::test
