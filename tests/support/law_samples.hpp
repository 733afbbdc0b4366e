// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Admissible parameters for each law: the one line that a new law adds to be held against the contract.
#pragma once

#include <vector>

#include "solver/materials/material.hpp"

namespace scarp::test {

template <class M>
std::vector<M> law_samples();

/// The modulus of compression waves at rest, Pa: what stresses and energies are measured by.
template <class M>
double stiffness(const M& m) {
  return m.density * m.wave_speed() * m.wave_speed();
}

template <>
inline std::vector<LinearElastic> law_samples() {
  return {{{1000, 1e6, 0.3}}, {{1000, 1e6, -0.2}}};
}
template <>
inline std::vector<NeoHookean> law_samples() {
  return {{{1000, 1e6, 0.3}}, {{2000, 70e6, 0.0}}, {{1000, 1e6, 0.45}}};
}
template <>
inline std::vector<Hencky> law_samples() {
  return {{{1000, 1e6, 0.3}}, {{2000, 70e6, 0.0}}, {{1000, 1e6, 0.45}}, {{1000, 1e6, -0.2}}};
}
/// The last is too strong to yield: for what the contract says of the elastic state.
template <>
inline std::vector<VonMises> law_samples() {
  return {{{1900, 20e6, 0.3}, 20e3},
          {{7850, 200e6, 0.3}, 1e6, 20e6},
          {{1900, 20e6, 0.45}, 10e3, 0, 50e3, 0.01},
          {{1900, 20e6, 0.2}, 10e3, 1e6, 20e3, 1e-5},
          {{1000, 1e6, 0.3}, 1e6}};
}
template <>
inline std::vector<DruckerPrager> law_samples() {
  return {{{1900, 20e6, 0.3}, 10e3, 28, 0},
          {{1900, 20e6, 0.3}, 0, 33, 10},
          {{1900, 20e6, 0.2}, 5e3, 20, 20, 2e3, ConeMatch::plane_strain_associated},
          {{1900, 20e6, 0.3}, 20e3, 35, 5, 0.0, ConeMatch::inner},
          {{1900, 20e6, 0.3}, 20e3, 35, 35, 10e3, ConeMatch::outer},
          {{1900, 20e6, 0.4}, 50e3, 0, 0}};
}
/// With a cut-off in tension below the apex, at zero and without an apex; with softening of one strength or all, slow
/// or so fast that a step falls to the residual strength. Residual surfaces lie within the first ones.
template <>
inline std::vector<MohrCoulomb> law_samples() {
  std::vector<MohrCoulomb> samples{{{1900, 20e6, 0.3}, 10e3, 28, 0},         {{1900, 20e6, 0.3}, 0, 33, 10},
                                   {{1900, 20e6, 0.2}, 5e3, 20, 20},         {{1900, 20e6, 0.4}, 50e3, 0, 0},
                                   {{1900, 20e6, 0.3}, 10e3, 28, 0, 5e3},    {{1900, 20e6, 0.2}, 20e3, 35, 10, 0.0},
                                   {{1900, 20e6, -0.1}, 20e3, 30, 30, 10e3}, {{1900, 20e6, 0.4}, 50e3, 0, 0, 30e3}};
  MohrCoulomb sensitive{{1900, 20e6, 0.3}, 10e3, 30, 5, 4e3};
  sensitive.residual_cohesion = 1e3;
  sensitive.softening_strain = 0.1;
  samples.push_back(sensitive);
  sensitive.residual_friction_angle = 18;
  sensitive.residual_dilatancy_angle = 0;
  sensitive.softening = Softening::exponential;
  samples.push_back(sensitive);
  sensitive.tension_strength.reset();
  sensitive.softening_strain = 1e-5;
  samples.push_back(sensitive);
  sensitive.residual_cohesion = 0;
  sensitive.softening = Softening::linear;
  sensitive.softening_strain = 2e-3;
  samples.push_back(sensitive);
  return samples;
}
template <>
inline std::vector<Water> law_samples() {
  return {{.density = 1000, .sound_speed = 30},
          {.density = 900, .sound_speed = 30, .viscosity = 2, .exponent = 7, .tension = true},
          {.density = 1000, .sound_speed = 20, .viscosity = 0.001, .exponent = 1.5}};
}
/// The last two are too rough to flow in most states: for what the contract says of the elastic state.
template <>
inline std::vector<Granular> law_samples() {
  return {{{1500, 1e7, 0.3}, 0.38, 0.64, 0.279, 1e-3, 2500},
          {{1600, 20e6, 0.2}, 0.6, 0.6, 0.3, 0.01, 2650},
          {{1500, 1e7, 0.45}, 3, 4, 0.279, 1e-3, 2500},
          {{1500, 1e6, 0.4}, 4, 4, 0.279, 1e-3, 2500}};
}
/// Normally consolidated; lightly and heavily overconsolidated; the last two hardly yield.
template <>
inline std::vector<CamClay> law_samples() {
  CamClay m{.density = 1700, .shear_modulus = 5e6, .kappa = 0.05, .lambda = 0.2, .void_ratio = 1};
  m.initial_pressure = 100e3;
  m.critical_stress_ratio = 1.2;
  std::vector<CamClay> samples{m};
  m.friction_angle = 23;
  m.critical_stress_ratio.reset();
  m.overconsolidation_ratio = 1.5;
  samples.push_back(m);
  m.overconsolidation_ratio = 20;
  m.shear_modulus = 2e6;
  samples.push_back(m);
  m.overconsolidation_ratio.reset();
  m.preconsolidation = 100e6;
  samples.push_back(m);
  m.kappa = 0.2;
  m.lambda = 0.6;
  samples.push_back(m);
  return samples;
}

}  // namespace scarp::test
