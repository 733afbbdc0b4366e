// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_stress.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/current_wave_speed.hpp"
#include "solver/core/f_bar.hpp"
#include "solver/core/history.hpp"
#include "solver/core/updated_kernels.hpp"
#include "solver/core/updated_window.hpp"

namespace scarp {
namespace {

/// L of member m of cell c.
template <int D, class S>
Mat3 velocity_gradient(const UpdatedGrid& grid, std::size_t c, std::size_t m, const Vec3 (&v)[kWindow<D, S>]) {
  Mat3 L{};
  WindowWeights<D, S>(grid, c, m).each([&](int k, double, const Vec3& gradient) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) L[3 * i + j] += v[k][i] * gradient[j];
  });
  return L;
}

/// I + dt L.
Mat3 increment(const Mat3& L, double dt) {
  Mat3 f = kIdentity;
  for (int i = 0; i < 9; ++i) f[i] += dt * L[i];
  return f;
}

/// (I + dt L) F.
Mat3 advanced(const Mat3& F, const Mat3& L, double dt) {
  Mat3 next = multiply(L, F);
  for (int i = 0; i < 9; ++i) next[i] = F[i] + dt * next[i];
  return next;
}

/// Brings particle p from its F to `F`, with its stress and history where `per_dt` is above 0.
/// c^2 in the current configuration, or -1 where the state is no longer valid.
template <class Law>
double deform(Particles& particles, std::size_t p, const Law& law, const Mat3& F, double per_dt) {
  const Motion motion = make_motion(particles.deformation_gradient[p], F, per_dt);
  particles.deformation_gradient[p] = F;
  if (!(motion.J > 0 && motion.J < 1e100)) return -1;
  PointHistory history = load_history<Law>(particles, p);
  Sym6& sigma = particles.stress[p];
  if (per_dt > 0) {
    sigma = law.stress(motion, history);
    store_history<Law>(particles, p, history);
  }
  const double c2 = current_wave_speed_squared(law, motion, history);
  return std::isfinite(c2 + sigma[0] + sigma[1] + sigma[2] + sigma[3] + sigma[4] + sigma[5]) ? c2 : -1;
}

/// Gives the increments of cell c's members the mean change of volume, sum V det f / sum V; the Cauchy stress does work
/// per current volume, so that cell_mean_stress is what makes the work of the forces that of the laws.
template <int D>
void average_increments(const Particles& particles, UpdatedGrid& grid, std::size_t c) {
  double before = 0, after = 0;
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const double V = determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
    before += V;
    after += V * determinant(grid.trial[m]);
  }
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    Mat3& f = grid.trial[m];
    f = dilated<D>(f, dilation<D>(after / before / determinant(f)));
  }
}

template <int D, class S>
void deform_cell(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, double dt, bool move,
                 std::size_t b, std::size_t c, UpdatedOutcome& outcome) {
  const double per_dt = move ? 1 / dt : 0;
  Vec3 v[kWindow<D, S>];
  if (move)
    for (int k = 0; k < kWindow<D, S>; ++k) v[k] = grid.velocity[window_node<D, S>(grid, b, c, k)];
  if (move && grid.averages) {
    for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m)
      grid.trial[m] = increment(velocity_gradient<D, S>(grid, c, m, v), dt);
    average_increments<D>(particles, grid, c);
  }
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const Mat3& old = particles.deformation_gradient[p];
    const Mat3 F = !move           ? old
                   : grid.averages ? multiply(grid.trial[m], old)
                                   : advanced(old, velocity_gradient<D, S>(grid, c, m, v), dt);
    const double c2 =
        std::visit([&](const auto& law) { return deform(particles, p, law, F, per_dt); }, laws[particles.material[p]]);
    if (grid.kernels) grid.volume[p] = determinant(F) * particles.reference_volume[p];
    note(outcome, c2, p);
  }
}

UpdatedOutcome sweep(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, double dt,
                     bool move, int threads) {
  std::vector<UpdatedOutcome>& tasks = grid.task_outcomes;
  tasks.assign(grid.blocks.size(), {});
  const bool packed = move && grid.kernels && !grid.averages;
  const kernels::ParticleSweep kernel_sweep = particle_sweep(particles, grid, {}, dt);
  with_shape(grid, [&]<int D, class S>() {
    parallel_for(grid.blocks.size(), threads, [&](std::size_t b) {
      const auto one_by_one = [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t c = begin; c < end; ++c) deform_cell<D, S>(particles, grid, laws, dt, move, b, c, tasks[b]);
      };
      if (packed)
        deform_block(grid, kernel_sweep, particles, b, tasks[b], one_by_one);
      else
        one_by_one(grid.block_begin[b], grid.block_begin[b + 1]);
    });
  });
  UpdatedOutcome all;
  for (const UpdatedOutcome& task : tasks) {
    note(all, task.largest_wave_speed_squared, 0);
    if (task.bad_particle >= 0) note(all, -1, static_cast<std::size_t>(task.bad_particle));
  }
  return all;
}

}  // namespace

UpdatedOutcome update_stress(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, double dt,
                             int threads) {
  return sweep(particles, grid, laws, dt, true, threads);
}

UpdatedOutcome survey(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, int threads) {
  return sweep(particles, grid, laws, 0, false, threads);
}

}  // namespace scarp
