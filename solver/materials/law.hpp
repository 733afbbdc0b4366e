// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contract of a law. Tension is positive; F = dx/dX, J = det F > 0; energies are per reference volume.
//
//   rest          stress(F = I, b_e = I) = rest_stress(), 0 unless the law states another; stored_energy = 0
//   objectivity   F -> Q F, b_e -> Q b_e Q^T gives sigma -> Q sigma Q^T, for every rotation Q
//   energy        where nothing dissipates, P = J sigma F^-T = d stored_energy / d F
//   dissipation   plastic_work and equivalent_plastic_strain never fall
//   admissible    where the law yields, yield_function(sigma, history) <= rounding in the limit of slow motion
//                 (motion.per_dt = 0); in fast motion a rate-dependent law may exceed it
//   wave speed    rho0 c^2 >= max of (m x N) : dP/dF : (m x N) over unit m, N: the bound of the time step on a
//                 grid in the reference configuration, for the current F and the elastic tangent. A law whose viscosity
//                 shortens the stable step further raises c to what bounds it, for the cell that it is prepared for
//
// tests/unit/materials/law_test.cpp and plastic_law_test.cpp hold every alternative of `Material` against it.
#pragma once

#include <concepts>
#include <string>
#include <variant>

#include "solver/materials/material.hpp"
#include "solver/materials/motion.hpp"
#include "solver/model/error.hpp"

namespace scarp {

/// `M` is the parameters as the scenario states them; `M::Law` the same, ready for the hot loop. A law that depends on
/// the size of the cell takes it as a second argument of its constructor.
template <class M>
concept MaterialLaw = std::constructible_from<typename M::Law, const M&> &&
    requires(const M& m, const typename M::Law& law, const Motion& motion, PointHistory& history,
             const PointHistory& read_only) {
  /// In the reference configuration, kg/m3.
  { m.density } -> std::convertible_to<double>;
  /// Speeds of compression and of shear waves in the reference configuration at rest, m/s; a fluid has no shear waves.
  { m.wave_speed() } -> std::same_as<double>;
  { m.shear_wave_speed() } -> std::same_as<double>;
  /// Whether `stress` reads and writes the history; if not, it is never loaded.
  { M::Law::has_history } -> std::convertible_to<bool>;
  /// Cauchy stress at motion.F, Pa; brings the history from F_old to F.
  { law.stress(motion, history) } -> std::same_as<Sym6>;
  /// Elastic energy, J per m3 of the reference configuration.
  { law.stored_energy(motion, read_only) } -> std::same_as<double>;
  /// c^2, (m/s)^2, in the reference configuration.
  { law.wave_speed_squared(motion, read_only) } -> std::same_as<double>;
};

template <class V>
struct PreparedOf;
template <class... M>
struct PreparedOf<std::variant<M...>> {
  static_assert((MaterialLaw<M> && ...), "every alternative of Material must meet the contract above");
  using type = std::variant<typename M::Law...>;
};

/// The laws of `Material`, ready for the hot loop, in the same order.
using PreparedLaw = typename PreparedOf<Material>::type;

/// @param cell  edge of the cells that the law is used in, m, for laws that soften over a length; 0: not known
inline PreparedLaw prepare(const Material& material, double cell = 0) {
  const auto law = [cell](const auto& m) -> PreparedLaw {
    using Law = typename std::decay_t<decltype(m)>::Law;
    if constexpr (std::constructible_from<Law, decltype(m), double>)
      return Law(m, cell);
    else
      return Law(m);
  };
  return std::visit(law, material);
}

/// Mass density in the reference configuration, kg/m3.
inline double density_of(const Material& material) {
  return std::visit([](const auto& m) { return m.density; }, material);
}

/// Cauchy stress of a point that has not moved, Pa.
inline Sym6 rest_stress(const Material& material) {
  return std::visit(
      [](const auto& m) -> Sym6 {
        if constexpr (requires { m.rest_stress(); }) return m.rest_stress();
        return {0, 0, 0, 0, 0, 0};
      },
      material);
}

/// What the schema's ranges per key cannot say, and the ranges themselves for models that come from a file.
/// @param name  the material's name in the scenario, for the message
/// @throws Error ("materials"), e.g. where dilatancy_angle > friction_angle (the flow rule would create energy).
void validate(const Material& material, const std::string& name, const SourceLocation& where = {});

}  // namespace scarp
