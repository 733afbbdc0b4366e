// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every family of shape functions against the contract in solver/shapes/shape.hpp.
#include "solver/shapes/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solver/shapes/gimp.hpp"
#include "solver/shapes/linear.hpp"
#include "solver/shapes/quadratic_bspline.hpp"

namespace scarp {
namespace {

template <class S>
class ShapeContract : public testing::Test {};
using Families = testing::Types<LinearShape, QuadraticBspline, Gimp>;
TYPED_TEST_SUITE(ShapeContract, Families);

/// Halves of the particle's edge, in cells: from nearly a point to one particle per cell.
template <class S>
std::vector<double> halves() {
  return S::has_size ? std::vector<double>{1e-3, 1.0 / 6, 0.25, 0.5} : std::vector<double>{0};
}

template <class S>
struct Weights {
  double N[S::width], dN[S::width];
};

template <class S>
Weights<S> at(double s, int cells, double half, int& cell) {
  cell = std::min(static_cast<int>(s), cells - 1);
  Weights<S> w;
  S::weigh(s - cell, cell, cells, half, w.N, w.dN);
  return w;
}

/// All functions of the axis at s.
template <class S>
std::vector<double> values(double s, int cells, double half) {
  int cell = 0;
  const Weights<S> w = at<S>(s, cells, half, cell);
  std::vector<double> all(cells + S::width - 1, 0.0);
  for (int k = 0; k < S::width; ++k) all[cell + k] = w.N[k];
  return all;
}

template <class S, class F>
void at_many_places(F&& f) {
  for (int cells : {1, 2, 3, 4, 7})
    for (double half : halves<S>())
      for (int i = 0; i <= 97 * cells; ++i) f(i / 97.0, cells, half);
}

TYPED_TEST(ShapeContract, IsAPartitionOfUnityThatReproducesLinearFieldsAndIsNowhereNegative) {
  using S = TypeParam;
  at_many_places<S>([](double s, int cells, double half) {
    int cell = 0;
    const Weights<S> w = at<S>(s, cells, half, cell);
    double sum = 0, slope = 0, linear = 0, gradient = 0;
    for (int k = 0; k < S::width; ++k) {
      EXPECT_GE(w.N[k], 0) << s << " of " << cells;
      sum += w.N[k];
      slope += w.dN[k];
      linear += w.N[k] * S::place(cell + k, cells);
      gradient += w.dN[k] * S::place(cell + k, cells);
    }
    EXPECT_NEAR(sum, 1, 1e-14) << s << " of " << cells << ", half " << half;
    EXPECT_NEAR(slope, 0, 1e-12);
    EXPECT_NEAR(linear, s, 1e-13);
    EXPECT_NEAR(gradient, 1, 1e-12);
  });
}

TYPED_TEST(ShapeContract, HasSlopesThatAgreeWithDifferences) {
  using S = TypeParam;
  const double e = 1e-6;
  at_many_places<S>([&](double s, int cells, double half) {
    if (s < e || s > cells - e || std::abs(s - std::round(s)) < 2 * e) return;
    int cell = 0;
    const Weights<S> w = at<S>(s, cells, half, cell);
    const std::vector<double> below = values<S>(s - e, cells, half), above = values<S>(s + e, cells, half);
    for (int k = 0; k < S::width; ++k)
      // The curvature of GIMP jumps, by up to 1 / half.
      EXPECT_NEAR(w.dN[k], (above[cell + k] - below[cell + k]) / (2 * e), 1e-8 + (half > 0 ? e / half : 0))
          << "function " << cell + k << " of " << cells << " cells at " << s;
  });
}

TYPED_TEST(ShapeContract, IsContinuousFromCellToCell) {
  using S = TypeParam;
  for (int cells : {2, 3, 5})
    for (double half : halves<S>())
      for (int i = 1; i < cells; ++i) {
        const std::vector<double> below = values<S>(i - 1e-12, cells, half), above = values<S>(i, cells, half);
        for (std::size_t f = 0; f < above.size(); ++f) EXPECT_NEAR(below[f], above[f], 1e-11);
      }
}

TYPED_TEST(ShapeContract, HoldsTheWallWithTheFunctionsThatStandOnOrBeyondIt) {
  using S = TypeParam;
  for (int cells : {1, 2, 5})
    for (double half : halves<S>()) {
      const std::vector<double> low = values<S>(0, cells, half), high = values<S>(cells, cells, half);
      double on_low = 0, on_high = 0;
      for (std::size_t f = 0; f < low.size(); ++f) {
        on_low += S::place(static_cast<int>(f), cells) <= 0 ? low[f] : 0;
        on_high += S::place(static_cast<int>(f), cells) >= cells ? high[f] : 0;
      }
      // A particle of some size at the wall reaches half its edge beyond it.
      EXPECT_NEAR(on_low, 1 - half / 4, 1e-14);
      EXPECT_NEAR(on_high, 1 - half / 4, 1e-14);
    }
}

TEST(QuadraticBspline, HasSmoothSlopesAndBernsteinsFunctionsInASingleCell) {
  for (int i = 1; i < 5; ++i) {
    double below[3], above[3], N[3];
    QuadraticBspline::weigh(1, i - 1, 5, 0, N, below);
    QuadraticBspline::weigh(0, i, 5, 0, N, above);
    EXPECT_NEAR(below[0], 0, 1e-15);
    EXPECT_NEAR(below[1], above[0], 1e-15);
    EXPECT_NEAR(below[2], above[1], 1e-15);
    EXPECT_NEAR(above[2], 0, 1e-15);
  }
  double N[3], dN[3];
  QuadraticBspline::weigh(0.3, 0, 1, 0, N, dN);
  EXPECT_NEAR(N[0], 0.49, 1e-15);
  EXPECT_NEAR(N[1], 0.42, 1e-15);
  EXPECT_NEAR(N[2], 0.09, 1e-15);
}

TEST(Gimp, IsTheMeanOfHatFunctionsOverTheParticle) {
  for (double half : {0.1, 0.25, 0.5})
    for (double xi : {0.0, 0.05, 0.3, 0.5, 0.77, 1.0}) {
      double N[4], dN[4];
      Gimp::weigh(xi, 3, 9, half, N, dN);
      for (int k = 0; k < 4; ++k) {
        double mean = 0;
        const int pieces = 20000;
        for (int i = 0; i < pieces; ++i)
          mean += std::max(0.0, 1 - std::abs(xi + 1 - k + half * (2 * (i + 0.5) / pieces - 1))) / pieces;
        EXPECT_NEAR(N[k], mean, 1e-8) << "half " << half << ", xi " << xi;
      }
    }
}

TEST(Gimp, IsCompleteForACentreBeyondTheWall) {
  for (double xi : {-0.25, -0.1, 1.1, 1.25}) {
    double N[4], dN[4], sum = 0, linear = 0;
    Gimp::weigh(xi, 0, 1, 0.25, N, dN);
    for (int k = 0; k < 4; ++k) {
      sum += N[k];
      linear += N[k] * Gimp::place(k, 1);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(linear, xi, 1e-15);
  }
}

}  // namespace
}  // namespace scarp
