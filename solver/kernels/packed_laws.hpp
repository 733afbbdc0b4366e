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
  const Deformation<D>* d;
  double* at;  ///< [field][lane]

  SCARP_INLINE void begin(const Deformation<D>& deformation, double* memory) {
    d = &deformation;
    at = memory;
  }
  SCARP_INLINE Symmetric<D> elastic() const {
    Symmetric<D> c;
    for (int i = 0; i < n; ++i) c.a[i] = load(at + i * kSegment);
    return push_forward<D>(d->F, c);
  }
  SCARP_INLINE Pack plastic_strain() const { return load(at + n * kSegment); }

  /// In the lanes of `where`, b_e, and what is added to strain and work.
  SCARP_INLINE void remember(const Symmetric<D>& b_e, Mask where, Pack strain, Pack work) {
    const Symmetric<D> c = pull_back<D>(*d, b_e);
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

  SCARP_INLINE void begin(const Deformation<D>& d, double*) { b_e = left_product<D>(d.F); }
  SCARP_INLINE const Symmetric<D>& elastic() const { return b_e; }
  SCARP_INLINE Pack plastic_strain() const { return strain; }
  SCARP_INLINE void remember(const Symmetric<D>& b, Mask where, Pack more_strain, Pack more_work) {
    for (int i = 0; i < Symmetric<D>::n; ++i) b_e.a[i] = choose(where, b.a[i], b_e.a[i]);
    strain += choose(where, more_strain, Pack{});
    work += choose(where, more_work, Pack{});
  }
};

/// Points whose stresses a law finds together: each of its stages goes over all of them before the next begins. A
/// return map is one long chain for a point, longer than the processor looks ahead; a stage is short enough that it
/// works on several points at once.
template <int D, class History, int most>
struct Points {
  int count = most;
  History history[most];
  Pack J[most];
  Symmetric<D> A[most];  ///< b_e - I; then what the law makes of it
  Symmetric<D> tau[most];
  int flow_count = 0;
  int flowing[most];  ///< points with a lane that flows
  Mask flows[most];
  Pack strain[most], work[most];  ///< what flow adds to the equivalent plastic strain and to the plastic work

  template <class F>
  SCARP_INLINE void each(F&& f) {
#pragma GCC unroll 1
    for (int i = 0; i < (most == 1 ? 1 : count); ++i) f(i);
  }
  /// The same of points in which something flows.
  template <class F>
  SCARP_INLINE void each_flowing(F&& f) {
#pragma GCC unroll 1
    for (int n = 0; n < (most == 1 ? flow_count > 0 : flow_count); ++n) f(most == 1 ? 0 : flowing[n]);
  }
  SCARP_INLINE void note_flow(int i, Mask lanes, Pack more_strain, Pack more_work) {
    flows[i] = lanes;
    strain[i] = more_strain;
    work[i] = more_work;
    flowing[flow_count] = i;
    flow_count += any(lanes);
  }
  /// Where the square of the strain was noted.
  SCARP_INLINE void take_roots() {
    each_flowing([&](int i) __attribute__((always_inline)) { strain[i] *= inverse_root(strain[i]); });
  }
  /// With A = b_e - I as it is after flow.
  SCARP_INLINE void remember() {
    each_flowing([&](int i) __attribute__((always_inline)) {
      history[i].remember(plus_unit<D>(A[i]), flows[i], strain[i], work[i]);
    });
  }

  /// Whether some lane of some point has it.
  template <class F>
  SCARP_INLINE bool some(F&& f) {
    Mask found{};
    each([&](int i) __attribute__((always_inline)) { found |= f(i); });
    return any(found);
  }
};

/// J sigma of one point.
template <int D, class Law, class History>
SCARP_INLINE Symmetric<D> kirchhoff(const Law& law, History& history, Pack J) {
  Points<D, History, 1> point;
  point.history[0] = history;
  point.J[0] = J;
  point.A[0] = less_unit<D>(history.elastic());
  law.stresses(point);
  history = point.history[0];
  return point.tau[0];
}

/// Logarithmic strains in the place of A.
template <int D, class History, int most>
SCARP_INLINE void half_logs(Points<D, History, most>& points) {
  Pack largest{};
  points.each([&](int i) __attribute__((always_inline)) { largest = larger(largest, square_norm<D>(points.A[i])); });
  const Reach reach = reach_of(largest, kHalfLogNear.reach, kHalfLogFar.reach);
  if (reach == Reach::near)
    points.each([&](int i) __attribute__((always_inline)) { points.A[i] = half_log<D, Reach::near>(points.A[i]); });
  else if (reach == Reach::far)
    points.each([&](int i) __attribute__((always_inline)) { points.A[i] = half_log<D, Reach::far>(points.A[i]); });
  else
    points.each([&](int i) __attribute__((always_inline)) { points.A[i] = half_log<D, Reach::all>(points.A[i]); });
}

/// exp(2 A) - I in the place of A where something flows.
template <int D, class History, int most>
SCARP_INLINE void exp_twices(Points<D, History, most>& points) {
  Pack largest{};
  points.each_flowing([&](int i)
                          __attribute__((always_inline)) { largest = larger(largest, square_norm<D>(points.A[i])); });
  const Reach reach = reach_of(largest, kExpTwiceNear.reach, kExpTwiceFar.reach);
  if (reach == Reach::near)
    points.each_flowing([&](int i)
                            __attribute__((always_inline)) { points.A[i] = exp_twice<D, Reach::near>(points.A[i]); });
  else if (reach == Reach::far)
    points.each_flowing([&](int i)
                            __attribute__((always_inline)) { points.A[i] = exp_twice<D, Reach::far>(points.A[i]); });
  else
    points.each_flowing([&](int i)
                            __attribute__((always_inline)) { points.A[i] = exp_twice<D, Reach::all>(points.A[i]); });
}

/// Simo and Pister's neo-Hookean solid, see solver/materials/neo_hookean.hpp.
struct NeoHookean {
  template <int D>
  using Remembered = CurrentHistory<D>;
  static constexpr int together = 1;  ///< so short that points are best taken one by one, in a loop unrolled
  template <int D>
  static constexpr int fields = 0;
  Pack mu, lambda, per_density;

  explicit NeoHookean(const double* p) : mu(all(p[0])), lambda(all(p[1])), per_density(all(p[2])) {}

  template <int D>
  SCARP_INLINE void stress(const Deformation<D>& d, Pack (&P)[9]) const {
    const Pack factor = (lambda * log_near_one(d.J) - mu) * d.per_J;
    for_entries<D>([&](int i) { P[i] = mu * d.F[i] + factor * d.cofactor[i]; });
  }
  template <int D, class History>
  SCARP_INLINE void stresses(Points<D, History, 1>& point) const {
    point.tau[0] = scaled<D>(point.A[0], mu, lambda * log_near_one(point.J[0]));
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
  template <int D>
  using Remembered = CurrentHistory<D>;
  static constexpr int together = 8;
  template <int D>
  static constexpr int fields = 0;
  Pack mu, lambda, per_density;

  explicit Hencky(const double* p) : mu(all(p[0])), lambda(all(p[1])), per_density(all(p[2])) {}

  template <int D, class History, int most>
  SCARP_INLINE void stresses(Points<D, History, most>& points) const {
    half_logs(points);
    points.each([&](int i) __attribute__((always_inline)) {
      points.tau[i] = scaled<D>(points.A[i], 2.0 * mu, lambda * trace<D>(points.A[i]));
    });
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
  template <int D>
  using Remembered = ReferenceHistory<D>;
  static constexpr int together = 8;
  template <int D>
  static constexpr int fields = Symmetric<D>::n + 2;
  Pack G, K, per_G, per_K, per_density;

  explicit Plastic(const double* p)
      : G(all(p[0])), K(all(p[1])), per_G(all(1 / p[0])), per_K(all(1 / p[1])), per_density(all(p[2])) {}

  template <int D, class History>
  SCARP_INLINE Pack speed_squared(const Stretch& s, const History& history) const {
    const Pack strain = square_root(distance_from_unit_squared<D>(history.elastic()));
    return (K + (4.0 / 3) * G) * (1.0 + strain) * s.per_least_squared() * per_density;
  }

  template <int D>
  SCARP_INLINE Pack energy(const Deformation<D>& d, double* history) const {
    return hencky_energy<D>(ReferenceHistory<D>{&d, history}.elastic(), G, K - (2.0 / 3) * G);
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

  template <int D, class History, int most>
  SCARP_INLINE void stresses(Points<D, History, most>& points) const {
    half_logs(points);
    points.each([&](int i) __attribute__((always_inline)) { map(points, i); });
    exp_twices(points);
    points.remember();
  }

  template <int D, class History, int most>
  SCARP_INLINE void map(Points<D, History, most>& points, int i) const {
    const Pack J = points.J[i], volume = trace<D>(points.A[i]), third = volume * (1.0 / 3);
    const Symmetric<D> dev = scaled<D>(points.A[i], all(1.0), -third);
    const Pack square = 1.5 * square_norm<D>(dev), per_root = inverse_root(square);
    const Pack trial = 2.0 * G * (square * per_root);
    const Pack strength = J * (yield + modulus * points.history[i].plastic_strain());
    const Mask flows = trial > strength;
    const Pack g = larger(Pack{}, (trial - strength) / (3.0 * G + J * modulus));
    const Pack kept = choose(flows, 1.0 - 1.5 * g * per_root, all(1.0));
    points.tau[i] = scaled<D>(dev, 2.0 * G * kept, K * volume);
    points.A[i] = scaled<D>(dev, kept, third);
    points.note_flow(i, flows, g, (trial - 3.0 * G * g) * g);
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

  template <int D, class History, int most>
  SCARP_INLINE void stresses(Points<D, History, most>& points) const {
    half_logs(points);
    points.each([&](int i) __attribute__((always_inline)) { map(points, i); });
    points.take_roots();
    exp_twices(points);
    points.remember();
  }

  template <int D, class History, int most_points>
  SCARP_INLINE void map(Points<D, History, most_points>& points, int i) const {
    const Pack J = points.J[i], volume = trace<D>(points.A[i]);
    const Symmetric<D> dev = scaled<D>(points.A[i], all(1.0), volume * (-1.0 / 3));
    const Pack square = 2.0 * square_norm<D>(dev), per_root = inverse_root(square);
    const Pack trial = G * (square * per_root), trial_p = K * volume;
    const Pack strength = k * J, most = cap * J;
    const Pack f = trial + q * trial_p - strength;
    const Mask flows = (f > 0.0) | (trial_p > most);
    const Pack gamma = larger(Pack{}, f * per_stiffness);
    const Pack along = trial_p - K * q_flow * gamma;
    const Mask cone = along <= most;
    const Pack on_circle = smaller(trial, larger(Pack{}, strength - q * most));
    const Pack radius = choose(flows, choose(cone, trial - G * gamma, on_circle), trial);
    const Pack p = choose(flows, choose(cone, along, most), trial_p);
    const Pack kept = choose(flows, radius * (per_G * per_root), all(1.0));
    const Pack flow = volume - p * per_K, shear = (trial - radius) * per_G;
    points.tau[i] = scaled<D>(dev, 2.0 * G * kept, p);
    points.A[i] = scaled<D>(dev, kept, (volume - flow) * (1.0 / 3));
    points.note_flow(i, flows, shear * shear * (1.0 / 3) + (2.0 / 9) * flow * flow, radius * shear + p * flow);
  }
};

/// See solver/materials/mohr_coulomb.hpp and coulomb_surface.hpp; without softening.
struct MohrCoulomb : Plastic {
  Pack c_cos, sin_phi, sin_psi, tension, fall, middle, rise, a, per_a, b_right, b_left, per_right, per_left;
  Pack per_cone, per_ball, per_sine, per_cosine;
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
    per_a = 1.0 / a;
    per_right = 1.0 / (a * a - b_right * b_right);
    per_left = 1.0 / (a * a - b_left * b_left);
    per_cone = all(1.4142135623730951 / (G0 * __builtin_sqrt(1 + sf * sf / 3)));
    per_ball = all(1.2247448713915890 / G0);
    has_apex = sf > 0;
    per_sine = all(has_apex ? 0.5 / sf : 0);
    per_cosine = all(1 / (1 - sf));
    has_cut_off = p[6] < 1e300;
    stiff = K0 + 4 * G0 / 3;
    across = K0 - 2 * G0 / 3;
    share = across / stiff;
    per_both = 1 / (stiff + across);
    per_determinant = 1 / ((1 - sf) * (1 - sp) * (stiff - across) * (stiff + across));
    coupling = (1 + sf) * stiff - (1 - sf) * across;
  }

  SCARP_INLINE Pack plane(Pack s1, Pack s3, Pack strength) const { return (s1 - s3) + (s1 + s3) * sin_phi - strength; }

  template <int D, class History, int most>
  SCARP_INLINE void stresses(Points<D, History, most>& points) const {
    const Pack lambda = K - (2.0 / 3) * G;
    const bool may = points.some([&](int i) __attribute__((always_inline)) {
      return may_flow<D>(points.A[i], 2.0 * c_cos * points.J[i], tension * points.J[i]);
    });
    if (!may) {
      half_logs(points);
      points.each([&](int i) __attribute__((always_inline)) {
        points.tau[i] = scaled<D>(points.A[i], 2.0 * G, lambda * trace<D>(points.A[i]));
      });
      return;
    }
    Spectrum<D> spectra[most];
    Pack largest{};
    points.each([&](int i) __attribute__((always_inline)) {
      spectra[i].begin(points.A[i]);
      largest = larger(largest, square_norm<D>(points.A[i]));
    });
    points.each([&](int i) __attribute__((always_inline)) { spectra[i].isolate(); });
    points.each([&](int i) __attribute__((always_inline)) { spectra[i].part(); });
    const Reach reach = reach_of(largest, kHalfLogNear.reach, kHalfLogFar.reach);
    points.each([&](int i) __attribute__((always_inline)) { half_log(reach, spectra[i].value); });
    Pack stress[most][3];
    points.each([&](int i) __attribute__((always_inline)) { map(points, i, spectra[i].value, stress[i]); });
    points.each([&](int i) __attribute__((always_inline)) { points.tau[i] = spectra[i].compose(stress[i]); });
    points.take_roots();
    points.each_flowing([&](int i) __attribute__((always_inline)) {
      exp_twice(spectra[i].value);
      points.A[i] = spectra[i].compose(spectra[i].value);
    });
    points.remember();
  }

  /// Principal stresses of principal logarithmic strains, which become the elastic ones.
  template <int D, class History, int most>
  SCARP_INLINE void map(Points<D, History, most>& points, int i, Pack (&e)[3], Pack (&s)[3]) const {
    const Pack strength = 2.0 * c_cos * points.J[i], limit = tension * points.J[i];
    const Pack pressure = (K - (2.0 / 3) * G) * (e[0] + e[1] + e[2]);
    for (int k = 0; k < 3; ++k) s[k] = 2.0 * G * e[k] + pressure;
    const Mask flows = (plane(s[0], s[2], strength) > 0.0) | (s[0] > limit);
    return_map(s, strength, limit);
    const Pack mean = (s[0] + s[1] + s[2]) * (1.0 / 3), third = mean * per_K * (1.0 / 3);
    Pack square{}, work{};
    for (int k = 0; k < 3; ++k) {
      const Pack elastic = (s[k] - mean) * (0.5 * per_G) + third, plastic = e[k] - elastic;
      square += plastic * plastic;
      work += s[k] * plastic;
      e[k] = elastic;
    }
    points.note_flow(i, flows, (2.0 / 3) * square, work);
  }

  /// Whether a point of b = I + A may be beyond the surface, without its logarithm: 2 e = A + R has |R| <= |A|^2 / 2 /
  /// (1 - |A|) and tr R <= 0, and the surface holds the cone inscribed in its planes (that of associated plane strain)
  /// and s1 <= p + 2 sqrt(J2 / 3).
  template <int D>
  SCARP_INLINE Mask may_flow(const Symmetric<D>& A, Pack strength, Pack limit) const {
    constexpr double reach = 0.35, per = 0.5 / (1 - reach);
    const Pack volume = trace<D>(A), p = 0.5 * K * volume;
    const Symmetric<D> dev = scaled<D>(A, all(1.0), volume * (-1.0 / 3));
    const Pack square = square_norm<D>(dev), whole = square + volume * volume * (1.0 / 3), rest = per * whole;
    // Room for |dev A|, a rounding error less.
    const Pack room = (0.5 * strength - p * sin_phi) * per_cone - rest;
    Mask found = (room < 0.0) | (square > room * room * (1.0 - 1e-12)) | ~(whole < reach * reach);
    if (!has_cut_off) return found;
    const Pack least = (limit - p) * per_ball - rest;
    return found | (least < 0.0) | (square > least * least * (1.0 - 1e-12));
  }

  /// Lanes inside the surface come back as they are.
  SCARP_INLINE void return_map(Pack (&s)[3], Pack strength, Pack limit) const {
    const Pack t[3] = {s[0], s[1], s[2]};
    const Pack f = plane(t[0], t[2], strength);
    const Mask beyond = f > 0;
    const Pack gamma = larger(Pack{}, f) * per_a;
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
    const Pack per = choose(right, per_right, per_left);
    const Pack ga = (a * f - b * other) * per, gb = (a * other - b * f) * per;
    Pack e[3];
    e[0] = t[0] - fall * ga + choose(right, -fall, middle) * gb;
    e[1] = t[1] + middle * ga + choose(right, rise, -fall) * gb;
    e[2] = t[2] + rise * ga + choose(right, middle, rise) * gb;
    if (has_apex) {
      const Pack apex = strength * per_sine;
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
    const Pack low = smaller(limit, (limit * (1.0 + sin_phi) - strength) * per_cosine);
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
