// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the stress sweeps over total-Lagrangian bodies share.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/core/history.hpp"
#include "solver/core/linear_cell.hpp"
#include "solver/core/moving_reference.hpp"
#include "solver/core/stress.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {

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

/// The same on a grid that has moved, where grad0 phi = F0^T grad phi; `base` = F0, or none.
template <int D>
Mat3 advanced_gradient(const Mat3& F, const Mat3* base, const typename LinearCell<D>::Values (&v)[D],
                       const typename LinearCell<D>::Values& m, double factor) {
  if (!base) return advanced_gradient<D>(F, v, m, factor);
  Mat3 change = multiply(advanced_gradient<D>(Mat3{}, v, m, factor), *base);
  for (int i = 0; i < 9; ++i) change[i] += F[i];
  return change;
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

/// v_I of the cell, in monomials.
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

/// From monomials to the slots of the cell, and to its task.
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

/// sweep(task) over all tasks of the body, and what they found.
template <class F>
StressOutcome sweep_tasks(TotalBody& body, int threads, F&& sweep) {
  std::vector<CellTask>& tasks = body.tasks;
  parallel_for(tasks.size(), threads, [&](std::size_t t) {
    tasks[t].largest_wave_speed_squared = 0;
    tasks[t].bad_particle = -1;
    sweep(tasks[t]);
  });
  StressOutcome outcome;
  for (const CellTask& task : tasks) {
    outcome.largest_wave_speed_squared = std::max(outcome.largest_wave_speed_squared, task.largest_wave_speed_squared);
    if (outcome.bad_particle < 0) outcome.bad_particle = task.bad_particle;
  }
  return outcome;
}

}  // namespace scarp
