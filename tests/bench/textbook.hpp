// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method as a textbook writes it: particles as structures, one loop for each step of the algorithm, weights found
// where they are needed, one thread. What `scarp bench` compares the solver with; see also its accuracy in
// tests/unit/core/textbook_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp::textbook {

struct Particle {
  double X[3], x[3], v[3];
  double F[9];
  double P[9];  ///< first Piola-Kirchhoff stress (total Lagrangian) or Cauchy stress (updated)
  double mass, V0;
};

/// A neo-Hookean block of n^dimension cells of one metre with 2^dimension points each, its first corner `margin` cells
/// from the grid's origin; linear shape functions, MUSL.
class Block {
 public:
  Block(int dimension, int n, int margin, double density, double mu, double lambda);

  std::vector<Particle> particles;
  void step_total(double dt, const double (&gravity)[3]);
  void step_updated(double dt, const double (&gravity)[3]);

 private:
  template <int D>
  void total(double dt, const double (&gravity)[3]);
  template <int D>
  void updated(double dt, const double (&gravity)[3]);

  struct Node {
    double mass, momentum[3], force[3], v[3], v_new[3];
  };
  int dimension_, nodes_;
  double mu_, lambda_;
  std::vector<Node> grid_;
};

}  // namespace scarp::textbook
