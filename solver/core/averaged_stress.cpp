// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/averaged_stress.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/f_bar.hpp"
#include "solver/core/total_sweep.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

struct Sweep {
  Particles& particles;
  TotalBody& body;
  const std::vector<PreparedLaw>& laws;
  double dt;
  bool update;
};

/// Volume of a particle in the configuration of the grid, m3: V0 before its first move.
double grid_volume(const Sweep& sweep, std::size_t p) {
  const Mat3* base = base_of(sweep.body, p);
  return base ? sweep.particles.reference_volume[p] * determinant(*base) : sweep.particles.reference_volume[p];
}

/// Moves F_p with the nodes. The cell's mean volume ratio, in which the grid's configuration has 1.
template <int D>
double advance_gradients(const Sweep& sweep, std::size_t cell) {
  TotalBody& body = sweep.body;
  typename LinearCell<D>::Values v[D], m;
  if (sweep.update) load_velocities<D>(body, cell, v);
  double volume = 0, deformed = 0;
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    Mat3& F = body.since[p - body.begin];
    if (sweep.update) {
      LinearCell<D>::monomials(body.grid.xi[p - body.begin], m);
      F = advanced_gradient<D>(F, base_of(body, p), v, m, sweep.dt / body.grid.cell);
    }
    volume += grid_volume(sweep, p);
    deformed += sweep.particles.reference_volume[p] * determinant(F);
  }
  return deformed / volume;
}

/// What a cell's particles add up to beside their own forces.
template <int D>
struct MeanStress {
  typename LinearCell<D>::Values dilatation[D]{};  ///< - sum V0 cof(F) grad0 phi: the force of a unit mean stress
  double stress = 0;                               ///< sum V s_p, V as of grid_volume
  double volume = 0;                               ///< sum V
};

/// Particle p: its law at F-bar, its part of the cell's forces. Whether it is still valid.
template <int D, class Law>
bool sweep_particle(const Sweep& sweep, const Law& law, std::size_t p, double mean_ratio, CellSums<D>& sums,
                    MeanStress<D>& mean) {
  Particles& particles = sweep.particles;
  const Mat3* base = base_of(sweep.body, p);
  const double V0 = particles.reference_volume[p], V = grid_volume(sweep, p), J_cell = V / V0 * mean_ratio;
  const Mat3& compatible = sweep.body.since[p - sweep.body.begin];
  const Mat3 cof = cofactor(compatible);
  const double J = determinant(compatible, cof);
  if (!(J > 0 && J < 1e100)) return false;
  Mat3& F = particles.deformation_gradient[p];
  const double scale = dilation<D>(J_cell / J);
  const Motion motion =
      make_motion(F, sweep.update ? dilated<D>(compatible, scale) : F, sweep.update ? 1 / sweep.dt : 0);
  F = motion.F;
  if (!(motion.J > 0 && motion.J < 1e100)) return false;
  PointHistory history = load_history<Law>(particles, p);
  Sym6& sigma = particles.stress[p];
  if (sweep.update) {
    sigma = law.stress(motion, history);
    store_history<Law>(particles, p, history);
  }
  // A squeezed point in a cell that is not is as stiff as its own F makes it.
  const double c2 = std::max(1.0, scale * scale) * grid_wave_speed_squared(law, motion, history, base);
  if (!std::isfinite(c2 + sigma[0] + sigma[1] + sigma[2] + sigma[3] + sigma[4] + sigma[5])) return false;
  sums.mass += particles.mass[p];
  sums.stiffness += particles.mass[p] * c2;
  typename LinearCell<D>::Values m;
  LinearCell<D>::monomials(sweep.body.grid.xi[p - sweep.body.begin], m);
  const double factor = -V0 / sweep.body.grid.cell;
  const double s = mean_stress<D>(sigma);
  const Mat3 P = on_moved_grid(first_piola(with_mean_stress<D>(sigma, 0), cof), base);
  add_force<D>(sums.force, m, P, factor * J_cell / J);
  add_force<D>(mean.dilatation, m, on_moved_grid(cof, base), factor);
  mean.stress += V * s;
  mean.volume += V;
  return true;
}

template <int D>
void sweep_cell(const Sweep& sweep, std::size_t cell, CellTask& task) {
  const double mean_ratio = advance_gradients<D>(sweep, cell);
  CellSums<D> sums;
  MeanStress<D> mean;
  for (std::size_t p = sweep.body.grid.cell_begin[cell]; p < sweep.body.grid.cell_begin[cell + 1]; ++p) {
    const bool valid =
        std::visit([&](const auto& law) { return sweep_particle<D>(sweep, law, p, mean_ratio, sums, mean); },
                   sweep.laws[sweep.particles.material[p]]);
    if (!valid && sums.bad_particle < 0) sums.bad_particle = static_cast<std::int64_t>(p);
  }
  const double s_cell = mean.volume > 0 ? mean.stress / mean.volume : 0;
  for (int d = 0; d < D; ++d)
    for (int k = 0; k < LinearCell<D>::N; ++k) sums.force[d][k] += s_cell * mean.dilatation[d][k];
  store_sums<D>(sweep.body, cell, task, sums);
}

template <int D>
StressOutcome sweep_body(const Sweep& sweep, int threads) {
  return sweep_tasks(sweep.body, threads, [&](CellTask& task) {
    for (std::size_t cell = task.begin; cell < task.end; ++cell) sweep_cell<D>(sweep, cell, task);
  });
}

StressOutcome sweep_body(const Sweep& sweep, int threads) {
  return sweep.body.grid.dimension == 2 ? sweep_body<2>(sweep, threads) : sweep_body<3>(sweep, threads);
}

}  // namespace

void average_volumes(TotalBody& body, const Particles& particles) {
  const auto& F = particles.deformation_gradient;
  body.since.assign(F.begin() + static_cast<std::ptrdiff_t>(body.begin),
                    F.begin() + static_cast<std::ptrdiff_t>(body.end));
}

StressOutcome update_averaged_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws,
                                     double dt, int threads) {
  return sweep_body({particles, body, laws, dt, true}, threads);
}

StressOutcome map_averaged_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws,
                                  int threads) {
  return sweep_body({particles, body, laws, 0, false}, threads);
}

}  // namespace scarp
