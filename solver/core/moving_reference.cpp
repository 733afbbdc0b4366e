// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/moving_reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "solver/core/averaged_stress.hpp"
#include "solver/core/total_loads.hpp"
#include "solver/materials/symmetric_eigen.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// Per axis from the lattice's origin, so that keys of nodes fit their integers.
constexpr double kMostCells = 1e6;

/// kappa = lambda_max / lambda_min of F > limit. In the plane kappa + 1 / kappa = |F|^2 / det F, which rises with
/// kappa; in space the bounds of the stretches, exact at rest, spare most particles the eigenvalues.
bool exceeds(const Mat3& F, double limit, int dimension) {
  if (dimension == 2) {
    const double square = F[0] * F[0] + F[1] * F[1] + F[3] * F[3] + F[4] * F[4];
    return square > (limit + 1 / limit) * (F[0] * F[4] - F[1] * F[3]);
  }
  const Motion motion = make_motion(F, F);
  if (square_of_largest_stretch(motion) * inverse_square_of_least_stretch(motion) <= limit * limit) return false;
  const Vec3 squares = symmetric_eigen(left_product(F)).values;
  const auto [least, largest] = std::minmax_element(squares.begin(), squares.end());
  return *largest > limit * limit * *least;
}

/// The body on a lattice that holds all its particles as they are, with nodes where its own has them.
/// @return a particle beyond reach, or none
std::optional<std::size_t> fit_lattice(Body& body, const Particles& particles) {
  Lattice& lattice = body.lattice;
  LatticeIndex lower{0, 0, 0}, upper{0, 0, 0};
  for (int a = 0; a < lattice.dimension(); ++a) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t p = body.begin; p < body.end; ++p) {
      const double cells = (particles.position[p][a] - lattice.origin[a]) / lattice.cell;
      if (!(std::abs(cells) < kMostCells)) return p;
      least = std::min(least, cells);
      most = std::max(most, cells);
    }
    lower[a] = static_cast<std::int32_t>(std::floor(least));
    upper[a] = static_cast<std::int32_t>(std::floor(most)) + 1;
  }
  for (int a = 0; a < lattice.dimension(); ++a) {
    lattice.origin[a] += lower[a] * lattice.cell;
    lattice.cells[a] = upper[a] - lower[a];
  }
  for (NodeSet& set : body.held)
    for (LatticeIndex& node : set.nodes)
      for (int a = 0; a < 3; ++a) node[a] -= lower[a];
  return std::nullopt;
}

}  // namespace

bool is_past_limit(const Particles& particles, const TotalBody& body, double limit, int threads) {
  std::atomic<bool> found = false;
  parallel_for(body.tasks.size(), threads, [&](std::size_t t) {
    const auto& begin = body.grid.cell_begin;
    bool here = false;
    for (std::size_t p = begin[body.tasks[t].begin]; p < begin[body.tasks[t].end]; ++p) {
      const Mat3& F = particles.deformation_gradient[p];
      const Mat3* base = base_of(body, p);
      here = here || exceeds(base ? since_move(F, *base) : F, limit, body.grid.dimension);
    }
    if (here) found = true;
  });
  return found;
}

std::optional<std::size_t> move_reference(Model& model, TotalBody& body) {
  Body placed = model.bodies[model.particles.body[body.begin]];
  if (const auto lost = fit_lattice(placed, model.particles)) return lost;
  sort_by_current_cell(model, placed);
  TotalBody moved = make_total_body(model, placed, build_current_grid(model, placed));
  const Particles& particles = model.particles;
  moved.base.assign(particles.deformation_gradient.begin() + static_cast<std::ptrdiff_t>(body.begin),
                    particles.deformation_gradient.begin() + static_cast<std::ptrdiff_t>(body.end));
  if (!body.since.empty()) average_volumes(moved, particles);
  if (body.kernels) use_kernels(moved, model, *body.kernels);
  moved.conditions.damping = body.conditions.damping;
  set_loads(moved, model);
  body = std::move(moved);
  return std::nullopt;
}

}  // namespace scarp
