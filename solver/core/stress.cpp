// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/stress.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/linear_cell.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

enum class Mode { update, map_only };

struct Sweep {
  Particles& particles;
  TotalBody& body;
  const std::vector<PreparedLaw>& laws;
  double dt;
};

template <class Law>
PointHistory load_history(const Particles& particles, std::size_t p) {
  if constexpr (Law::has_history)
    return {particles.elastic_left_cauchy_green[p], particles.equivalent_plastic_strain[p], particles.plastic_work[p]};
  return {};
}

template <class Law>
void store_history(Particles& particles, std::size_t p, const PointHistory& history) {
  if constexpr (Law::has_history) {
    particles.elastic_left_cauchy_green[p] = history.elastic_left_cauchy_green;
    particles.equivalent_plastic_strain[p] = history.equivalent_plastic_strain;
    particles.plastic_work[p] = history.plastic_work;
  }
}

/// (5) F + dt sum v_I x grad0 phi_Ip; `v` in monomials, `factor` = dt / cell.
template <int D>
Mat3 advanced_gradient(const Mat3& F, const typename LinearCell<D>::Values (&v)[D],
                       const typename LinearCell<D>::Values& m, double factor) {
  Mat3 next = F;
#pragma GCC unroll 3
  for (int i = 0; i < D; ++i) {
    next[3 * i] += factor * LinearCell<D>::template derivative<0>(v[i], m);
    next[3 * i + 1] += factor * LinearCell<D>::template derivative<1>(v[i], m);
    if constexpr (D == 3) next[3 * i + 2] += factor * LinearCell<D>::template derivative<2>(v[i], m);
  }
  return next;
}

/// (1) Adds - V0 P grad0 phi_Ip; `factor` = - V0 / cell.
template <int D>
void add_force(typename LinearCell<D>::Values (&sums)[D], const typename LinearCell<D>::Values& m, const Mat3& P,
               double factor) {
#pragma GCC unroll 3
  for (int i = 0; i < D; ++i) {
    LinearCell<D>::template add_derivative<0>(sums[i], m, factor * P[3 * i]);
    LinearCell<D>::template add_derivative<1>(sums[i], m, factor * P[3 * i + 1]);
    if constexpr (D == 3) LinearCell<D>::template add_derivative<2>(sums[i], m, factor * P[3 * i + 2]);
  }
}

/// What a cell's particles add up to.
template <int D>
struct CellSums {
  typename LinearCell<D>::Values force[D]{};
  double mass = 0;
  double stiffness = 0;  ///< sum of m_p c_p^2
  std::int64_t bad_particle = -1;
};

/// Particles [begin, end) of one cell and one law: their F, history and stress; their forces into `sums`.
template <int D, Mode mode, class Law>
inline void sweep_particles(const Sweep& sweep, const Law& law, std::size_t begin, std::size_t end,
                            const typename LinearCell<D>::Values (&v)[D], CellSums<D>& sums) {
  Particles& particles = sweep.particles;
  const double per_cell = 1 / sweep.body.grid.cell;
  typename LinearCell<D>::Values m;
  for (std::size_t p = begin; p < end; ++p) {
    LinearCell<D>::monomials(sweep.body.grid.xi[p - sweep.body.begin], m);
    Mat3& F = particles.deformation_gradient[p];
    const Motion motion = make_motion(F, mode == Mode::update ? advanced_gradient<D>(F, v, m, sweep.dt * per_cell) : F);
    F = motion.F;
    bool valid = motion.J > 0 && motion.J < 1e100;
    if (valid) {
      PointHistory history = load_history<Law>(particles, p);
      Sym6& sigma = particles.stress[p];
      if constexpr (mode == Mode::update) {
        sigma = law.stress(motion, history);
        store_history<Law>(particles, p, history);
      }
      const double c2 = law.wave_speed_squared(motion, history);
      valid = std::isfinite(c2 + sigma[0] + sigma[1] + sigma[2] + sigma[3] + sigma[4] + sigma[5]);
      sums.mass += particles.mass[p];
      sums.stiffness += particles.mass[p] * c2;
      add_force<D>(sums.force, m, first_piola(sigma, motion.cofactor), -particles.reference_volume[p] * per_cell);
    }
    if (!valid && sums.bad_particle < 0) sums.bad_particle = static_cast<std::int64_t>(p);
  }
}

template <int D>
void load_velocities(const TotalBody& body, std::size_t cell, typename LinearCell<D>::Values (&v)[D]) {
#pragma GCC unroll 8
  for (int k = 0; k < LinearCell<D>::N; ++k) {
    const Vec3& node = body.velocity[body.grid.cell_nodes[cell * LinearCell<D>::N + k]];
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) v[d][k] = node[d];
  }
#pragma GCC unroll 3
  for (int d = 0; d < D; ++d) LinearCell<D>::to_monomials(v[d]);
}

template <int D>
void store_sums(TotalBody& body, std::size_t cell, CellTask& task, CellSums<D>& sums) {
#pragma GCC unroll 3
  for (int d = 0; d < D; ++d) LinearCell<D>::to_corners(sums.force[d]);
#pragma GCC unroll 8
  for (int k = 0; k < LinearCell<D>::N; ++k)
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) body.slots[cell * LinearCell<D>::N + k][d] = sums.force[d][k];
  task.largest_wave_speed_squared = std::max(task.largest_wave_speed_squared, sums.stiffness / sums.mass);
  if (task.bad_particle < 0) task.bad_particle = sums.bad_particle;
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

template <int D, Mode mode>
StressOutcome sweep_tasks(const Sweep& sweep, int threads) {
  std::vector<CellTask>& tasks = sweep.body.tasks;
  parallel_for(tasks.size(), threads, [&](std::size_t t) {
    CellTask& task = tasks[t];
    task.largest_wave_speed_squared = 0;
    task.bad_particle = -1;
    if (task.material < 0)
      sweep_mixed<D, mode>(sweep, task);
    else
      std::visit([&](const auto& law) { sweep_pure<D, mode>(sweep, law, task); }, sweep.laws[task.material]);
  });
  StressOutcome outcome;
  for (const CellTask& task : tasks) {
    outcome.largest_wave_speed_squared = std::max(outcome.largest_wave_speed_squared, task.largest_wave_speed_squared);
    if (outcome.bad_particle < 0) outcome.bad_particle = task.bad_particle;
  }
  return outcome;
}

template <int D>
void add_body_force_to_cell(const Particles& particles, TotalBody& body, std::size_t cell,
                            const std::function<Vec3(const Vec3& X)>& b) {
  using Cell = LinearCell<D>;
  typename Cell::Values m, sums[D]{};
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    const Vec3 force = particles.mass[p] * b(particles.reference_position[p]);
    Cell::monomials(body.grid.xi[p - body.begin], m);
    for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, force[d]);
  }
  for (int d = 0; d < D; ++d) Cell::to_corners(sums[d]);
  for (int k = 0; k < Cell::N; ++k)
    for (int d = 0; d < D; ++d) body.slots[cell * Cell::N + k][d] += sums[d][k];
}

}  // namespace

StressOutcome update_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, double dt,
                            int threads) {
  const Sweep sweep{particles, body, laws, dt};
  return body.grid.dimension == 2 ? sweep_tasks<2, Mode::update>(sweep, threads)
                                  : sweep_tasks<3, Mode::update>(sweep, threads);
}

StressOutcome map_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, int threads) {
  const Sweep sweep{particles, body, laws, 0};
  return body.grid.dimension == 2 ? sweep_tasks<2, Mode::map_only>(sweep, threads)
                                  : sweep_tasks<3, Mode::map_only>(sweep, threads);
}

void add_body_force(const Particles& particles, TotalBody& body, const std::function<Vec3(const Vec3& X)>& b) {
  for (std::size_t cell = 0; cell < body.grid.cells.size(); ++cell)
    body.grid.dimension == 2 ? add_body_force_to_cell<2>(particles, body, cell, b)
                             : add_body_force_to_cell<3>(particles, body, cell, b);
}

}  // namespace scarp
