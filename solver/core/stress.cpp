// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/stress.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/averaged_stress.hpp"
#include "solver/core/total_sweep.hpp"
#include "solver/core/transfer.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

enum class Mode { update, map_only };

struct Sweep {
  Particles& particles;
  TotalBody& body;
  const std::vector<PreparedLaw>& laws;
  double dt;
  bool find_speed;
};

/// Particles [begin, end) of one cell and one law: their F, history and stress; their forces into `sums`.
template <int D, Mode mode, class Law>
inline void sweep_particles(const Sweep& sweep, const Law& law, std::size_t begin, std::size_t end,
                            const typename LinearCell<D>::Values (&v)[D], CellSums<D>& sums) {
  Particles& particles = sweep.particles;
  const double per_cell = 1 / sweep.body.grid.cell;
  const double per_dt = mode == Mode::update ? 1 / sweep.dt : 0;
  typename LinearCell<D>::Values m;
  for (std::size_t p = begin; p < end; ++p) {
    LinearCell<D>::monomials(sweep.body.grid.xi[p - sweep.body.begin], m);
    Mat3& F = particles.deformation_gradient[p];
    const Mat3* base = base_of(sweep.body, p);
    const Mat3 next = mode == Mode::update ? advanced_gradient<D>(F, base, v, m, sweep.dt * per_cell) : F;
    const Motion motion = make_motion(F, next, per_dt);
    F = motion.F;
    bool valid = motion.J > 0 && motion.J < 1e100;
    if (valid) {
      PointHistory history = load_history<Law>(particles, p);
      Sym6& sigma = particles.stress[p];
      if constexpr (mode == Mode::update) {
        sigma = law.stress(motion, history);
        store_history<Law>(particles, p, history);
      }
      const double c2 = grid_wave_speed_squared(law, motion, history, base);
      valid = std::isfinite(c2 + sigma[0] + sigma[1] + sigma[2] + sigma[3] + sigma[4] + sigma[5]);
      sums.mass += particles.mass[p];
      sums.stiffness += particles.mass[p] * c2;
      const Mat3 P = on_moved_grid(first_piola(sigma, motion.cofactor), base);
      add_force<D>(sums.force, m, P, -particles.reference_volume[p] * per_cell);
    }
    if (!valid && sums.bad_particle < 0) sums.bad_particle = static_cast<std::int64_t>(p);
  }
}

/// The law is resolved once for all cells of the task.
template <int D, Mode mode, class Law>
void sweep_pure(const Sweep& sweep, const Law& law, CellTask& task) {
  for (std::size_t cell = task.begin; cell < task.end; ++cell) {
    typename LinearCell<D>::Values v[D];
    CellSums<D> sums;
    load_velocities<D>(sweep.body, cell, v);
    const auto& begin = sweep.body.grid.cell_begin;
    sweep_particles<D, mode>(sweep, law, begin[cell], begin[cell + 1], v, sums);
    store_sums<D>(sweep.body, cell, task, sums);
  }
}

/// Cells with several materials: the law is resolved once for each run of equal material.
template <int D, Mode mode>
void sweep_mixed(const Sweep& sweep, CellTask& task) {
  const auto& material = sweep.particles.material;
  for (std::size_t cell = task.begin; cell < task.end; ++cell) {
    typename LinearCell<D>::Values v[D];
    CellSums<D> sums;
    load_velocities<D>(sweep.body, cell, v);
    const std::size_t end = sweep.body.grid.cell_begin[cell + 1];
    for (std::size_t p = sweep.body.grid.cell_begin[cell], next = p; p < end; p = next) {
      while (next < end && material[next] == material[p]) ++next;
      std::visit([&](const auto& law) { sweep_particles<D, mode>(sweep, law, p, next, v, sums); },
                 sweep.laws[material[p]]);
    }
    store_sums<D>(sweep.body, cell, task, sums);
  }
}

/// Whether the task's cells go by packs of particles.
bool has_kernel(const TotalBody& body, const CellTask& task) {
  return body.kernels && body.base.empty() && task.material >= 0 && body.law_parameters[task.material];
}

template <int D>
void sweep_packs(const Sweep& sweep, CellTask& task) {
  const kernels::LawParameters& law = *sweep.body.law_parameters[task.material];
  kernels::CellSweep packs = cell_sweep(sweep.particles, sweep.body, {}, sweep.dt);
  packs.find_speed = sweep.find_speed;
  kernels::CellResult result;
  sweep.body.kernels->cells.deform[static_cast<int>(law.kind)][D - 2](packs, task.begin, task.end, law, result);
  task.largest_wave_speed_squared = result.largest_speed_squared;
  task.bad_particle = result.bad_particle;
}

template <int D, Mode mode>
StressOutcome sweep_body(const Sweep& sweep, int threads) {
  return sweep_tasks(sweep.body, threads, [&](CellTask& task) {
    if (mode == Mode::update && has_kernel(sweep.body, task))
      sweep_packs<D>(sweep, task);
    else if (task.material < 0)
      sweep_mixed<D, mode>(sweep, task);
    else
      std::visit([&](const auto& law) { sweep_pure<D, mode>(sweep, law, task); }, sweep.laws[task.material]);
  });
}

}  // namespace

StressOutcome update_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, double dt,
                            int threads, bool find_speed) {
  if (!body.since.empty()) return update_averaged_stress(particles, body, laws, dt, threads);
  const Sweep sweep{particles, body, laws, dt, find_speed};
  return body.grid.dimension == 2 ? sweep_body<2, Mode::update>(sweep, threads)
                                  : sweep_body<3, Mode::update>(sweep, threads);
}

StressOutcome map_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, int threads) {
  if (!body.since.empty()) return map_averaged_stress(particles, body, laws, threads);
  const Sweep sweep{particles, body, laws, 0, true};
  return body.grid.dimension == 2 ? sweep_body<2, Mode::map_only>(sweep, threads)
                                  : sweep_body<3, Mode::map_only>(sweep, threads);
}

}  // namespace scarp
