// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sweeps over packs of particles against their oracle, particle by particle, on every instruction set that this
// processor has.
#include "solver/core/updated_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/core/formulations.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using kernels::Kernels;

/// A wedge on a fixed base that is thrown about, so that particles change cells; part of it of a law with a kernel,
/// part of one without, in some cells together.
Model thrown_wedge(int dimension, const Material& material, int n) {
  Model model = test::empty_model({0, 0, 0}, {1.9, 1.0, dimension == 3 ? 0.6 : 0}, 0.1,
                                  {Condition::free, Condition::roller, Condition::fixed, Condition::free});
  if (dimension == 3) model.domain.faces[4] = Condition::roller;
  test::seed_body(
      model, "wedge", material, n,
      [](const Vec3& X) { return X[0] > 0.2 && X[0] < 1.7 && X[2] < 0.4 && X[1] < 0.21 + 0.37 * X[0]; },
      [dimension](const Vec3& X) {
        return Vec3{2 + 0.6 * std::sin(9 * X[1]), -2 * X[0] * X[1], dimension == 3 ? 1.5 * X[0] * X[2] : 0};
      });
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  model.materials.push_back({"other", Hencky{{1900, 30e6, 0.25}}});
  model.materials.push_back({"without a kernel", LinearElastic{{1900, 20e6, 0.2}}});
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    const Vec3& X = model.particles.reference_position[p];
    if (X[0] > 1.33) model.particles.material[p] = X[1] > 0.33 ? 2 : 1;
  }
  return model;
}

Particles take_steps(Model model, const SolverOptions& options, const Kernels& kernels, int steps, int threads = 1) {
  Formulations method(model, options, threads, kernels);
  for (int step = 0; step < steps; ++step) method.step(1e-4);
  EXPECT_LT(method.bad_particle(), 0);
  return model.particles;
}

/// By id: the order of sorting is the run's.
double largest_difference(const Particles& a, const Particles& b) {
  EXPECT_EQ(a.id, b.id);
  double stress = 0, size = 0, rest = 0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (int i = 0; i < 6; ++i) {
      stress = std::max(stress, std::abs(a.stress[p][i] - b.stress[p][i]));
      size = std::max(size, std::abs(a.stress[p][i]));
      rest = std::max(rest, std::abs(a.elastic_left_cauchy_green[p][i] - b.elastic_left_cauchy_green[p][i]));
    }
    for (int i = 0; i < 9; ++i)
      rest = std::max(rest, std::abs(a.deformation_gradient[p][i] - b.deformation_gradient[p][i]));
    rest = std::max({rest, norm(a.position[p] - b.position[p]), norm(a.velocity[p] - b.velocity[p]),
                     std::abs(a.equivalent_plastic_strain[p] - b.equivalent_plastic_strain[p])});
  }
  return std::max(rest, stress / size);
}

std::vector<Material> laws() {
  return {NeoHookean{{1900, 20e6, 0.3}},
          Hencky{{1900, 20e6, 0.3}},
          VonMises{{1900, 20e6, 0.3}, 20e3, 1e6},
          DruckerPrager{{1900, 20e6, 0.3}, 10e3, 28, 5, 4e3},
          MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 5},
          MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 0, 2e3}};
}

SolverOptions options_of(int dimension, ShapeFunction shape, BackEnd back_end) {
  SolverOptions options = test::solver(1, dimension == 2 ? Vec3{0, -9.81, 0} : Vec3{0, 0, -9.81});
  options.shape = shape;
  options.back_end = back_end;
  options.flip = 0.98;
  return options;
}

TEST(UpdatedKernels, AgreeWithTheSweepsParticleByParticle) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp})
      for (const Material& law : laws()) {
        const Model model = thrown_wedge(dimension, law, dimension == 2 ? 3 : 2);
        const SolverOptions one_by_one = options_of(dimension, shape, BackEnd::particle_state);
        const Particles oracle = take_steps(model, one_by_one, kernels::best_kernels(), 60);
        if (!std::holds_alternative<NeoHookean>(law) && !std::holds_alternative<Hencky>(law)) {
          double most = 0;
          for (double a : oracle.equivalent_plastic_strain) most = std::max(most, a);
          EXPECT_GT(most, 1e-4);
        }
        for (const Kernels& kernels : kernels::available_kernels()) {
          SCOPED_TRACE("law " + std::to_string(law.index()) + ", " + kernels.name + ", " + std::to_string(dimension) +
                       "D, shape " + std::to_string(static_cast<int>(shape)));
          const SolverOptions packed = options_of(dimension, shape, BackEnd::nodal);
          EXPECT_LT(largest_difference(oracle, take_steps(model, packed, kernels, 60)), 1e-10);
        }
      }
}

TEST(UpdatedKernels, GiveTheSameBitsOnAnyNumberOfThreads) {
  for (int dimension : {2, 3}) {
    const Model model = thrown_wedge(dimension, laws()[3], 2);
    const SolverOptions options = options_of(dimension, ShapeFunction::quadratic_bspline, BackEnd::nodal);
    const Particles one = take_steps(model, options, kernels::best_kernels(), 60, 1);
    for (int threads : {2, 3, 7})
      EXPECT_EQ(largest_difference(one, take_steps(model, options, kernels::best_kernels(), 60, threads)), 0);
  }
}

TEST(UpdatedKernels, TakeThePacksThatTheCellsFill) {
  const Model plane = thrown_wedge(2, laws()[0], 2), space = thrown_wedge(3, laws()[0], 2);
  for (const Model* model : {&plane, &space}) {
    Model sorted = *model;
    UpdatedGrid grid = make_updated_grid(sorted, ShapeFunction::linear, 1);
    use_kernels(grid, sorted.particles, kernels::best_kernels());
    EXPECT_LE(grid.kernels->lanes, model == &plane ? 4 : 8);
  }
}

}  // namespace
}  // namespace scarp
