// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/elastic_state.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {
namespace {

template <class Law>
ElasticState state_of(const Vec3& e) {
  ElasticState state;
  for (int k = 0; k < 3; ++k) {
    if constexpr (Law::has_history)
      state.history.elastic_left_cauchy_green[k] = std::exp(2 * e[k]);
    else
      state.F[4 * k] = std::exp(e[k]);
  }
  return state;
}

/// Principal stresses; the state becomes what the law makes of it.
template <class Law>
Vec3 stress_of(const Law& law, ElasticState& state) {
  const Sym6 s = law.stress(make_motion(state.F, state.F), state.history);
  return {s[0], s[1], s[2]};
}

double largest(const Vec3& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

/// x of A x = b by Cramer's rule.
Vec3 solve(const Vec3 (&columns)[3], const Vec3& b) {
  const double det = dot(columns[0], cross(columns[1], columns[2]));
  return {dot(b, cross(columns[1], columns[2])) / det, dot(columns[0], cross(b, columns[2])) / det,
          dot(columns[0], cross(columns[1], b)) / det};
}

template <class Law>
std::optional<ElasticState> find(const Law& law, const Vec3& stress) {
  constexpr double kProbe = 1e-6, kAccuracy = 1e-10;
  Vec3 e{0, 0, 0};
  for (int iteration = 0; iteration < 30; ++iteration) {
    ElasticState state = state_of<Law>(e);
    const Vec3 rest = stress - stress_of(law, state);
    if (!is_finite(rest)) return std::nullopt;
    if (largest(rest) <= kAccuracy * largest(stress))
      return state.history.equivalent_plastic_strain == 0 ? std::optional(state) : std::nullopt;
    Vec3 columns[3];
    for (int k = 0; k < 3; ++k) {
      Vec3 forth = e, back = e;
      forth[k] += kProbe;
      back[k] -= kProbe;
      ElasticState a = state_of<Law>(forth), b = state_of<Law>(back);
      columns[k] = (0.5 / kProbe) * (stress_of(law, a) - stress_of(law, b));
    }
    const Vec3 step = solve(columns, rest);
    if (!(largest(step) < 1)) return std::nullopt;  // singular: no such stress
    e = e + step;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ElasticState> elastic_state(const PreparedLaw& law, const Vec3& stress) {
  return std::visit([&](const auto& prepared) { return find(prepared, stress); }, law);
}

}  // namespace scarp
