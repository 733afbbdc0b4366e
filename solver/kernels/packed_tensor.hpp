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

template <int D>
SCARP_INLINE Pack trace(const Symmetric<D>& s) {
  return s.a[0] + s.a[1] + s.a[2];
}

/// |s|^2.
template <int D>
SCARP_INLINE Pack square_norm(const Symmetric<D>& s) {
  Pack off = s.a[3] * s.a[3];
  if constexpr (D == 3) off += s.a[4] * s.a[4] + s.a[5] * s.a[5];
  return (s.a[0] * s.a[0] + s.a[1] * s.a[1]) + (s.a[2] * s.a[2] + 2.0 * off);
}

/// factor s + isotropic I.
template <int D>
SCARP_INLINE Symmetric<D> scaled(const Symmetric<D>& s, Pack factor, Pack isotropic) {
  Symmetric<D> r;
#pragma GCC unroll 6
  for (int i = 0; i < Symmetric<D>::n; ++i) r.a[i] = factor * s.a[i] + (i < 3 ? isotropic : Pack{});
  return r;
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

/// Eigenvalues of a symmetric tensor in descending order, and functions of it, in three stages (see Points). Without
/// eigenvectors, which cost long chains of roots and quotients. In space one eigenvalue stands apart from the two
/// others; its projector is the adjugate of A - value I over its trace, and of the others' plane only the deviator is
/// needed, which vanishes with the difference of their values: nothing is lost where these meet.
template <int D>
struct Spectrum;

template <>
struct Spectrum<2> {
  Pack value[3];

  SCARP_INLINE void begin(const Symmetric<2>& A) {
    const Pack mean = 0.5 * (A.a[0] + A.a[1]);
    half_ = 0.5 * (A.a[0] - A.a[1]);
    shear_ = A.a[3];
    const Pack square = half_ * half_ + shear_ * shear_;
    per_radius_ = inverse_root(square);
    const Pack radius = square * per_radius_;
    const Pack most = mean + radius, least = mean - radius, z = A.a[2];
    first_ = z > most;
    last_ = z < least;
    value[0] = choose(first_, z, most);
    value[1] = choose(first_, most, choose(last_, least, z));
    value[2] = choose(last_, z, least);
  }
  SCARP_INLINE void isolate() {}
  SCARP_INLINE void part() {}

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

  /// B = (A - mean I) / size has the roots of x^3 - 3 x - det B = 0.
  SCARP_INLINE void begin(const Symmetric<3>& A) {
    mean_ = trace<3>(A) * (1.0 / 3);
    Symmetric<3> B = scaled<3>(A, all(1.0), -mean_);
    const Pack square = square_norm<3>(B) * (1.0 / 6), per_size = inverse_root(square);
    size_ = square * per_size;
    deviator_ = scaled<3>(B, per_size, Pack{});
    half_ = 0.5 * adjugate<3>(deviator_, B);
  }

  /// The root that stands apart, x = 2 cos(acos(r) / 3) in [sqrt(3), 2] of r = |det B| / 2 in [0, 1], with the sign of
  /// det B: a polynomial through nine Chebyshev points is within 4e-9, one of Newton's steps squares that.
  SCARP_INLINE void isolate() {
    constexpr double even[] = {1.732050811199128, -0.09620888290561681, -0.03021455030883797, -0.00985938231067646,
                               -0.0006057083976176929},
                     odd[] = {0.3333327422890219, 0.049208593581414876, 0.018766661112370756, 0.003529713725179641};
    const Pack r = smaller(all(1.0), magnitude(half_)), r2 = r * r;
    Pack x = even[3] + r2 * even[4], y = odd[2] + r2 * odd[3];
    for (int k = 2; k >= 0; --k) x = even[k] + r2 * x;
    for (int k = 1; k >= 0; --k) y = odd[k] + r2 * y;
    x += r * y;
    const Pack near = 1.0 / (3.0 * (x * x) - 3.0);
    x -= (x * (x * x - 3.0) - 2.0 * r) * near;
    per_slope_ = near * (2.0 - near * (3.0 * (x * x) - 3.0));
    apart_ = with_sign(x, half_);
  }

  /// The slope 3 (x^2 - 1) of the cubic is the trace of the adjugate of B - x I, too.
  SCARP_INLINE void part() {
    Symmetric<3> M = deviator_;
    for (int i = 0; i < 3; ++i) M.a[i] -= apart_;
    adjugate<3>(M, projector_);
    projector_ = scaled<3>(projector_, per_slope_, Pack{});
    const Pack half = 0.5 * apart_, share = 3.0 * half;
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i)
      deviator_.a[i] = (i < 3 ? deviator_.a[i] + half : deviator_.a[i]) - share * projector_.a[i];
    const Pack square = 0.5 * square_norm<3>(deviator_);
    per_radius_ = inverse_root(square);
    const Pack alone = mean_ + size_ * apart_, middle = mean_ - size_ * half, spread = size_ * (square * per_radius_);
    const Mask up = half_ >= 0.0;
    value[0] = choose(up, alone, middle + spread);
    value[1] = choose(up, middle + spread, middle - spread);
    value[2] = choose(up, middle - spread, alone);
  }

  SCARP_INLINE Symmetric<3> compose(const Pack (&t)[3]) const {
    const Mask up = half_ >= 0.0;
    const Pack alone = choose(up, t[0], t[2]), most = choose(up, t[1], t[0]), least = choose(up, t[2], t[1]);
    const Pack mean = 0.5 * (most + least), slope = 0.5 * (most - least) * per_radius_, rest = alone - mean;
    Symmetric<3> s;
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) s.a[i] = (i < 3 ? mean : Pack{}) + rest * projector_.a[i] + slope * deviator_.a[i];
    return s;
  }

 private:
  Symmetric<3> projector_;  ///< of the value that stands apart
  Symmetric<3> deviator_;   ///< B, then that of the others' plane
  Pack mean_, size_, half_, apart_, per_slope_, per_radius_;
};

/// All stages at once.
template <int D>
SCARP_INLINE Spectrum<D> spectrum_of(const Symmetric<D>& A) {
  Spectrum<D> spectrum;
  spectrum.begin(A);
  spectrum.isolate();
  spectrum.part();
  return spectrum;
}

/// What a symmetric tensor's characteristic polynomial makes of its powers: A^3 = I1 A^2 - I2 A + I3 I with
/// A^2 = adj A + I1 A - I2 I. So a polynomial of A is one in three scalars, at three operations a term, and needs no
/// product of tensors. In plane strain A^2 = I1 A - I2 I in the plane, and zz goes by itself.
template <int D>
struct Invariants;

template <>
struct Invariants<3> {
  Symmetric<3> adjoint;
  Pack I1, I2, I3;

  explicit SCARP_INLINE Invariants(const Symmetric<3>& A) {
    I3 = adjugate<3>(A, adjoint);
    I1 = trace<3>(A);
    I2 = trace<3>(adjoint);
  }
  /// sum of c[k] A^(k + 1).
  template <int N>
  SCARP_INLINE Symmetric<3> series(const Symmetric<3>& A, const double (&c)[N]) const {
    Pack second = all(c[N - 1]), first = all(c[N - 2]), zeroth = all(c[N - 3]);
#pragma GCC unroll 24
    for (int k = N - 4; k >= -1; --k) {
      const Pack last = second;
      second = first + last * I1;
      first = zeroth - last * I2;
      zeroth = last * I3;
      if (k >= 0) zeroth += c[k];
    }
    zeroth -= second * I2;
    first += second * I1;
    Symmetric<3> s;
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) s.a[i] = second * adjoint.a[i] + first * A.a[i] + (i < 3 ? zeroth : Pack{});
    return s;
  }
};

template <>
struct Invariants<2> {
  Pack I1, I2;

  explicit SCARP_INLINE Invariants(const Symmetric<2>& A)
      : I1(A.a[0] + A.a[1]), I2(A.a[0] * A.a[1] - A.a[3] * A.a[3]) {}
  template <int N>
  SCARP_INLINE Symmetric<2> series(const Symmetric<2>& A, const double (&c)[N]) const {
    Pack first = all(c[N - 1]), zeroth = all(c[N - 2]), across = all(c[N - 1]);
#pragma GCC unroll 24
    for (int k = N - 3; k >= -1; --k) {
      const Pack last = first;
      first = zeroth + last * I1;
      zeroth = -(last * I2);
      if (k >= 0) zeroth += c[k];
    }
#pragma GCC unroll 24
    for (int k = N - 2; k >= 0; --k) across = c[k] + across * A.a[2];
    return {{zeroth + first * A.a[0], zeroth + first * A.a[1], across * A.a[2], first * A.a[3]}};
  }
};

/// f(x) = c[0] x + ... + c[N - 1] x^N to 2e-17 for |x| <= reach.
template <int N>
struct Series {
  double reach;
  double c[N];

  SCARP_INLINE Pack operator()(Pack x) const {
    Pack sum = all(c[N - 1]);
#pragma GCC unroll 24
    for (int k = N - 2; k >= 0; --k) sum = c[k] + sum * x;
    return sum * x;
  }
};

/// f(x) / x of M terms of Taylor's series, shortened to N: taking off multiples of Chebyshev's polynomials spreads what
/// is lost evenly over the reach, where terms cut off would be missed at its end alone.
template <int N, int M>
constexpr Series<N> shortened(double reach, const double (&taylor)[M]) {
  double b[M]{}, power = 1;
  for (int k = 0; k < M; ++k, power *= reach) b[k] = taylor[k] * power;
  for (int n = M - 1; n >= N; --n) {
    double before[M + 1]{1}, T[M + 1]{0, 1};
    for (int m = 2; m <= n; ++m)
      for (int k = m; k >= 0; --k) {
        const double next = (k > 0 ? 2 * T[k - 1] : 0) - before[k];
        before[k] = T[k];
        T[k] = next;
      }
    const double share = b[n] / T[n];
    for (int k = 0; k <= n; ++k) b[k] -= share * T[k];
  }
  Series<N> series{reach, {}};
  power = 1;
  for (int k = 0; k < N; ++k, power *= reach) series.c[k] = b[k] / power;
  return series;
}

/// ln(1 + x) / 2.
template <int N, int M>
constexpr Series<N> half_log_series(double reach) {
  double taylor[M]{};
  for (int k = 0; k < M; ++k) taylor[k] = (k % 2 == 0 ? 0.5 : -0.5) / (k + 1);
  return shortened<N>(reach, taylor);
}
/// exp(2 x) - 1.
template <int N, int M>
constexpr Series<N> exp_twice_series(double reach) {
  double taylor[M]{}, term = 2;
  for (int k = 0; k < M; ++k, term *= 2.0 / (k + 1)) taylor[k] = term;
  return shortened<N>(reach, taylor);
}

/// For strains that soils and metals hardly leave, and for those that they never do; beyond, the functions themselves.
constexpr auto kHalfLogNear = half_log_series<10, 20>(0.063);
constexpr auto kHalfLogFar = half_log_series<20, 48>(0.35);
constexpr auto kExpTwiceNear = exp_twice_series<8, 14>(0.035);
constexpr auto kExpTwiceFar = exp_twice_series<11, 22>(0.18);

/// What serves for all lanes of numbers, or of tensors of that norm.
enum class Reach { near, far, all };
SCARP_INLINE Reach reach_of(Pack square, double near, double far) {
  if (!any(~(square < near * near))) return Reach::near;
  return any(~(square < far * far)) ? Reach::all : Reach::far;
}

/// A of b = I + A.
template <int D>
SCARP_INLINE Symmetric<D> less_unit(const Symmetric<D>& b) {
  Symmetric<D> A = b;
  for (int i = 0; i < 3; ++i) A.a[i] -= 1.0;
  return A;
}

template <int D>
SCARP_INLINE Symmetric<D> plus_unit(const Symmetric<D>& A) {
  Symmetric<D> b = A;
  for (int i = 0; i < 3; ++i) b.a[i] += 1.0;
  return b;
}

/// ln(I + A) / 2.
template <int D, Reach reach>
SCARP_INLINE Symmetric<D> half_log(const Symmetric<D>& A) {
  if constexpr (reach == Reach::near) return Invariants<D>(A).series(A, kHalfLogNear.c);
  if constexpr (reach == Reach::far) return Invariants<D>(A).series(A, kHalfLogFar.c);
  const Spectrum<D> spectrum = spectrum_of<D>(A);
  Pack e[3];
  for (int k = 0; k < 3; ++k) e[k] = 0.5 * natural_log(1.0 + spectrum.value[k]);
  return spectrum.compose(e);
}
template <int D>
SCARP_INLINE Symmetric<D> half_log(const Symmetric<D>& A) {
  switch (reach_of(square_norm<D>(A), kHalfLogNear.reach, kHalfLogFar.reach)) {
    case Reach::near:
      return half_log<D, Reach::near>(A);
    case Reach::far:
      return half_log<D, Reach::far>(A);
    default:
      return half_log<D, Reach::all>(A);
  }
}

/// exp(2 e) - I.
template <int D, Reach reach>
SCARP_INLINE Symmetric<D> exp_twice(const Symmetric<D>& e) {
  if constexpr (reach == Reach::near) return Invariants<D>(e).series(e, kExpTwiceNear.c);
  if constexpr (reach == Reach::far) return Invariants<D>(e).series(e, kExpTwiceFar.c);
  const Spectrum<D> spectrum = spectrum_of<D>(e);
  Pack t[3];
  for (int k = 0; k < 3; ++k) t[k] = exponential(2.0 * spectrum.value[k]) - 1.0;
  return spectrum.compose(t);
}

template <int D>
SCARP_INLINE Symmetric<D> exp_twice(const Symmetric<D>& e) {
  switch (reach_of(square_norm<D>(e), kExpTwiceNear.reach, kExpTwiceFar.reach)) {
    case Reach::near:
      return exp_twice<D, Reach::near>(e);
    case Reach::far:
      return exp_twice<D, Reach::far>(e);
    default:
      return exp_twice<D, Reach::all>(e);
  }
}

/// The same of principal values, in place.
SCARP_INLINE void half_log(Reach reach, Pack (&x)[3]) {
  if (reach == Reach::near)
    for (Pack& value : x) value = kHalfLogNear(value);
  else if (reach == Reach::far)
    for (Pack& value : x) value = kHalfLogFar(value);
  else
    for (Pack& value : x) value = 0.5 * natural_log(1.0 + value);
}
SCARP_INLINE void exp_twice(Pack (&x)[3]) {
  const Reach reach = reach_of(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], kExpTwiceNear.reach, kExpTwiceFar.reach);
  if (reach == Reach::near)
    for (Pack& value : x) value = kExpTwiceNear(value);
  else if (reach == Reach::far)
    for (Pack& value : x) value = kExpTwiceFar(value);
  else
    for (Pack& value : x) value = exponential(2.0 * value) - 1.0;
}

/// mu |e|^2 + lambda / 2 (tr e)^2 of the logarithmic strain of b.
template <int D>
SCARP_INLINE Pack hencky_energy(const Symmetric<D>& b, Pack mu, Pack lambda) {
  const Symmetric<D> e = half_log<D>(less_unit<D>(b));
  const Pack volumetric = trace<D>(e);
  return mu * square_norm<D>(e) + 0.5 * lambda * volumetric * volumetric;
}

}  // namespace
}  // namespace SCARP_KERNELS
