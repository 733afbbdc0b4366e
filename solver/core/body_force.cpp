// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/body_force.hpp"

#include "solver/core/linear_cell.hpp"

namespace scarp {
namespace {

/// sum_p phi_Ip m_p b_p at the corners of a cell, per axis.
template <int D>
struct CellForce {
  typename LinearCell<D>::Values sums[D]{};

  CellForce(const Particles& particles, const TotalBody& body, const std::vector<Vec3>& acceleration,
            std::size_t cell) {
    using Cell = LinearCell<D>;
    typename Cell::Values m;
    for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
      const Vec3 force = particles.mass[p] * acceleration[p];
      Cell::monomials(body.grid.xi[p - body.begin], m);
      for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, force[d]);
    }
    for (int d = 0; d < D; ++d) Cell::to_corners(sums[d]);
  }
};

template <int D>
void add_to_slots(const Particles& particles, TotalBody& body, const std::vector<Vec3>& acceleration) {
  constexpr int N = LinearCell<D>::N;
  for (std::size_t cell = 0; cell < body.grid.cells.size(); ++cell) {
    const CellForce<D> force(particles, body, acceleration, cell);
    for (int k = 0; k < N; ++k)
      for (int d = 0; d < D; ++d) body.slots[cell * N + k][d] += force.sums[d][k];
  }
}

template <int D>
double work(const Particles& particles, const TotalBody& body, const std::vector<Vec3>& acceleration, double dt) {
  constexpr int N = LinearCell<D>::N;
  double sum = 0;
  for (std::size_t cell = 0; cell < body.grid.cells.size(); ++cell) {
    const CellForce<D> force(particles, body, acceleration, cell);
    for (int k = 0; k < N; ++k) {
      const std::uint32_t node = body.grid.cell_nodes[cell * N + k];
      for (int d = 0; d < D; ++d) sum += dt * force.sums[d][k] * body.velocity_updated[node][d];
    }
  }
  return sum;
}

}  // namespace

void add_body_force(const Particles& particles, TotalBody& body, const std::vector<Vec3>& acceleration) {
  body.grid.dimension == 2 ? add_to_slots<2>(particles, body, acceleration)
                           : add_to_slots<3>(particles, body, acceleration);
}

double work_of_body_force(const Particles& particles, const TotalBody& body, const std::vector<Vec3>& acceleration,
                          double dt) {
  return body.grid.dimension == 2 ? work<2>(particles, body, acceleration, dt)
                                  : work<3>(particles, body, acceleration, dt);
}

}  // namespace scarp
