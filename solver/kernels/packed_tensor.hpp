// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tensors of packs: what the packed laws share. D = 2 is plane strain, whose entries across the plane are known and
// cost nothing.
#pragma once

#include "solver/kernels/vector_math.hpp"

namespace SCARP_KERNELS {
namespace {

/// f(i) for the entries of a row-major 3 x 3 matrix that lie in the plane (2D) or for all.
template <int D, class F>
SCARP_INLINE void for_entries(F&& f) {
  f(0);
  f(1);
  if constexpr (D == 3) f(2);
  f(3);
  f(4);
  if constexpr (D == 3) {
    f(5);
    f(6);
    f(7);
    f(8);
  }
}

/// A point's F with what all laws need of it.
template <int D>
struct Deformation {
  Pack F[9];
  Pack cofactor[9];
  Pack J, per_J;

  SCARP_INLINE void complete() {
    Pack(&c)[9] = cofactor;
    if constexpr (D == 2) {
      c[0] = F[4];
      c[1] = -F[3];
      c[3] = -F[1];
      c[4] = F[0];
      J = F[0] * F[4] - F[1] * F[3];
    } else {
      c[0] = F[4] * F[8] - F[5] * F[7];
      c[1] = F[5] * F[6] - F[3] * F[8];
      c[2] = F[3] * F[7] - F[4] * F[6];
      c[3] = F[2] * F[7] - F[1] * F[8];
      c[4] = F[0] * F[8] - F[2] * F[6];
      c[5] = F[1] * F[6] - F[0] * F[7];
      c[6] = F[1] * F[5] - F[2] * F[4];
      c[7] = F[2] * F[3] - F[0] * F[5];
      c[8] = F[0] * F[4] - F[1] * F[3];
      J = F[0] * c[0] + F[1] * c[1] + F[2] * c[2];
    }
    per_J = 1.0 / J;
  }
};

template <int D>
SCARP_INLINE Pack square_norm(const Pack (&F)[9]) {
  Pack s = all(D == 2 ? 1.0 : 0.0);
  for_entries<D>([&](int i) { s += F[i] * F[i]; });
  return s;
}

/// Of a deformation, what bounds wave speeds ask for; see solver/materials/motion.hpp.
struct Stretch {
  Pack square;     ///< |F|^2
  Pack cofactors;  ///< |cof F|^2
  Pack J, per_J;

  /// Upper bound of 1 / lambda_min^2.
  SCARP_INLINE Pack per_least_squared() const {
    const Pack per_J2 = per_J * per_J;
    const Pack trace = cofactors * per_J2, second = square * per_J2;
    return (trace + 2.0 * square_root(larger(Pack{}, trace * trace - 3.0 * second))) * (1.0 / 3);
  }
  /// Upper bound of lambda_max^2.
  SCARP_INLINE Pack largest_squared() const {
    return (square + 2.0 * square_root(larger(Pack{}, square * square - 3.0 * cofactors))) * (1.0 / 3);
  }
};

template <int D>
SCARP_INLINE Stretch stretch_of(const Deformation<D>& d) {
  Pack cofactors = D == 2 ? d.J * d.J : Pack{};
  for_entries<D>([&](int i) { cofactors += d.cofactor[i] * d.cofactor[i]; });
  return {square_norm<D>(d.F), cofactors, d.J, d.per_J};
}

/// xx, yy, zz, xy and, in 3D, yz, xz.
template <int D>
struct Symmetric {
  static constexpr int n = D == 2 ? 4 : 6;
  Pack a[n];
};

template <int D>
SCARP_INLINE Pack distance_from_unit_squared(const Symmetric<D>& s) {
  const Pack x = s.a[0] - 1.0, y = s.a[1] - 1.0, z = s.a[2] - 1.0;
  Pack off = s.a[3] * s.a[3];
  if constexpr (D == 3) off += s.a[4] * s.a[4] + s.a[5] * s.a[5];
  return x * x + y * y + z * z + 2.0 * off;
}

/// F F^T.
template <int D>
SCARP_INLINE Symmetric<D> left_product(const Pack (&F)[9]) {
  if constexpr (D == 2)
    return {{F[0] * F[0] + F[1] * F[1], F[3] * F[3] + F[4] * F[4], all(1.0), F[0] * F[3] + F[1] * F[4]}};
  else
    return {{F[0] * F[0] + F[1] * F[1] + F[2] * F[2], F[3] * F[3] + F[4] * F[4] + F[5] * F[5],
             F[6] * F[6] + F[7] * F[7] + F[8] * F[8], F[0] * F[3] + F[1] * F[4] + F[2] * F[5],
             F[3] * F[6] + F[4] * F[7] + F[5] * F[8], F[0] * F[6] + F[1] * F[7] + F[2] * F[8]}};
}

/// F s F^T.
template <int D>
SCARP_INLINE Symmetric<D> push_forward(const Pack (&F)[9], const Symmetric<D>& s) {
  const Pack(&a)[Symmetric<D>::n] = s.a;
  if constexpr (D == 2) {
    const Pack xx = F[0] * a[0] + F[1] * a[3], xy = F[0] * a[3] + F[1] * a[1];
    const Pack yx = F[3] * a[0] + F[4] * a[3], yy = F[3] * a[3] + F[4] * a[1];
    return {{xx * F[0] + xy * F[1], yx * F[3] + yy * F[4], a[2], xx * F[3] + xy * F[4]}};
  } else {
    Pack A[9];
    for (int i = 0; i < 3; ++i) {
      A[3 * i] = F[3 * i] * a[0] + F[3 * i + 1] * a[3] + F[3 * i + 2] * a[5];
      A[3 * i + 1] = F[3 * i] * a[3] + F[3 * i + 1] * a[1] + F[3 * i + 2] * a[4];
      A[3 * i + 2] = F[3 * i] * a[5] + F[3 * i + 1] * a[4] + F[3 * i + 2] * a[2];
    }
    return {{A[0] * F[0] + A[1] * F[1] + A[2] * F[2], A[3] * F[3] + A[4] * F[4] + A[5] * F[5],
             A[6] * F[6] + A[7] * F[7] + A[8] * F[8], A[0] * F[3] + A[1] * F[4] + A[2] * F[5],
             A[3] * F[6] + A[4] * F[7] + A[5] * F[8], A[0] * F[6] + A[1] * F[7] + A[2] * F[8]}};
  }
}

/// F^-1 s F^-T.
template <int D>
SCARP_INLINE Symmetric<D> pull_back(const Deformation<D>& d, const Symmetric<D>& s) {
  // F^-1 = cofactor^T / J.
  Pack inverse[9];
  for_entries<D>([&](int i) { inverse[i] = d.cofactor[i / 3 + 3 * (i % 3)] * d.per_J; });
  return push_forward<D>(inverse, s);
}

/// P = s cofactor / J for the Kirchhoff stress s.
template <int D>
SCARP_INLINE void first_piola(const Symmetric<D>& s, const Deformation<D>& d, Pack (&P)[9]) {
  const Pack(&a)[Symmetric<D>::n] = s.a;
  const Pack(&c)[9] = d.cofactor;
  if constexpr (D == 2) {
    const Pack xx = a[0] * d.per_J, yy = a[1] * d.per_J, xy = a[3] * d.per_J;
    P[0] = xx * c[0] + xy * c[3];
    P[1] = xx * c[1] + xy * c[4];
    P[3] = xy * c[0] + yy * c[3];
    P[4] = xy * c[1] + yy * c[4];
  } else {
    Pack t[6];
    for (int i = 0; i < 6; ++i) t[i] = a[i] * d.per_J;
    for (int j = 0; j < 3; ++j) {
      P[j] = t[0] * c[j] + t[3] * c[3 + j] + t[5] * c[6 + j];
      P[3 + j] = t[3] * c[j] + t[1] * c[3 + j] + t[4] * c[6 + j];
      P[6 + j] = t[5] * c[j] + t[4] * c[3 + j] + t[2] * c[6 + j];
    }
  }
}

/// A B of symmetric tensors that commute.
template <int D>
SCARP_INLINE Symmetric<D> product(const Symmetric<D>& A, const Symmetric<D>& B) {
  const Pack(&a)[Symmetric<D>::n] = A.a;
  const Pack(&b)[Symmetric<D>::n] = B.a;
  if constexpr (D == 2)
    return {{a[0] * b[0] + a[3] * b[3], a[3] * b[3] + a[1] * b[1], a[2] * b[2], a[0] * b[3] + a[3] * b[1]}};
  else
    return {{a[0] * b[0] + a[3] * b[3] + a[5] * b[5], a[3] * b[3] + a[1] * b[1] + a[4] * b[4],
             a[5] * b[5] + a[4] * b[4] + a[2] * b[2], a[0] * b[3] + a[3] * b[1] + a[5] * b[4],
             a[3] * b[5] + a[1] * b[4] + a[4] * b[2], a[0] * b[5] + a[3] * b[4] + a[5] * b[2]}};
}

/// c I + sum of factors[i] tensors[i].
template <int D, int N>
SCARP_INLINE Symmetric<D> combine(double c, const double (&factors)[N], const Symmetric<D> (&tensors)[N]) {
  Symmetric<D> s;
#pragma GCC unroll 6
  for (int i = 0; i < Symmetric<D>::n; ++i) {
    s.a[i] = i < 3 && c != 0 ? c + factors[0] * tensors[0].a[i] : factors[0] * tensors[0].a[i];
#pragma GCC unroll 4
    for (int k = 1; k < N; ++k) s.a[i] += factors[k] == 1 ? tensors[k].a[i] : factors[k] * tensors[k].a[i];
  }
  return s;
}

/// Determinant and adjugate of a symmetric tensor.
template <int D>
SCARP_INLINE Pack adjugate(const Symmetric<D>& M, Symmetric<D>& adjoint) {
  const Pack(&a)[Symmetric<D>::n] = M.a;
  Pack(&c)[Symmetric<D>::n] = adjoint.a;
  if constexpr (D == 2) {
    c[0] = a[1] * a[2];
    c[1] = a[0] * a[2];
    c[2] = a[0] * a[1] - a[3] * a[3];
    c[3] = -a[3] * a[2];
    return a[2] * c[2];
  } else {
    c[0] = a[1] * a[2] - a[4] * a[4];
    c[1] = a[0] * a[2] - a[5] * a[5];
    c[2] = a[0] * a[1] - a[3] * a[3];
    c[3] = a[5] * a[4] - a[3] * a[2];
    c[4] = a[3] * a[5] - a[0] * a[4];
    c[5] = a[3] * a[4] - a[1] * a[5];
    return a[0] * c[0] + a[3] * c[3] + a[5] * c[5];
  }
}

/// Of the deformations F with b = F F^T.
template <int D>
SCARP_INLINE Stretch stretch_of(const Symmetric<D>& b) {
  Symmetric<D> adjoint;
  const Pack J = square_root(adjugate<D>(b, adjoint));
  return {b.a[0] + b.a[1] + b.a[2], adjoint.a[0] + adjoint.a[1] + adjoint.a[2], J, 1.0 / J};
}

/// Eigenvalues of a symmetric tensor in descending order, and functions of it, without eigenvectors: these cost long
/// chains of roots and quotients. In space one eigenvalue stands apart from the two others; its projector is the
/// adjugate of A - value I over its trace, and of the others' plane only the deviator is needed, which vanishes with
/// the difference of their values: nothing is lost where these meet.
template <int D>
struct Spectrum;

template <>
struct Spectrum<2> {
  Pack value[3];

  explicit SCARP_INLINE Spectrum(const Symmetric<2>& A) {
    const Pack mean = 0.5 * (A.a[0] + A.a[1]);
    half_ = 0.5 * (A.a[0] - A.a[1]);
    shear_ = A.a[3];
    const Pack radius = square_root(half_ * half_ + shear_ * shear_);
    per_radius_ = choose(radius > 0.0, 1.0 / choose(radius > 0.0, radius, all(1.0)), Pack{});
    const Pack most = mean + radius, least = mean - radius, z = A.a[2];
    first_ = z > most;
    last_ = z < least;
    value[0] = choose(first_, z, most);
    value[1] = choose(first_, most, choose(last_, least, z));
    value[2] = choose(last_, z, least);
  }

  /// The tensor with the same principal directions and the values t, in the same order.
  SCARP_INLINE Symmetric<2> compose(const Pack (&t)[3]) const {
    const Pack most = choose(first_, t[1], t[0]), least = choose(last_, t[1], t[2]);
    const Pack z = choose(first_, t[0], choose(last_, t[2], t[1]));
    const Pack mean = 0.5 * (most + least), slope = 0.5 * (most - least) * per_radius_;
    return {{mean + slope * half_, mean - slope * half_, z, slope * shear_}};
  }

 private:
  Pack half_, shear_, per_radius_;
  Mask first_, last_;
};

template <>
struct Spectrum<3> {
  Pack value[3];

  explicit SCARP_INLINE Spectrum(const Symmetric<3>& A) {
    const Pack mean = (A.a[0] + A.a[1] + A.a[2]) * (1.0 / 3);
    const Pack x = A.a[0] - mean, y = A.a[1] - mean, z = A.a[2] - mean;
    const Pack square =
        (x * x + y * y + z * z + 2.0 * (A.a[3] * A.a[3] + A.a[4] * A.a[4] + A.a[5] * A.a[5])) * (1.0 / 6);
    const Pack size = square_root(square),
               per_size = choose(size > 0.0, 1.0 / choose(size > 0.0, size, all(1.0)), Pack{});
    // B has the roots of x^3 - 3 x - det B = 0.
    Symmetric<3> B{{x * per_size, y * per_size, z * per_size, A.a[3] * per_size, A.a[4] * per_size, A.a[5] * per_size}};
    Symmetric<3> adjoint;
    const Pack half = 0.5 * adjugate<3>(B, adjoint);
    up_ = half >= 0.0;
    const Pack apart = with_sign(isolated_root(smaller(all(1.0), magnitude(half))), half);
    Symmetric<3> M = B;
    for (int i = 0; i < 3; ++i) M.a[i] -= apart;
    adjugate<3>(M, projector_);
    const Pack per_trace = 1.0 / (projector_.a[0] + projector_.a[1] + projector_.a[2]);
    Pack across{};
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      projector_.a[i] *= per_trace;
      deviator_.a[i] = B.a[i] - 1.5 * apart * projector_.a[i] + (i < 3 ? 0.5 * apart : Pack{});
      across += (i < 3 ? 1.0 : 2.0) * deviator_.a[i] * deviator_.a[i];
    }
    const Pack radius = square_root(0.5 * across);
    per_radius_ = choose(radius > 0.0, 1.0 / choose(radius > 0.0, radius, all(1.0)), Pack{});
    const Pack alone = mean + size * apart, middle = mean - 0.5 * size * apart, spread = size * radius;
    value[0] = choose(up_, alone, middle + spread);
    value[1] = choose(up_, middle + spread, middle - spread);
    value[2] = choose(up_, middle - spread, alone);
  }

  SCARP_INLINE Symmetric<3> compose(const Pack (&t)[3]) const {
    const Pack alone = choose(up_, t[0], t[2]), most = choose(up_, t[1], t[0]), least = choose(up_, t[2], t[1]);
    const Pack mean = 0.5 * (most + least), slope = 0.5 * (most - least) * per_radius_, rest = alone - mean;
    Symmetric<3> s;
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) s.a[i] = (i < 3 ? mean : Pack{}) + rest * projector_.a[i] + slope * deviator_.a[i];
    return s;
  }

 private:
  /// The root of x^3 - 3 x - 2 r = 0 in [sqrt(3), 2], see solver/materials/symmetric_eigen.cpp.
  static SCARP_INLINE Pack isolated_root(Pack r) {
    constexpr double x0 = 1.7320508075688772, d0 = 1.0 / 3, x1 = 2, d1 = 2.0 / 9;
    Pack x = x0 + r * (d0 + r * ((3 * (x1 - x0) - 2 * d0 - d1) + r * (2 * (x0 - x1) + d0 + d1)));
    const Pack f = x * (x * x - 3.0) - 2.0 * r, slope = 3.0 * (x * x - 1.0);
    x -= f * slope / (slope * slope - 3.0 * f * x);
    return x - (x * (x * x - 3.0) - 2.0 * r) / (3.0 * (x * x - 1.0));
  }

  Symmetric<3> projector_;  ///< of the value that stands apart
  Symmetric<3> deviator_;   ///< of the others' plane
  Pack per_radius_;
  Mask up_;  ///< whether it is the largest
};

/// Beyond this distance of b from I, and this size of 2 e, series give way to the spectrum.
constexpr double kSmall = 0.063;

/// ln(b) / 2 = atanh(Z) with Z = (b - I) (b + I)^-1 = I - 2 (b + I)^-1: its series to Z^9 is exact to the last digits
/// for strains up to kSmall / 2, which soils and metals hardly leave.
template <int D>
SCARP_INLINE Symmetric<D> half_log(const Symmetric<D>& b) {
  if (any(~(distance_from_unit_squared(b) < kSmall * kSmall))) {
    const Spectrum<D> spectrum(b);
    Pack e[3];
    for (int k = 0; k < 3; ++k) e[k] = 0.5 * natural_log(spectrum.value[k]);
    return spectrum.compose(e);
  }
  Symmetric<D> M = b, Z;
  for (int i = 0; i < 3; ++i) M.a[i] += 1.0;
  const Pack factor = -2.0 / adjugate<D>(M, Z);
#pragma GCC unroll 6
  for (int i = 0; i < Symmetric<D>::n; ++i) Z.a[i] = (i < 3 ? all(1.0) : Pack{}) + factor * Z.a[i];
  const Symmetric<D> Y = product<D>(Z, Z), Y2 = product<D>(Y, Y);
  const Symmetric<D> high = product<D>(Y2, combine<D>(1.0 / 5, {1.0 / 7, 1.0 / 9}, {Y, Y2}));
  return product<D>(Z, combine<D>(1.0, {1.0 / 3, 1.0}, {Y, high}));
}

/// exp(2 e).
template <int D>
SCARP_INLINE Symmetric<D> exp_twice(const Symmetric<D>& e) {
  Symmetric<D> A = e;
  Pack square{};
#pragma GCC unroll 6
  for (int i = 0; i < Symmetric<D>::n; ++i) {
    A.a[i] = 2.0 * e.a[i];
    square += (i < 3 ? 1.0 : 2.0) * A.a[i] * A.a[i];
  }
  if (any(~(square < kSmall * kSmall))) {
    const Spectrum<D> spectrum(A);
    Pack t[3];
    for (int k = 0; k < 3; ++k) t[k] = exponential(spectrum.value[k]);
    return spectrum.compose(t);
  }
  const Symmetric<D> A2 = product<D>(A, A), A3 = product<D>(A2, A);
  const Symmetric<D> last = product<D>(A3, combine<D>(1.0 / 720, {1.0 / 5040, 1.0 / 40320, 1.0 / 362880}, {A, A2, A3}));
  const Symmetric<D> high = product<D>(A3, combine<D>(1.0 / 6, {1.0 / 24, 1.0 / 120, 1.0}, {A, A2, last}));
  return combine<D>(1.0, {1.0, 0.5, 1.0}, {A, A2, high});
}

template <int D>
SCARP_INLINE Pack trace(const Symmetric<D>& s) {
  return s.a[0] + s.a[1] + s.a[2];
}

/// |s|^2.
template <int D>
SCARP_INLINE Pack square_norm(const Symmetric<D>& s) {
  Pack off = s.a[3] * s.a[3];
  if constexpr (D == 3) off += s.a[4] * s.a[4] + s.a[5] * s.a[5];
  return s.a[0] * s.a[0] + s.a[1] * s.a[1] + s.a[2] * s.a[2] + 2.0 * off;
}

/// factor s + isotropic I.
template <int D>
SCARP_INLINE Symmetric<D> scaled(const Symmetric<D>& s, Pack factor, Pack isotropic) {
  Symmetric<D> r;
#pragma GCC unroll 6
  for (int i = 0; i < Symmetric<D>::n; ++i) r.a[i] = factor * s.a[i] + (i < 3 ? isotropic : Pack{});
  return r;
}

/// mu |e|^2 + lambda / 2 (tr e)^2 of the logarithmic strain of b.
template <int D>
SCARP_INLINE Pack hencky_energy(const Symmetric<D>& b, Pack mu, Pack lambda) {
  const Symmetric<D> e = half_log<D>(b);
  const Pack volumetric = trace<D>(e);
  return mu * square_norm<D>(e) + 0.5 * lambda * volumetric * volumetric;
}

}  // namespace
}  // namespace SCARP_KERNELS
