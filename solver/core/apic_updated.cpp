// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "solver/core/apic.hpp"
#include "solver/core/updated_transfer.hpp"
#include "solver/core/updated_window.hpp"

namespace scarp {
namespace {

/// See apic.hpp, in h^2.
constexpr double kLeastSpread = 1.0 / 8;

/// x_I - x_p of member m of cell c over its window, m.
template <int D, class S>
class WindowOffsets {
 public:
  WindowOffsets(const UpdatedGrid& grid, std::size_t c, std::size_t m) {
    for (int a = 0; a < D; ++a)
      for (int i = 0; i < S::width; ++i) {
        const std::int32_t cell = grid.cells[c][a];
        offset_[a][i] = grid.cell * (S::place(cell + i, grid.cell_count[a]) - cell - grid.xi[grid.members[m]][a]);
      }
  }
  Vec3 operator[](int k) const {
    Vec3 r{offset_[0][k % S::width], offset_[1][k / S::width % S::width], 0};
    if constexpr (D == 3) r[2] = offset_[2][k / (S::width * S::width)];
    return r;
  }

 private:
  double offset_[D][S::width];
};

/// Adds phi mass C r to the momenta of the window.
template <int D, class S>
void add_momenta(const WindowWeights<D, S>& weights, const WindowOffsets<D, S>& offsets, double mass, const Mat3& C,
                 std::array<double, 4>* momenta) {
  weights.each_value([&](int k, double phi) {
    const Vec3 r = offsets[k];
    for (int i = 0; i < D; ++i)
      for (int a = 0; a < D; ++a) momenta[in_tile<D, S>(k)][i] += phi * mass * C[3 * i + a] * r[a];
  });
}

/// C of the velocities of the window.
/// @param least_spread  in the place of smaller entries of D_p, m2
template <int D, class S>
Mat3 affine_part(const WindowWeights<D, S>& weights, const WindowOffsets<D, S>& offsets, const Vec3* velocities,
                 const Vec3& mean, double least_spread) {
  Mat3 C{};
  Vec3 spread{0, 0, 0};
  weights.each_value([&](int k, double phi) {
    const Vec3 r = offsets[k], v = velocities[k] - mean;
    for (int a = 0; a < D; ++a) {
      spread[a] += phi * r[a] * r[a];
      for (int i = 0; i < D; ++i) C[3 * i + a] += phi * v[i] * r[a];
    }
  });
  for (int a = 0; a < D; ++a)
    for (int i = 0; i < D; ++i) C[3 * i + a] /= std::max(spread[a], least_spread);
  return C;
}

template <int D, class S>
void advance_cell(const Particles& particles, UpdatedGrid& grid, const std::vector<Vec3>& velocities, std::size_t b,
                  std::size_t c, std::array<double, 4>* momenta) {
  Vec3 updated[kWindow<D, S>];
  for (int k = 0; k < kWindow<D, S>; ++k) updated[k] = velocities[window_node<D, S>(grid, b, c, k)];
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const WindowWeights<D, S> weights(grid, c, m);
    const WindowOffsets<D, S> offsets(grid, c, m);
    grid.affine[p] =
        affine_part<D, S>(weights, offsets, updated, particles.velocity[p], kLeastSpread * grid.cell * grid.cell);
    add_momenta<D, S>(weights, offsets, particles.mass[p], grid.affine[p], momenta);
  }
}

void advance(const Particles& particles, UpdatedGrid& grid, const std::vector<Vec3>& velocities, int threads) {
  map_more_momenta(grid, threads, [&]<int D, class S>(std::size_t b, std::size_t c, std::array<double, 4>* momenta) {
    advance_cell<D, S>(particles, grid, velocities, b, c, momenta);
  });
}

}  // namespace

void add_affine_momenta(const Particles& particles, UpdatedGrid& grid, int threads) {
  map_more_momenta(grid, threads, [&]<int D, class S>(std::size_t, std::size_t c, std::array<double, 4>* momenta) {
    for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
      const std::uint32_t p = grid.members[m];
      add_momenta<D, S>(WindowWeights<D, S>(grid, c, m), WindowOffsets<D, S>(grid, c, m), particles.mass[p],
                        grid.affine[p], momenta);
    }
  });
}

void advance_affine(const Particles& particles, UpdatedGrid& grid, int threads) {
  advance(particles, grid, grid.velocity_updated, threads);
}

void begin_affine(Particles& particles, UpdatedGrid& grid, int threads) {
  grid.affine.assign(particles.size(), Mat3{});
  map_to_nodes(particles, grid, threads);
  find_node_velocities(grid, threads);
  advance(particles, grid, grid.velocity, threads);
  find_node_velocities(grid, threads);
}

AffineMotion measure_affine(const Particles& particles, const UpdatedGrid& grid, int threads) {
  std::vector<AffineMotion> tasks(grid.blocks.size());
  with_shape(grid, [&]<int D, class S>() {
    for_each_updated_cell(grid, threads, [&](std::size_t t, std::size_t c) {
      for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
        const std::uint32_t p = grid.members[m];
        const WindowOffsets<D, S> offsets(grid, c, m);
        Vec3 spread{0, 0, 0};
        WindowWeights<D, S>(grid, c, m).each_value([&](int k, double phi) {
          for (int a = 0; a < D; ++a) spread[a] += phi * offsets[k][a] * offsets[k][a];
        });
        tasks[t] = tasks[t] + affine_motion(particles.mass[p], kIdentity, spread, grid.affine[p]);
      }
    });
  });
  AffineMotion sum;
  for (const AffineMotion& task : tasks) sum = sum + task;
  return sum;
}

}  // namespace scarp
