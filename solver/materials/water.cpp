// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/water.hpp"

#include "solver/materials/rate_of_deformation.hpp"

namespace scarp {

Sym6 Water::Law::stress(const Motion& motion, PointHistory& history) const {
  const double J = motion.J;
  const double p = tension_ || J < 1 ? modulus_ * (std::pow(J, -exponent_) - 1) : 0;
  Sym6 sigma{-p, -p, -p, 0, 0, 0};
  if (viscosity_ == 0 || motion.per_dt == 0) return sigma;
  const Sym6 D = deviatoric_rate(motion);
  for (int i = 0; i < 6; ++i) sigma[i] += 2 * viscosity_ * D[i];
  const double square = D[0] * D[0] + D[1] * D[1] + D[2] * D[2] + 2 * (D[3] * D[3] + D[4] * D[4] + D[5] * D[5]);
  history.plastic_work += J * 2 * viscosity_ * square / motion.per_dt;
  return sigma;
}

double Water::Law::stored_energy(const Motion& motion, const PointHistory&) const {
  const double J = motion.J;
  if (!tension_ && J > 1) return 0;
  return modulus_ * ((std::pow(J, 1 - exponent_) - 1) / (exponent_ - 1) + (J - 1));
}

/// The velocity that a viscous force lags behind is half a step old: waves of frequency omega and damping ratio zeta
/// stay bounded for dt <= 2 / omega (sqrt(1 + zeta^2) - zeta). The shortest wave of a cell h has omega = 2 c / h and
/// zeta = 4/3 nu / (c h), which is a time step of h over c (sqrt(1 + zeta^2) + zeta).
/// @param stretch  of the viscosity from the current configuration to the one that c belongs to
double Water::Law::limited(double c2, double stretch) const {
  const double viscous = longitudinal_ * stretch;
  const double c = std::sqrt(c2 + viscous * viscous) + viscous;
  return longitudinal_ > 0 ? c * c : c2;
}

}  // namespace scarp
