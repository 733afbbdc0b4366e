// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The laws of solver/materials on packs of points, without branches but those that all lanes take: same formulas, same
// return maps, to rounding. Each law's scalar form is its oracle (tests/unit/kernels).
//
// A law gets the elastic left Cauchy-Green tensor b_e of a trial step and J from a History, which also takes what is
// remembered, and gives tau = J sigma. D = 2 is plane strain, where entries 2, 5, 6, 7 of F are zero, F33 = 1, and
// entries across the plane are not asked for. Parameters are read once per segment or cell.
#pragma once

#include "solver/kernels/nodal.hpp"
#include "solver/kernels/packed_tensor.hpp"

namespace SCARP_KERNELS {
namespace {

using scarp::kernels::kSegment;

/// Of total-Lagrangian bodies, whose F is all that moves: C_p^-1 in memory, with b_e = F C_p^-1 F^T.
template <int D>
struct ReferenceHistory {
  static constexpr int n = Symmetric<D>::n;
  const Deformation<D>& d;
  double* at;  ///< [field][lane]

  SCARP_INLINE Symmetric<D> elastic() const {
    Symmetric<D> c;
    for (int i = 0; i < n; ++i) c.a[i] = load(at + i * kSegment);
    return push_forward<D>(d.F, c);
  }
  SCARP_INLINE Pack plastic_strain() const { return load(at + n * kSegment); }

  /// In the lanes of `where`, b_e, and what is added to strain and work.
  SCARP_INLINE void remember(const Symmetric<D>& b_e, Mask where, Pack strain, Pack work) {
    const Symmetric<D> c = pull_back<D>(d, b_e);
    for (int i = 0; i < n; ++i) store(at + i * kSegment, choose(where, c.a[i], load(at + i * kSegment)));
    double *a = at + n * kSegment, *w = a + kSegment;
    store(a, load(a) + choose(where, strain, Pack{}));
    store(w, load(w) + choose(where, work, Pack{}));
  }
};

/// The same where b_e itself is at hand, or for a law without a history F F^T.
template <int D>
struct CurrentHistory {
  Symmetric<D> b_e;
  Pack strain, work;  ///< equivalent plastic strain, plastic work

  SCARP_INLINE const Symmetric<D>& elastic() const { return b_e; }
  SCARP_INLINE Pack plastic_strain() const { return strain; }
  SCARP_INLINE void remember(const Symmetric<D>& b, Mask where, Pack more_strain, Pack more_work) {
    for (int i = 0; i < Symmetric<D>::n; ++i) b_e.a[i] = choose(where, b.a[i], b_e.a[i]);
    strain += choose(where, more_strain, Pack{});
    work += choose(where, more_work, Pack{});
  }
};

/// P by way of tau; a law may do better.
template <int D, class Law>
SCARP_INLINE void stress_of(const Law& law, const Deformation<D>& d, double* history, Pack (&P)[9]) {
  if constexpr (requires { law.template stress<D>(d, P); }) {
    law.template stress<D>(d, P);
  } else if constexpr (Law::template fields<D> == 0) {
    CurrentHistory<D> none{left_product<D>(d.F), Pack{}, Pack{}};
    first_piola<D>(law.template kirchhoff<D>(none, d.J), d, P);
  } else {
    ReferenceHistory<D> memory{d, history};
    first_piola<D>(law.template kirchhoff<D>(memory, d.J), d, P);
  }
}

/// Simo and Pister's neo-Hookean solid, see solver/materials/neo_hookean.hpp.
struct NeoHookean {
  static constexpr bool light = true;  ///< few enough registers that the loop over points is best unrolled
  template <int D>
  static constexpr int fields = 0;
  Pack mu, lambda, per_density;

  explicit NeoHookean(const double* p) : mu(all(p[0])), lambda(all(p[1])), per_density(all(p[2])) {}

  template <int D>
  SCARP_INLINE void stress(const Deformation<D>& d, Pack (&P)[9]) const {
    const Pack factor = (lambda * log_near_one(d.J) - mu) * d.per_J;
    for_entries<D>([&](int i) { P[i] = mu * d.F[i] + factor * d.cofactor[i]; });
  }
  template <int D>
  SCARP_INLINE Symmetric<D> kirchhoff(CurrentHistory<D>& history, Pack J) const {
    return scaled<D>(history.b_e, mu, lambda * log_near_one(J) - mu);
  }

  template <int D, class History>
  SCARP_INLINE Pack speed_squared(const Stretch& s, const History&) const {
    const Pack along = mu + choose(lambda > 0.0, lambda * s.per_J, -lambda * s.J);
    return (mu + along * s.per_least_squared()) * per_density;
  }

  template <int D>
  SCARP_INLINE Pack energy(const Deformation<D>& d, const double*) const {
    const Pack log_J = log_near_one(d.J);
    return 0.5 * mu * (square_norm<D>(d.F) - 3.0 - 2.0 * log_J) + 0.5 * lambda * log_J * log_J;
  }
  template <int D>
  static SCARP_INLINE Pack plastic_work(const double*) {
    return Pack{};
  }
};

/// Hencky's solid, see solver/materials/hencky.hpp.
struct Hencky {
  static constexpr bool light = false;
  template <int D>
  static constexpr int fields = 0;
  Pack mu, lambda, per_density;

  explicit Hencky(const double* p) : mu(all(p[0])), lambda(all(p[1])), per_density(all(p[2])) {}

  template <int D>
  SCARP_INLINE Symmetric<D> kirchhoff(CurrentHistory<D>& history, Pack) const {
    const Symmetric<D> e = half_log<D>(history.b_e);
    return scaled<D>(e, 2.0 * mu, lambda * trace<D>(e));
  }

  template <int D, class History>
  SCARP_INLINE Pack speed_squared(const Stretch& s, const History&) const {
    const Pack shrunk = s.per_least_squared();
    const Pack stretched = s.square - 2.0 / shrunk;
    const Pack spread = 0.5 * natural_log(shrunk * larger(shrunk, stretched));
    const Pack pressed = larger(Pack{}, choose(lambda > 0.0, lambda * (s.per_J - 1.0), lambda * (1.0 - s.J)));
    return (mu * (2.0 + spread) + larger(Pack{}, lambda) + pressed) * shrunk * per_density;
  }

  template <int D>
  SCARP_INLINE Pack energy(const Deformation<D>& d, const double*) const {
    return hencky_energy<D>(left_product<D>(d.F), mu, lambda);
  }
  template <int D>
  static SCARP_INLINE Pack plastic_work(const double*) {
    return Pack{};
  }
};

/// What the plastic laws share: C_p^-1 in the history, b_e = F C_p^-1 F^T, Hencky's law in it.
struct Plastic {
  static constexpr bool light = false;
  template <int D>
  static constexpr int fields = Symmetric<D>::n + 2;
  Pack G, K, per_2G, per_3K, per_density;

  explicit Plastic(const double* p)
      : G(all(p[0])), K(all(p[1])), per_2G(all(0.5 / p[0])), per_3K(all(1 / (3 * p[1]))), per_density(all(p[2])) {}

  template <int D, class History>
  SCARP_INLINE Pack speed_squared(const Stretch& s, const History& history) const {
    const Pack strain = square_root(distance_from_unit_squared<D>(history.elastic()));
    return (K + (4.0 / 3) * G) * (1.0 + strain) * s.per_least_squared() * per_density;
  }

  template <int D>
  SCARP_INLINE Pack energy(const Deformation<D>& d, double* history) const {
    return hencky_energy<D>(ReferenceHistory<D>{d, history}.elastic(), G, K - (2.0 / 3) * G);
  }

  /// Plastic work per reference volume.
  template <int D>
  static SCARP_INLINE Pack plastic_work(const double* history) {
    return load(history + (Symmetric<D>::n + 1) * kSegment);
  }
};

/// See solver/materials/von_mises.hpp; without saturation.
struct VonMises : Plastic {
  Pack yield, modulus;

  explicit VonMises(const double* p) : Plastic(p), yield(all(p[3])), modulus(all(p[4])) {}

  template <int D, class History>
  SCARP_INLINE Symmetric<D> kirchhoff(History& history, Pack J) const {
    const Symmetric<D> e = half_log<D>(history.elastic());
    const Pack volume = trace<D>(e), third = volume * (1.0 / 3);
    const Symmetric<D> dev = scaled<D>(e, all(1.0), -third);
    const Pack trial = 2.0 * G * square_root(1.5 * square_norm<D>(dev));
    const Pack strength = J * (yield + modulus * history.plastic_strain());
    const Mask flows = trial > strength;
    Pack kept = all(1.0);
    if (any(flows)) {
      const Pack g = larger(Pack{}, (trial - strength) / (3.0 * G + J * modulus));
      kept = choose(flows, 1.0 - 3.0 * G * g / trial, all(1.0));
      history.remember(exp_twice<D>(scaled<D>(dev, kept, third)), flows, g, (trial - 3.0 * G * g) * g);
    }
    return scaled<D>(dev, 2.0 * G * kept, K * volume);
  }
};

/// See solver/materials/drucker_prager.hpp.
struct DruckerPrager : Plastic {
  Pack q, k, q_flow, cap, per_stiffness;

  explicit DruckerPrager(const double* p)
      : Plastic(p),
        q(all(p[3])),
        k(all(p[4])),
        q_flow(all(p[5])),
        cap(all(p[6])),
        per_stiffness(all(1 / (p[0] + p[1] * p[3] * p[5]))) {}

  template <int D, class History>
  SCARP_INLINE Symmetric<D> kirchhoff(History& history, Pack J) const {
    const Symmetric<D> e = half_log<D>(history.elastic());
    const Pack volume = trace<D>(e);
    const Symmetric<D> dev = scaled<D>(e, all(1.0), volume * (-1.0 / 3));
    const Pack trial = G * square_root(2.0 * square_norm<D>(dev));
    Pack p = K * volume;
    const Pack strength = k * J, most = cap * J;
    const Pack f = trial + q * p - strength;
    const Mask flows = (f > 0.0) | (p > most);
    Pack kept = all(1.0);
    if (any(flows)) {
      const Pack gamma = larger(Pack{}, f * per_stiffness);
      const Pack along = p - K * q_flow * gamma;
      const Mask cone = along <= most;
      const Pack on_circle = smaller(trial, larger(Pack{}, strength - q * most));
      const Pack radius = choose(flows, choose(cone, trial - G * gamma, on_circle), trial);
      p = choose(flows, choose(cone, along, most), p);
      kept = choose(trial > 0.0, radius / trial, Pack{});
      const Pack flow = volume - p / K, shear = (trial - radius) / G;
      history.remember(exp_twice<D>(scaled<D>(dev, kept, (volume - flow) * (1.0 / 3))), flows,
                       square_root(shear * shear * (1.0 / 3) + (2.0 / 9) * flow * flow), radius * shear + p * flow);
    }
    return scaled<D>(dev, 2.0 * G * kept, p);
  }
};

/// See solver/materials/mohr_coulomb.hpp and coulomb_surface.hpp; without softening.
struct MohrCoulomb : Plastic {
  Pack c_cos, sin_phi, sin_psi, tension, fall, middle, rise, a, b_right, b_left, inscribed;
  bool has_cut_off, has_apex;
  double share, per_both, per_determinant, coupling, stiff, across;

  explicit MohrCoulomb(const double* p) : Plastic(p) {
    const double G0 = p[0], K0 = p[1], sf = p[4], sp = p[5];
    c_cos = all(p[3]);
    sin_phi = all(sf);
    sin_psi = all(sp);
    tension = all(p[6]);
    fall = all(2 * G0 * (1 + sp / 3) + 2 * K0 * sp);
    middle = all((4 * G0 / 3 - 2 * K0) * sp);
    rise = all(2 * G0 * (1 - sp / 3) - 2 * K0 * sp);
    const double volumetric = 4 * K0 * sf * sp;
    a = all(4 * G0 * (1 + sf * sp / 3) + volumetric);
    b_right = all(2 * G0 * (1 + sf + sp - sf * sp / 3) + volumetric);
    b_left = all(2 * G0 * (1 - sf - sp - sf * sp / 3) + volumetric);
    inscribed = all(__builtin_sqrt(1 + sf * sf / 3));
    has_apex = sf > 0;
    has_cut_off = p[6] < 1e300;
    stiff = K0 + 4 * G0 / 3;
    across = K0 - 2 * G0 / 3;
    share = across / stiff;
    per_both = 1 / (stiff + across);
    per_determinant = 1 / ((1 - sf) * (1 - sp) * (stiff - across) * (stiff + across));
    coupling = (1 + sf) * stiff - (1 - sf) * across;
  }

  SCARP_INLINE Pack plane(Pack s1, Pack s3, Pack strength) const { return (s1 - s3) + (s1 + s3) * sin_phi - strength; }

  template <int D, class History>
  SCARP_INLINE Symmetric<D> kirchhoff(History& history, Pack J) const {
    const Symmetric<D> e = half_log<D>(history.elastic());
    const Pack volume = trace<D>(e), pressure = (K - (2.0 / 3) * G) * volume;
    Symmetric<D> tau = scaled<D>(e, 2.0 * G, pressure);
    const Pack strength = 2.0 * c_cos * J, limit = tension * J;
    if (any(may_flow<D>(e, volume, strength, limit))) {
      const Spectrum<D> spectrum(e);
      const Pack(&v)[3] = spectrum.value;
      Pack s[3];
      for (int k = 0; k < 3; ++k) s[k] = 2.0 * G * v[k] + pressure;
      const Mask flows = (plane(s[0], s[2], strength) > 0.0) | (s[0] > limit);
      return_map(s, strength, limit);
      const Pack mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
      Pack square{}, work{}, elastic[3];
      for (int k = 0; k < 3; ++k) {
        elastic[k] = (s[k] - mean) * per_2G + mean * per_3K;
        const Pack plastic = v[k] - elastic[k];
        square += plastic * plastic;
        work += s[k] * plastic;
      }
      if (any(flows)) {
        history.remember(exp_twice<D>(spectrum.compose(elastic)), flows, square_root((2.0 / 3) * square), work);
        const Symmetric<D> returned = spectrum.compose(s);
        for (int i = 0; i < Symmetric<D>::n; ++i) tau.a[i] = choose(flows, returned.a[i], tau.a[i]);
      }
    }
    return tau;
  }

  /// Whether a point may be beyond the surface, from invariants alone: the cone inscribed in the planes (that of
  /// associated plane strain), and s1 <= p + 2 sqrt(J2 / 3).
  template <int D>
  SCARP_INLINE Mask may_flow(const Symmetric<D>& e, Pack volume, Pack strength, Pack limit) const {
    const Pack radius =
        1.4142135623730951 * G * square_root(larger(Pack{}, square_norm<D>(e) - volume * volume * (1.0 / 3)));
    const Pack p = K * volume;
    const Mask planes = (radius * inscribed + p * sin_phi) * (1.0 + 1e-12) > 0.5 * strength;
    if (!has_cut_off) return planes;
    return planes | (p + 1.1547005383792517 * radius > limit);
  }

  /// Lanes inside the surface come back as they are.
  SCARP_INLINE void return_map(Pack (&s)[3], Pack strength, Pack limit) const {
    const Pack t[3] = {s[0], s[1], s[2]};
    const Pack f = plane(t[0], t[2], strength);
    const Mask beyond = f > 0;
    const Pack gamma = larger(Pack{}, f) / a;
    s[0] = t[0] - fall * gamma;
    s[1] = t[1] + middle * gamma;
    s[2] = t[2] + rise * gamma;
    const Mask disordered = beyond & ((s[0] < s[1]) | (s[1] < s[2]));
    if (any(disordered)) return_to_edges(s, t, f, strength, disordered);
    if (has_cut_off) {
      const Mask cut = s[0] > limit;
      if (any(cut)) return_to_cut_off(s, t, f, strength, limit, cut);
    }
  }

  SCARP_INLINE void return_to_edges(Pack (&s)[3], const Pack (&t)[3], Pack f, Pack strength, Mask where) const {
    const Mask right = ((1.0 - sin_psi) * t[0] - 2.0 * t[1] + (1.0 + sin_psi) * t[2]) > 0;
    const Pack b = choose(right, b_right, b_left);
    const Pack other = choose(right, plane(t[0], t[1], strength), plane(t[1], t[2], strength));
    const Pack per = 1.0 / (a * a - b * b);
    const Pack ga = (a * f - b * other) * per, gb = (a * other - b * f) * per;
    Pack e[3];
    e[0] = t[0] - fall * ga + choose(right, -fall, middle) * gb;
    e[1] = t[1] + middle * ga + choose(right, rise, -fall) * gb;
    e[2] = t[2] + rise * ga + choose(right, middle, rise) * gb;
    if (has_apex) {
      const Pack apex = 0.5 * strength / sin_phi;
      const Mask above = (e[0] + e[1] + e[2]) > 3.0 * apex;
      for (int k = 0; k < 3; ++k) e[k] = choose(above, apex, e[k]);
    }
    for (int k = 0; k < 3; ++k) s[k] = choose(where, e[k], s[k]);
  }

  SCARP_INLINE void return_to_cut_off(Pack (&s)[3], const Pack (&t)[3], Pack f, Pack strength, Pack limit,
                                      Mask where) const {
    const Pack beyond = t[0] - limit;
    const Mask two = (t[1] - share * beyond) > limit;
    const Pack multipliers = (beyond + t[1] - limit) * per_both;
    Pack cut1 = choose(two, limit, t[1] - share * beyond);
    Pack cut2 = choose(two, smaller(limit, t[2] - across * multipliers), t[2] - share * beyond);
    const Pack low = smaller(limit, (limit * (1.0 + sin_phi) - strength) / (1.0 - sin_phi));
    const Mask both = cut2 < low;
    const Pack on_plane = (stiff * f - coupling * beyond) * per_determinant;
    const Pack on_cut = (a * beyond - fall * f) * per_determinant;
    const Pack on_line = smaller(limit, larger(low, t[1] + middle * on_plane - across * on_cut));
    cut1 = choose(both, on_line, cut1);
    cut2 = choose(both, low, cut2);
    s[0] = choose(where, limit, s[0]);
    s[1] = choose(where, cut1, s[1]);
    s[2] = choose(where, cut2, s[2]);
  }
};

}  // namespace
}  // namespace SCARP_KERNELS
