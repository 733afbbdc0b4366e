// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/apic.hpp"
#include "solver/core/transfer.hpp"
#include "solver/core/transfer_sweep.hpp"

namespace scarp {
namespace {

/// D_p of linear functions.
Vec3 spread(const ReferenceGrid& grid, std::size_t place) {
  Vec3 D{0, 0, 0};
  for (int a = 0; a < grid.dimension; ++a) D[a] = grid.cell * grid.cell * grid.xi[place][a] * (1 - grid.xi[place][a]);
  return D;
}

template <int D, int axis>
void advance_axis(Mat3& C, typename LinearCell<D>::Values (&sums)[D],
                  const typename LinearCell<D>::Values (&updated)[D], const typename LinearCell<D>::Values& m,
                  double per_cell, double mass_times_spread) {
  for (int i = 0; i < D; ++i) {
    C[3 * i + axis] = per_cell * LinearCell<D>::template derivative<axis>(updated[i], m);
    // phi_I (X_I - X_p) = D_p grad phi_I for linear functions
    LinearCell<D>::template add_derivative<axis>(sums[i], m, mass_times_spread * per_cell * C[3 * i + axis]);
  }
}

template <int D>
void advance_cell(const Particles& particles, TotalBody& body, const std::vector<Vec3>& velocities, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values updated[D], m, sums[D]{};
  for (int d = 0; d < D; ++d) {
    for (int k = 0; k < Cell::N; ++k) updated[d][k] = velocities[body.grid.cell_nodes[cell * Cell::N + k]][d];
    Cell::to_monomials(updated[d]);
  }
  const double per_cell = 1 / body.grid.cell;
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    const std::size_t place = p - body.begin;
    const Vec3 mass_times_spread = particles.mass[p] * spread(body.grid, place);
    Mat3& C = body.affine[place];
    Cell::monomials(body.grid.xi[place], m);
    advance_axis<D, 0>(C, sums, updated, m, per_cell, mass_times_spread[0]);
    advance_axis<D, 1>(C, sums, updated, m, per_cell, mass_times_spread[1]);
    if constexpr (D == 3) advance_axis<D, 2>(C, sums, updated, m, per_cell, mass_times_spread[2]);
  }
  for (int d = 0; d < D; ++d) {
    Cell::to_corners(sums[d]);
    for (int k = 0; k < Cell::N; ++k) body.slots[cell * Cell::N + k][d] += sums[d][k];
  }
}

void advance(const Particles& particles, TotalBody& body, const std::vector<Vec3>& velocities, int threads) {
  if (body.grid.dimension == 2)
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<2>(particles, body, velocities, cell); });
  else
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<3>(particles, body, velocities, cell); });
}

}  // namespace

void advance_affine(const Particles& particles, TotalBody& body, int threads) {
  advance(particles, body, body.velocity_updated, threads);
}

void begin_affine(const Particles& particles, TotalBody& body, int threads) {
  body.affine.assign(body.end - body.begin, Mat3{});
  map_momentum(particles, body, threads);
  find_node_velocities(body, threads);
  advance(particles, body, body.velocity, threads);
  find_node_velocities(body, threads);
}

AffineMotion measure_affine(const Particles& particles, const TotalBody& body, int threads) {
  const std::size_t count = body.end - body.begin;
  std::vector<AffineMotion> blocks((count + kReductionBlock - 1) / kReductionBlock);
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    for (std::size_t i = b * kReductionBlock; i < std::min(count, (b + 1) * kReductionBlock); ++i)
      blocks[b] =
          blocks[b] + affine_motion(particles.mass[body.begin + i], particles.deformation_gradient[body.begin + i],
                                    spread(body.grid, i), body.affine[i]);
  });
  AffineMotion sum;
  for (const AffineMotion& block : blocks) sum = sum + block;
  return sum;
}

}  // namespace scarp
