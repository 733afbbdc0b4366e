// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_grid.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "solver/core/current_wave_speed.hpp"
#include "solver/core/updated_transfer.hpp"
#include "solver/core/updated_window.hpp"
#include "tests/support/lattice_seed.hpp"

namespace scarp {
namespace {

Model cloud(int dimension, std::mt19937& random) {
  Model model = test::empty_model({-1, 2, 0}, {1, 4, dimension == 3 ? 2.0 : 0.0}, 0.25);
  test::seed_body(model, "total", NeoHookean{{1000, 1e5, 0.3}}, 1, [](const Vec3& X) { return X[0] < -0.5; });
  test::seed_body(model, "updated", NeoHookean{{1000, 1e5, 0.3}}, 2, [](const Vec3& X) { return X[0] > 0.5; });
  model.bodies[1].formulation = Formulation::updated_lagrangian;
  std::uniform_real_distribution<double> spread(-0.3, 0.3);
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    model.particles.velocity[p] = {spread(random), spread(random), 0};
    for (int a = 0; a < dimension; ++a) {
      double& x = model.particles.position[p][a];
      x = std::clamp(x + spread(random), model.domain.min[a], model.domain.max[a]);
    }
  }
  return model;
}

using Index = std::array<std::int32_t, 3>;

/// Each particle in the cell that contains it, once; only such cells; all nodes of their windows, once.
void expect_right(const UpdatedGrid& grid, const Model& model) {
  std::map<Index, std::vector<std::uint32_t>> expected;
  for (std::size_t p = model.bodies[1].begin; p < model.bodies[1].end; ++p) {
    Index cell{0, 0, 0};
    for (int a = 0; a < grid.dimension; ++a) {
      const double s = (model.particles.position[p][a] - model.domain.min[a]) / 0.25;
      cell[a] = std::min(7, static_cast<int>(std::floor(s)));
    }
    expected[cell].push_back(static_cast<std::uint32_t>(p));
  }
  std::set<Index> nodes;
  ASSERT_EQ(grid.cells.size(), expected.size());
  for (std::size_t b = 0, c = 0; c < grid.cells.size(); ++c) {
    while (c >= grid.block_begin[b + 1]) ++b;
    const std::vector<std::uint32_t> members(grid.members.begin() + grid.cell_begin[c],
                                             grid.members.begin() + grid.cell_begin[c + 1]);
    EXPECT_EQ(members, expected[grid.cells[c]]);
    const int w = grid.width;
    for (int k = 0; k < grid.window(); ++k) {
      const Index node{grid.cells[c][0] + k % w, grid.cells[c][1] + k / w % w, grid.cells[c][2] + k / w / w};
      nodes.insert(node);
      const int t = grid.tile_edge, place = ((k / w / w) * t + k / w % w) * t + k % w;
      EXPECT_EQ(grid.nodes[grid.tile_nodes[b * grid.tile() + grid.first_in_tile[c] + place]], node);
    }
  }
  EXPECT_EQ(std::set<Index>(grid.nodes.begin(), grid.nodes.end()), nodes);
  EXPECT_EQ(grid.nodes.size(), nodes.size());
  const auto used = [](const auto& of_lattice) {
    return of_lattice.size() - std::count(of_lattice.begin(), of_lattice.end(), UpdatedGrid::kNone);
  };
  EXPECT_EQ(static_cast<std::size_t>(used(grid.block_of_lattice)), grid.blocks.size());
  EXPECT_EQ(static_cast<std::size_t>(used(grid.node_of_lattice)), grid.nodes.size());
}

TEST(UpdatedGrid, FindsOccupiedCellsAndTheirNodesAfterEveryMove) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
      std::mt19937 random(7);
      Model model = cloud(dimension, random);
      UpdatedGrid grid = make_updated_grid(model, shape, 1);
      expect_right(grid, model);
      for (int move = 0; move < 3; ++move) {
        model.particles.position = cloud(dimension, random).particles.position;
        EXPECT_EQ(place_particles(grid, model.particles, 1), -1);
        expect_right(grid, model);
      }
      const std::uint64_t placings = grid.placings;
      model.particles.position[model.bodies[1].begin + 3][0] += 1e-13;  // within its cell
      EXPECT_EQ(place_particles(grid, model.particles, 1), -1);
      EXPECT_EQ(grid.placings, placings);
      model.particles.position[model.bodies[1].begin + 9][1] = 4.2;
      model.particles.position[model.bodies[1].begin + 4][1] = NAN;
      EXPECT_EQ(place_particles(grid, model.particles, 1), static_cast<std::int64_t>(model.bodies[1].begin + 4));
    }
}

/// The sweeps against sums over all particles and nodes, with weights from the families themselves.
TEST(UpdatedGrid, MapsMassMomentumAndForceLikeTheSumsOfTheMethod) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
      std::mt19937 random(11);
      Model model = cloud(dimension, random);
      Particles& particles = model.particles;
      for (Sym6& s : particles.stress)
        for (int i : {0, 1, 3}) s[i] = static_cast<double>(random() % 1000);
      UpdatedGrid grid = make_updated_grid(model, shape, 1);
      map_to_nodes(particles, grid, 1);
      find_node_velocities(grid, 1);
      advance_nodes(grid, {0, 0, 0}, 0.01, 1);
      std::vector<NodeSums> sums(grid.nodes.size());
      with_shape(grid, [&]<int D, class S>() {
        for (std::size_t c = 0; c < grid.cells.size(); ++c)
          for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
            const std::uint32_t p = grid.members[m];
            const Sym6& s = particles.stress[p];
            double N[3][S::width], dN[3][S::width];
            const double half = S::has_size ? grid.half_edge[p] : 0;
            for (int a = 0; a < D; ++a)
              S::weigh((particles.position[p][a] - grid.origin[a]) / grid.cell - grid.cells[c][a], grid.cells[c][a],
                       grid.cell_count[a], half, N[a], dN[a]);
            for (int k = 0; k < kWindow<D, S>; ++k) {
              const int i = k % S::width, j = k / S::width % S::width, l = k / (S::width * S::width);
              const double z = D == 3 ? N[D - 1][l] : 1, phi = N[0][i] * N[1][j] * z;
              const double gx = dN[0][i] * N[1][j] * z / grid.cell, gy = N[0][i] * dN[1][j] * z / grid.cell;
              const Index node{grid.cells[c][0] + i, grid.cells[c][1] + j, grid.cells[c][2] + l};
              NodeSums& sum = sums[grid.node_of_lattice[grid.lattice_node(node)]];
              const double V = particles.reference_volume[p];
              sum.mass += phi * particles.mass[p];
              sum.momentum = sum.momentum + phi * particles.mass[p] * particles.velocity[p];
              sum.force = sum.force - V * Vec3{s[0] * gx + s[3] * gy, s[3] * gx + s[1] * gy, 0};
            }
          }
      });
      double mass = 0;
      for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        mass += grid.mass[i];
        EXPECT_NEAR(grid.mass[i], sums[i].mass, 1e-7 * (1 + sums[i].mass));
        const double full = 0.01 * 1000 * std::pow(0.25, dimension);
        if (sums[i].mass < full) continue;
        for (int a = 0; a < dimension; ++a) {
          EXPECT_NEAR(grid.velocity[i][a], sums[i].momentum[a] / sums[i].mass, 1e-7);
          EXPECT_NEAR(grid.velocity_updated[i][a] - grid.velocity[i][a], 0.01 * sums[i].force[a] / sums[i].mass, 1e-4);
        }
      }
      double expected = 0;
      for (std::size_t p = model.bodies[1].begin; p < model.bodies[1].end; ++p) expected += particles.mass[p];
      EXPECT_NEAR(mass, expected, 1e-12 * expected);
    }
}

/// Random deformations: the bound holds, is exact at rest, and plastic flow does not move it.
TEST(CurrentWaveSpeed, BoundsTheFastestWaveInTheCurrentConfiguration) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-0.4, 0.4);
  const NeoHookean m{{1000, 1e6, 0.3}};
  const NeoHookean::Law law(m);
  for (int sample = 0; sample < 2000; ++sample) {
    Mat3 F = kIdentity;
    for (double& f : F) f += part(random);
    const Motion motion = make_motion(F, F);
    if (motion.J < 0.1) continue;
    const Sym6 b = left_product(F);
    const double stretch2 = std::max({b[0], b[1], b[2]});  // n along an axis
    const double exact = (m.shear_modulus() * (stretch2 + 1) + m.lambda() * (1 - std::log(motion.J))) / m.density;
    EXPECT_GE(current_wave_speed_squared(law, motion, {}), exact * (1 - 1e-12));
  }
  const Motion rest = make_motion(kIdentity, kIdentity);
  EXPECT_DOUBLE_EQ(current_wave_speed_squared(law, rest, {}), m.wave_speed() * m.wave_speed());
  const MohrCoulomb soil{{1900, 20e6, 0.3}, 10e3, 28, 0};
  const MohrCoulomb::Law soil_law(soil);
  const Mat3 sheared{1, 50, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_NEAR(current_wave_speed_squared(soil_law, make_motion(sheared, sheared), {}),
              soil.wave_speed() * soil.wave_speed(), 1e-9 * soil.wave_speed() * soil.wave_speed());
}

TEST(CurrentWaveSpeed, TriangularRootGivesTheTensorBack) {
  const Sym6 b{1.3, 0.8, 1.1, 0.2, -0.15, 0.1};
  const Sym6 again = left_product(triangular_root(b));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(again[i], b[i], 1e-15);
}

}  // namespace
}  // namespace scarp
