// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/transfer.hpp"

#include <gtest/gtest.h>

#include "solver/core/linear_cell.hpp"
#include "solver/core/stress.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"

namespace scarp {
namespace {

/// The obvious way: the product of hat functions of corner k at xi.
double hat(int dimension, int corner, const Vec3& xi) {
  double w = 1;
  for (int a = 0; a < dimension; ++a) w *= corner >> a & 1 ? xi[a] : 1 - xi[a];
  return w;
}

template <int D>
void check_shape() {
  using Cell = LinearCell<D>;
  for (const Vec3 xi : {Vec3{0.2, 0.7, 0.4}, Vec3{0, 1, 0.5}, Vec3{0.999, 0.001, 1}}) {
    typename Cell::Values m;
    Cell::monomials(xi, m);
    double sum = 0, gradient_sum = 0;
    Vec3 place{0, 0, 0};
    for (int corner = 0; corner < Cell::N; ++corner) {
      typename Cell::Values a{};
      a[corner] = 1;
      Cell::to_monomials(a);
      const double phi = Cell::value(a, m);
      EXPECT_NEAR(phi, hat(D, corner, xi), 1e-15);
      sum += phi;
      for (int axis = 0; axis < D; ++axis) place[axis] += phi * (corner >> axis & 1);
      gradient_sum += Cell::template derivative<0>(a, m);
      // gradient by differences: exact for a function that is linear along the axis
      Vec3 low = xi, high = xi;
      low[1] = 0.25;
      high[1] = 0.75;
      EXPECT_NEAR(Cell::template derivative<1>(a, m), 2 * (hat(D, corner, high) - hat(D, corner, low)), 1e-15);
    }
    EXPECT_NEAR(sum, 1, 1e-15);                                                      // partition of unity
    EXPECT_NEAR(gradient_sum, 0, 1e-15);                                             // so its gradient vanishes
    for (int axis = 0; axis < D; ++axis) EXPECT_NEAR(place[axis], xi[axis], 1e-15);  // linear reproduction
    // the map to corners is the transpose of the map from corners
    typename Cell::Values sums{};
    Cell::add_value(sums, m, 3);
    Cell::to_corners(sums);
    for (int corner = 0; corner < Cell::N; ++corner) EXPECT_NEAR(sums[corner], 3 * hat(D, corner, xi), 1e-14);
  }
}

TEST(LinearCellTest, IsAPartitionOfUnityReproducesLinearFieldsAndMapsBackByItsTranspose) {
  check_shape<2>();
  check_shape<3>();
}

Vec3 linear_field(const Vec3& X) {
  return {0.3 + 0.1 * X[0] - 0.2 * X[1] + 0.4 * X[2], -0.1 + 0.5 * X[0] + 0.2 * X[1] - 0.3 * X[2],
          0.2 - 0.4 * X[0] + 0.1 * X[1] + 0.6 * X[2]};
}

Model wedge(int dimension) {
  Model model = test::empty_model({1, -2, dimension == 3 ? 0.5 : 0.0}, {3, -0.5, dimension == 3 ? 2.0 : 0.0}, 0.25);
  test::seed_body(model, "wedge", NeoHookean{{1000, 1e5, 0.3}}, 2, [](const Vec3& X) { return X[0] + X[1] < 1.2; },
                  dimension == 3 ? linear_field : [](const Vec3& X) {
                    const Vec3 v = linear_field(X);
                    return Vec3{v[0], v[1], 0};
                  });
  sort_by_cell(model);
  return model;
}

TEST(Transfer, GridHoldsTheMassAndMomentumOfTheParticles) {
  for (int dimension : {2, 3}) {
    Model model = wedge(dimension);
    TotalBody body = make_total_body(model, model.bodies[0]);
    map_momentum(model.particles, body, 2);
    find_node_velocities(body, 2);
    double particle_mass = 0, node_mass = 0;
    Vec3 particle_momentum{0, 0, 0}, node_momentum{0, 0, 0};
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      particle_mass += model.particles.mass[p];
      particle_momentum = particle_momentum + model.particles.mass[p] * model.particles.velocity[p];
    }
    for (std::size_t i = 0; i < body.grid.nodes.size(); ++i) {
      node_mass += body.grid.node_mass[i];
      node_momentum = node_momentum + body.grid.node_mass[i] * body.velocity[i];
    }
    EXPECT_NEAR(node_mass, particle_mass, 1e-12 * particle_mass);
    for (int a = 0; a < dimension; ++a)
      EXPECT_NEAR(node_momentum[a], particle_momentum[a], 1e-12 * norm(particle_momentum));
  }
}

TEST(Transfer, LinearNodeVelocitiesReachTheParticlesExactly) {
  for (int dimension : {2, 3}) {
    Model model = wedge(dimension);
    TotalBody body = make_total_body(model, model.bodies[0]);
    const Lattice& lattice = model.bodies[0].lattice;
    const auto at_node = [&](std::size_t i) {
      Vec3 X{0, 0, 0};
      for (int a = 0; a < dimension; ++a) X[a] = lattice.origin[a] + body.grid.nodes[i][a] * lattice.cell;
      const Vec3 v = linear_field(X);
      return Vec3{v[0], v[1], dimension == 3 ? v[2] : 0};
    };
    for (std::size_t i = 0; i < body.grid.nodes.size(); ++i) body.velocity_updated[i] = body.velocity[i] = at_node(i);
    Particles& particles = model.particles;
    particles.velocity.assign(particles.size(), Vec3{9, 9, 0});
    advance_particles(particles, body, {0, 0}, 0.5, 1);  // PIC: v_p = sum phi v~_I
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec3 v = linear_field(particles.reference_position[p]);
      const Vec3 moved = particles.position[p] - particles.reference_position[p];
      for (int a = 0; a < dimension; ++a) {
        EXPECT_NEAR(particles.velocity[p][a], v[a], 1e-13);
        EXPECT_NEAR(moved[a], 0.5 * v[a], 1e-13);
      }
    }
    const std::vector<PreparedLaw> laws{prepare(model.materials[0].law)};
    update_stress(particles, body, laws, 0.5, 1);
    const Mat3 G = dimension == 3 ? Mat3{0.1, -0.2, 0.4, 0.5, 0.2, -0.3, -0.4, 0.1, 0.6}
                                  : Mat3{0.1, -0.2, 0, 0.5, 0.2, 0, 0, 0, 0};
    for (std::size_t p = 0; p < particles.size(); ++p)
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(particles.deformation_gradient[p][k], kIdentity[k] + 0.5 * G[k], 1e-13);
  }
}

/// The forces of a uniform stress sum to nothing on inner nodes and to nothing in all.
TEST(Transfer, ForcesOfAUniformStressVanishInsideAndBalance) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 1}, 0.25);
  test::seed_body(model, "block", NeoHookean{{1000, 1e5, 0.3}}, 2, test::everywhere);
  sort_by_cell(model);
  TotalBody body = make_total_body(model, model.bodies[0]);
  model.particles.stress.assign(model.particles.size(), Sym6{1, 2, 3, 0.5, -0.7, 0.2});
  map_stress(model.particles, body, {prepare(model.materials[0].law)}, 1);
  advance_nodes(body, {0, 0, 0}, 1, 1);
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < body.grid.nodes.size(); ++i) {
    const Vec3 force = body.grid.node_mass[i] * body.velocity_updated[i];
    sum = sum + force;
    const LatticeIndex& n = body.grid.nodes[i];
    bool inner = true;
    for (int a = 0; a < 3; ++a) inner = inner && n[a] > 0 && n[a] < 4;
    if (inner) {
      EXPECT_NEAR(norm(force), 0, 1e-15);
    }
    if (n == LatticeIndex{4, 2, 2}) {  // traction sigma e_x on the area of one cell
      EXPECT_NEAR(force[0], -0.0625 * 1, 1e-15);
      EXPECT_NEAR(force[1], -0.0625 * 0.5, 1e-15);
    }
  }
  EXPECT_NEAR(norm(sum), 0, 1e-14);
}

TEST(ReferenceGridTest, KeepsOccupiedCellsOnlyAndGivesBackThePlaceOfEachParticle) {
  Model model = wedge(3);
  const Body& body = model.bodies[0];
  const ReferenceGrid grid = build_reference_grid(model, body);
  EXPECT_LT(grid.cells.size(), 8u * 6 * 6);
  EXPECT_EQ(count_grid(model, body).cells, grid.cells.size());
  EXPECT_EQ(count_grid(model, body).nodes, grid.nodes.size());
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (std::size_t p = grid.cell_begin[c]; p < grid.cell_begin[c + 1]; ++p)
      for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(body.lattice.origin[a] + (grid.cells[c][a] + grid.xi[p][a]) * body.lattice.cell,
                    model.particles.reference_position[p][a], 1e-14);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    for (std::uint32_t s = grid.around_begin[i]; s < grid.around_begin[i + 1]; ++s)
      EXPECT_EQ(grid.cell_nodes[grid.around[s]], i);
  EXPECT_EQ(grid.around.size(), grid.cell_nodes.size());
}

TEST(ReferenceGridTest, SortingKeepsIdentityAndIsIdempotent) {
  Model model = wedge(2);
  std::vector<std::size_t> order(model.particles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = (i * 7919) % order.size();
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  ASSERT_EQ(order.size(), model.particles.size());
  std::reverse(order.begin(), order.end());
  const Particles before = model.particles;
  permute_particles(model.particles, order);
  sort_by_cell(model);
  EXPECT_EQ(model.particles.id, before.id);
  EXPECT_EQ(model.particles.reference_position, before.reference_position);
}

TEST(ReferenceGridTest, RefusesParticlesOutsideTheLatticeAndNodesWithoutMass) {
  Model model = wedge(2);
  Model outside = model;
  outside.particles.reference_position[5][0] = 3.1;
  try {
    sort_by_cell(outside);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("of body 'wedge' lies outside"), std::string::npos) << error.what();
  }
  Model alone = test::empty_model({0, 0, 0}, {1, 1, 0}, 1);
  test::seed_body(alone, "alone", NeoHookean{{1000, 1e5, 0.3}}, 1, test::everywhere);
  alone.particles.reference_position[0] = {0, 0.5, 0};
  EXPECT_THROW(build_reference_grid(alone, alone.bodies[0]), Error);
}

}  // namespace
}  // namespace scarp
