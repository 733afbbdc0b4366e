// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/textbook.hpp"

#include <cmath>

namespace scarp::textbook {
namespace {

/// Corner nodes, weights and gradients of a point, cell edge 1.
template <int D>
struct Weights {
  static constexpr int N = 1 << D;
  std::size_t node[N];
  double w[N], g[N][3];

  Weights(const double (&x)[3], int nodes) {
    int cell[3] = {0, 0, 0};
    double xi[3] = {0, 0, 0};
    for (int a = 0; a < D; ++a) {
      cell[a] = static_cast<int>(x[a]);
      xi[a] = x[a] - cell[a];
    }
    for (int k = 0; k < N; ++k) {
      const int i[3] = {k & 1, k >> 1 & 1, k >> 2};
      std::size_t index = 0;
      for (int a = D - 1; a >= 0; --a)
        index = index * static_cast<std::size_t>(nodes) + static_cast<std::size_t>(cell[a] + i[a]);
      node[k] = index;
      w[k] = 1;
      for (int a = 0; a < D; ++a) w[k] *= i[a] ? xi[a] : 1 - xi[a];
      for (int a = 0; a < D; ++a) {
        g[k][a] = i[a] ? 1 : -1;
        for (int b = 0; b < D; ++b)
          if (b != a) g[k][a] *= i[b] ? xi[b] : 1 - xi[b];
      }
    }
  }
};

double determinant(const double (&F)[9]) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/// mu (F - F^-T) + lambda ln J F^-T.
void first_piola(const double (&F)[9], double mu, double lambda, double (&P)[9]) {
  const double J = determinant(F), factor = (lambda * std::log(J) - mu) / J;
  const double c[9] = {F[4] * F[8] - F[5] * F[7], F[5] * F[6] - F[3] * F[8], F[3] * F[7] - F[4] * F[6],
                       F[2] * F[7] - F[1] * F[8], F[0] * F[8] - F[2] * F[6], F[1] * F[6] - F[0] * F[7],
                       F[1] * F[5] - F[2] * F[4], F[2] * F[3] - F[0] * F[5], F[0] * F[4] - F[1] * F[3]};
  for (int i = 0; i < 9; ++i) P[i] = mu * F[i] + factor * c[i];
}

/// [mu (F F^T - I) + lambda ln J I] / J.
void cauchy(const double (&F)[9], double mu, double lambda, double (&s)[9]) {
  const double J = determinant(F), isotropic = (lambda * std::log(J) - mu) / J;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      s[3 * i + j] = i == j ? isotropic : 0;
      for (int k = 0; k < 3; ++k) s[3 * i + j] += mu / J * F[3 * i + k] * F[3 * j + k];
    }
}

}  // namespace

Block::Block(int dimension, int n, int margin, double density, double mu, double lambda)
    : dimension_(dimension), nodes_(n + 2 * margin + 1), mu_(mu), lambda_(lambda) {
  std::size_t nodes = 1;
  for (int a = 0; a < dimension; ++a) nodes *= static_cast<std::size_t>(nodes_);
  grid_.resize(nodes);
  const double V0 = dimension == 2 ? 0.25 : 0.125;
  for (int k = 0; k < (dimension == 3 ? 2 * n : 1); ++k)
    for (int j = 0; j < 2 * n; ++j)
      for (int i = 0; i < 2 * n; ++i) {
        Particle p{};
        const int index[3] = {i, j, k};
        for (int a = 0; a < dimension; ++a) p.X[a] = p.x[a] = margin + 0.5 * index[a] + 0.25;
        p.F[0] = p.F[4] = p.F[8] = 1;
        p.V0 = V0;
        p.mass = density * V0;
        particles.push_back(p);
      }
}

void Block::step_total(double dt, const double (&gravity)[3]) {
  dimension_ == 2 ? total<2>(dt, gravity) : total<3>(dt, gravity);
}
void Block::step_updated(double dt, const double (&gravity)[3]) {
  dimension_ == 2 ? updated<2>(dt, gravity) : updated<3>(dt, gravity);
}

template <int D>
void Block::total(double dt, const double (&gravity)[3]) {
  for (Node& n : grid_) n = {};
  for (const Particle& p : particles) {
    const Weights<D> s(p.X, nodes_);
    for (int k = 0; k < s.N; ++k) {
      Node& n = grid_[s.node[k]];
      n.mass += s.w[k] * p.mass;
      for (int i = 0; i < D; ++i) {
        n.momentum[i] += s.w[k] * p.mass * p.v[i];
        for (int j = 0; j < D; ++j) n.force[i] -= p.V0 * p.P[3 * i + j] * s.g[k][j];
      }
    }
  }
  for (Node& n : grid_)
    if (n.mass > 0)
      for (int i = 0; i < D; ++i) {
        n.v[i] = n.momentum[i] / n.mass;
        n.v_new[i] = n.v[i] + dt * (n.force[i] / n.mass + gravity[i]);
      }
  for (Particle& p : particles) {
    const Weights<D> s(p.X, nodes_);
    for (int k = 0; k < s.N; ++k) {
      const Node& n = grid_[s.node[k]];
      for (int i = 0; i < D; ++i) {
        p.v[i] += s.w[k] * (n.v_new[i] - n.v[i]);
        p.x[i] += dt * s.w[k] * n.v_new[i];
      }
    }
  }
  for (Node& n : grid_)
    for (double& component : n.momentum) component = 0;
  for (const Particle& p : particles) {
    const Weights<D> s(p.X, nodes_);
    for (int k = 0; k < s.N; ++k)
      for (int i = 0; i < D; ++i) grid_[s.node[k]].momentum[i] += s.w[k] * p.mass * p.v[i];
  }
  for (Node& n : grid_)
    if (n.mass > 0)
      for (int i = 0; i < D; ++i) n.v[i] = n.momentum[i] / n.mass;
  for (Particle& p : particles) {
    const Weights<D> s(p.X, nodes_);
    for (int k = 0; k < s.N; ++k)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) p.F[3 * i + j] += dt * grid_[s.node[k]].v[i] * s.g[k][j];
    first_piola(p.F, mu_, lambda_, p.P);
  }
}

template <int D>
void Block::updated(double dt, const double (&gravity)[3]) {
  for (Node& n : grid_) n = {};
  for (const Particle& p : particles) {
    const Weights<D> s(p.x, nodes_);
    const double V = determinant(p.F) * p.V0;
    for (int k = 0; k < s.N; ++k) {
      Node& n = grid_[s.node[k]];
      n.mass += s.w[k] * p.mass;
      for (int i = 0; i < D; ++i) {
        n.momentum[i] += s.w[k] * p.mass * p.v[i];
        for (int j = 0; j < D; ++j) n.force[i] -= V * p.P[3 * i + j] * s.g[k][j];
      }
    }
  }
  for (Node& n : grid_)
    if (n.mass > 0)
      for (int i = 0; i < D; ++i) {
        n.v[i] = n.momentum[i] / n.mass;
        n.v_new[i] = n.v[i] + dt * (n.force[i] / n.mass + gravity[i]);
        n.momentum[i] = 0;
      }
  // The positions move after the second map: both maps of a step share its weights.
  for (Particle& p : particles) {
    const Weights<D> s(p.x, nodes_);
    for (int k = 0; k < s.N; ++k)
      for (int i = 0; i < D; ++i) p.v[i] += s.w[k] * (grid_[s.node[k]].v_new[i] - grid_[s.node[k]].v[i]);
  }
  for (const Particle& p : particles) {
    const Weights<D> s(p.x, nodes_);
    for (int k = 0; k < s.N; ++k)
      for (int i = 0; i < D; ++i) grid_[s.node[k]].momentum[i] += s.w[k] * p.mass * p.v[i];
  }
  for (Node& n : grid_)
    if (n.mass > 0)
      for (int i = 0; i < D; ++i) n.v[i] = n.momentum[i] / n.mass;
  for (Particle& p : particles) {
    const Weights<D> s(p.x, nodes_);
    double L[9] = {}, moved[3] = {0, 0, 0};
    for (int k = 0; k < s.N; ++k) {
      const Node& n = grid_[s.node[k]];
      for (int i = 0; i < D; ++i) {
        moved[i] += s.w[k] * n.v_new[i];
        for (int j = 0; j < D; ++j) L[3 * i + j] += n.v[i] * s.g[k][j];
      }
    }
    double F[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        F[3 * i + j] = p.F[3 * i + j];
        for (int k = 0; k < 3; ++k) F[3 * i + j] += dt * L[3 * i + k] * p.F[3 * k + j];
      }
    for (int i = 0; i < 9; ++i) p.F[i] = F[i];
    for (int i = 0; i < D; ++i) p.x[i] += dt * moved[i];
    cauchy(p.F, mu_, lambda_, p.P);
  }
}

}  // namespace scarp::textbook
