// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact on the grid: what holds in every single step.
#include "solver/core/grid_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "solver/core/updated_transfer.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

constexpr ShapeFunction kShapes[] = {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp};

/// Adds a box of elastic stuff, updated-Lagrangian.
void add_box(Model& model, const std::string& name, const Vec3& low, const Vec3& high, const Vec3& velocity,
             double density = 1000) {
  const int D = model.domain.dimension;
  test::seed_body(
      model, name, NeoHookean{{density, 1e5, 0.3}}, 2,
      [=](const Vec3& X) {
        for (int a = 0; a < D; ++a)
          if (X[a] < low[a] || X[a] > high[a]) return false;
        return true;
      },
      [=](const Vec3&) {
        return D == 3 ? velocity : Vec3{velocity[0], velocity[1], 0};
      });
  model.bodies.back().formulation = Formulation::updated_lagrangian;
}

Model empty(int dimension) {
  Model model = test::empty_model({0, 0, 0}, {2, 1, dimension == 3 ? 1.0 : 0.0}, 0.125);
  model.contact.method = ContactMethod::grid;
  return model;
}

void move(Model& model, std::size_t body, const Vec3& by) {
  for (std::size_t p = model.bodies[body].begin; p < model.bodies[body].end; ++p)
    model.particles.position[p] = model.particles.position[p] + by;
}

/// Two boxes beside each other, which come together, off the middle, and slide.
Model two_boxes(int dimension, double friction, double gap = 0.01) {
  Model model = empty(dimension);
  add_box(model, "a", {0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}, {1, 0.5, 0});
  add_box(model, "b", {0.75, 0.375, 0.25}, {1.5, 0.875, 0.75}, {-1, -0.25, 0.3}, 3000);
  move(model, 1, {gap, 0, 0});
  model.contact.friction = friction;
  return model;
}

Vec3 momentum_of(const Model& model, std::size_t body) {
  Vec3 sum{0, 0, 0};
  for (std::size_t p = model.bodies[body].begin; p < model.bodies[body].end; ++p)
    sum = sum + model.particles.mass[p] * model.particles.velocity[p];
  return sum;
}

/// All combinations run on other lines.
std::vector<SolverOptions> all_options() {
  std::vector<SolverOptions> all;
  for (const ShapeFunction shape : kShapes)
    for (const UpdateOrder update : {UpdateOrder::musl, UpdateOrder::usl, UpdateOrder::usf})
      for (const Transfer transfer : {Transfer::flip, Transfer::apic, Transfer::xpic}) {
        SolverOptions options = test::solver(0.03, {0, 0, 0}, 0.3, shape);
        options.update = update;
        options.transfer = transfer;
        all.push_back(options);
      }
  SolverOptions blend = test::solver(0.03, {0, 0, 0}, 0.3, ShapeFunction::linear);
  blend.flip = 0.9;
  all.push_back(blend);
  blend.flip = 1;
  blend.anti_locking = AntiLocking::f_bar;
  all.push_back(blend);
  return all;
}

TEST(GridContact, GivesEachBodyTheGridThatItHasAlone) {
  for (int dimension : {2, 3})
    for (const ShapeFunction shape : kShapes) {
      Model model = two_boxes(dimension, 0);
      UpdatedGrid both = make_updated_grid(model, shape, 1);
      map_to_nodes(model.particles, both, 1);
      ASSERT_EQ(both.fields.size(), 2u);
      std::size_t cells = 0, nodes = 0;
      for (std::size_t b = 0; b < 2; ++b) {
        Model other = model;
        other.bodies[1 - b].formulation = Formulation::total_lagrangian;
        UpdatedGrid alone = make_updated_grid(other, shape, 1);
        map_to_nodes(other.particles, alone, 1);
        ASSERT_EQ(both.fields[b].node_end - both.fields[b].node_begin, alone.nodes.size());
        for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
          EXPECT_EQ(both.nodes[nodes + i], alone.nodes[i]);
          EXPECT_EQ(both.sums[nodes + i].mass, alone.sums[i].mass);
          EXPECT_EQ(both.sums[nodes + i].momentum, alone.sums[i].momentum);
        }
        for (std::size_t c = 0; c < alone.cells.size(); ++c) EXPECT_EQ(both.cells[cells + c], alone.cells[c]);
        cells += alone.cells.size();
        nodes += alone.nodes.size();
      }
      EXPECT_EQ(both.cells.size(), cells);
      EXPECT_EQ(both.nodes.size(), nodes);
    }
}

TEST(GridContact, GivesBodiesEqualAndOppositeImpulsesInEveryKindOfStep) {
  for (int dimension : {2, 3})
    for (const SolverOptions& options : all_options()) {
      Model model = two_boxes(dimension, 0.3);
      const Vec3 a = momentum_of(model, 0), b = momentum_of(model, 1);
      test::RecordingSink sink;
      const RunReport report = run(model, options, test::output(0.03, 0.005), sink, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      Vec3 impulse{0, 0, 0};
      double last = 0;
      for (const HistorySample& s : sink.samples) {
        ASSERT_EQ(s.contact_force.size(), 2u);
        impulse = impulse + (s.time - last) * s.contact_force[0];
        last = s.time;
      }
      const double size = norm(a) + norm(b);
      EXPECT_LT(impulse[0], -0.1 * norm(a)) << "they have met";
      EXPECT_LT(norm(momentum_of(model, 0) + momentum_of(model, 1) - (a + b)), 1e-12 * size);
      EXPECT_LT(norm(momentum_of(model, 0) - a - impulse), 1e-11 * size);
    }
}

TEST(GridContact, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const ShapeFunction shape : kShapes) {
    Model one = two_boxes(3, 0.3), four = one;
    test::RecordingSink sink;
    run(one, test::solver(0.03, {0, 0, 0}, 0.3, shape), test::output(0.03, 0.03), sink, 1);
    run(four, test::solver(0.03, {0, 0, 0}, 0.3, shape), test::output(0.03, 0.03), sink, 4);
    EXPECT_EQ(one.particles.position, four.particles.position);
    EXPECT_EQ(one.particles.velocity, four.particles.velocity);
    EXPECT_EQ(one.particles.stress, four.particles.stress);
  }
}

TEST(GridContact, LeavesBodiesThatDoNotTouchAlone) {
  for (const ShapeFunction shape : kShapes) {
    Model both = two_boxes(2, 0.3, 0.06), alone = empty(2);
    add_box(alone, "a", {0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}, {1, 0.5, 0});
    for (Model* model : {&both, &alone})  // swings, and moves away
      for (std::size_t p = 0; p < model->bodies[0].end; ++p)
        model->particles.velocity[p] = {-0.2 - 0.4 * model->particles.position[p][0], 0, 0};
    for (std::size_t p = both.bodies[1].begin; p < both.bodies[1].end; ++p) both.particles.velocity[p] = {0, 0, 0};
    test::RecordingSink sink;
    SolverOptions options = test::solver(0.05, {0, 0, 0}, 0.3, shape);
    run(both, options, test::output(0.05, 0.05), sink, 1);
    run(alone, options, test::output(0.05, 0.05), sink, 1);
    double change = 0;
    for (std::size_t p = 0; p < alone.particles.size(); ++p)
      change = std::max(change, norm(both.particles.position[p] - alone.particles.position[p]));
    for (std::size_t p = both.bodies[1].begin; p < both.bodies[1].end; ++p)
      change = std::max(change, 0.05 * norm(both.particles.velocity[p]));
    // At the corners of wide functions, whose nodes have next to no mass, directions may all be askew.
    EXPECT_LE(change, shape == ShapeFunction::gimp ? 1e-9 : 0);
  }
}

/// By symmetry the plane between two equal bodies is a smooth wall.
TEST(GridContact, StopsEqualBodiesLikeAWallBetweenThem) {
  for (int dimension : {2, 3}) {
    Model both = empty(dimension);
    add_box(both, "a", {0.5, 0.25, 0.25}, {1, 0.75, 0.75}, {1, 0, 0});
    add_box(both, "b", {1, 0.25, 0.25}, {1.5, 0.75, 0.75}, {-1, 0, 0});
    Model wall =
        test::empty_model({0, 0, 0}, {1, 1, dimension == 3 ? 1.0 : 0.0}, 0.125, {Condition::free, Condition::roller});
    add_box(wall, "a", {0.5, 0.25, 0.25}, {1, 0.75, 0.75}, {1, 0, 0});
    test::RecordingSink sink;
    const SolverOptions options = test::solver(0.02, {0, 0, 0}, 0.3);
    run(both, options, test::output(0.02, 0.02), sink, 1);
    run(wall, options, test::output(0.02, 0.02), sink, 1);
    double stress = 0;
    for (std::size_t p = 0; p < wall.particles.size(); ++p) {
      stress = std::max(stress, -wall.particles.stress[p][0]);
      EXPECT_LT(norm(both.particles.position[p] - wall.particles.position[p]), 1e-12);
      EXPECT_LT(norm(both.particles.velocity[p] - wall.particles.velocity[p]), 1e-10);
    }
    EXPECT_GT(stress, 1000);
  }
}

/// A block that is thrown down on a wide slab and slides.
TEST(GridContact, RubsAfterCoulomb) {
  for (int dimension : {2, 3})
    for (const ShapeFunction shape : kShapes)
      for (const auto& [friction, sticks] : {std::pair{0.2, false}, {10., true}}) {
        Model model = empty(dimension);
        model.domain.faces[2] = Condition::fixed;
        add_box(model, "slab", {0, 0, 0}, {2, 0.25, 1}, {0, 0, 0});
        add_box(model, "block", {0.5, 0.25, 0.25}, {1, 0.75, 0.75}, {sticks ? 0.1 : 1, -0.3, 0});
        model.contact.friction = friction;
        test::RecordingSink sink;
        const RunReport report =
            run(model, test::solver(0.06, {0, 0, 0}, 0.3, shape), test::output(0.06, 0.02), sink, 1);
        ASSERT_FALSE(report.failed);
        const Vec3 force = sink.samples.back().contact_force[1];
        EXPECT_GT(force[1], 0);
        EXPECT_LT(force[0], 0) << "slows it";
        if (sticks)
          EXPECT_LT(-force[0], 10 * force[1]);
        else
          EXPECT_NEAR(-force[0] / force[1], friction, 0.05 * friction);
        EXPECT_NEAR(report.last.total, report.first.total, 0.02 * report.first.total) << "all that is lost is counted";
        EXPECT_GT(report.last.friction, 0);
      }
}

/// An edge that slides over a plane is not ploughed into it, where the normals of both at the edge differ.
TEST(GridContact, LetsAnEdgeSlideOverAPlane) {
  for (const ShapeFunction shape : kShapes) {
    Model model = empty(2);
    model.domain.faces[2] = Condition::fixed;
    add_box(model, "slab", {0, 0, 0}, {2, 0.25, 0}, {0, 0, 0});
    add_box(model, "block", {0.25, 0.25, 0}, {0.75, 0.5, 0}, {2, 0, 0});
    test::RecordingSink sink;
    SolverOptions options = test::solver(0.3, {0, -9.81, 0}, 0.3, shape);
    options.gravity_ramp = 0.1;
    const RunReport report = run(model, options, test::output(0.3, 0.3), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    EXPECT_NEAR(momentum_of(model, 1)[0], 250.0, 3.75) << "no friction, but for 0.01 by its edges";
  }
}

/// A body between two others: three fields at the nodes of the edges.
TEST(GridContact, KeepsMomentumWhereThreeBodiesMeet) {
  for (const ShapeFunction shape : kShapes) {
    Model model = empty(2);
    add_box(model, "floor", {0, 0, 0}, {2, 0.25, 0}, {0, 0.3, 0});
    add_box(model, "left", {0.5, 0.25, 0}, {1, 0.75, 0}, {1, -0.5, 0});
    add_box(model, "right", {1, 0.25, 0}, {1.5, 0.75, 0}, {-1, -0.5, 0}, 3000);
    model.contact.friction = 0.4;
    const Vec3 before = momentum_of(model, 0) + momentum_of(model, 1) + momentum_of(model, 2);
    test::RecordingSink sink;
    const RunReport report = run(model, test::solver(0.05, {0, 0, 0}, 0.3, shape), test::output(0.05, 0.05), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    const Vec3 after = momentum_of(model, 0) + momentum_of(model, 1) + momentum_of(model, 2);
    EXPECT_LT(norm(after - before), 1e-12 * norm(momentum_of(model, 2)));
    EXPECT_NEAR(report.last.total, report.first.total, 0.02 * report.first.total);
  }
}

/// Adhesion bears a pull up to its stress times the area of contact.
TEST(GridContact, AdheresUpToItsStrength) {
  for (int dimension : {2, 3})
    for (const ShapeFunction shape : kShapes)
      for (const double share : {0.7, 1.4}) {
        Model model = empty(dimension);
        add_box(model, "held", {0, 0.25, 0.25}, {0.5, 0.75, 0.75}, {0, 0, 0});
        add_box(model, "pulled", {0.5, 0.25, 0.25}, {1, 0.75, 0.75}, {0, 0, 0});
        model.domain.faces[0] = Condition::fixed;
        model.contact.adhesion = 100;
        LoadOptions load;
        load.name = "pull";
        load.where.body = "pulled";
        load.force = Vec3{share * 100 * (dimension == 2 ? 0.5 : 0.25), 0, 0};
        load.table = {{0, 0}, {0.4, 1}};
        model.loads.push_back(load);
        test::RecordingSink sink;
        const RunReport report = run(model, test::solver(0.8, {0, 0, 0}, 0.5, shape), test::output(0.8, 0.8), sink, 1);
        ASSERT_FALSE(report.failed) << report.failure.what;
        const double moved = model.particles.position[model.bodies[1].begin][0] -
                             model.particles.reference_position[model.bodies[1].begin][0];
        if (share < 1)
          EXPECT_LT(moved, 0.003) << "elastic";
        else
          EXPECT_GT(moved, 0.005) << "has come off";
      }
}

/// Total-Lagrangian bodies meet by springs whichever method is asked for.
TEST(GridContact, LeavesTotalLagrangianBodiesToPenalty) {
  const auto make = [](ContactMethod method) {
    Model model = two_boxes(2, 0.3);
    add_box(model, "c", {1.5, 0.375, 0}, {1.9, 0.75, 0}, {-2, 0, 0});
    model.bodies.back().formulation = Formulation::total_lagrangian;
    model.contact.method = method;
    return model;
  };
  const SolverOptions options = test::solver(0.03, {0, 0, 0}, 0.3);
  test::RecordingSink sink, other;
  Model three = make(ContactMethod::grid);
  const Vec3 before = momentum_of(three, 0) + momentum_of(three, 1) + momentum_of(three, 2);
  const RunReport report = run(three, options, test::output(0.03, 0.01), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  EXPECT_LT(norm(momentum_of(three, 0) + momentum_of(three, 1) + momentum_of(three, 2) - before), 1e-10);
  double of_grid = 0, of_springs = 0;
  for (const HistorySample& sample : sink.samples) {
    of_grid += sample.contact_force[0][0];
    of_springs += sample.contact_force[2][0];
  }
  EXPECT_LT(of_grid, 0);
  EXPECT_GT(of_springs, 0);
  EXPECT_NEAR(report.last.total, report.first.total, 0.02 * report.first.total);

  Model by_springs = make(ContactMethod::penalty), by_both = make(ContactMethod::grid);
  for (Model* model : {&by_springs, &by_both}) move(*model, 0, {-0.2, 0, 0});
  for (Model* model : {&by_springs, &by_both})
    for (std::size_t p = 0; p < model->bodies[0].end; ++p) model->particles.velocity[p] = {-1, 0, 0};
  run(by_springs, options, test::output(0.03, 0.01), other, 1);
  run(by_both, options, test::output(0.03, 0.01), other, 1);
  for (std::size_t p = by_both.bodies[1].begin; p < by_both.particles.size(); ++p)
    EXPECT_LT(norm(by_both.particles.velocity[p] - by_springs.particles.velocity[p]), 1e-12) << "no grid between them";
}

std::string refusal(Model model) {
  try {
    const Formulations formulations(model, test::solver(1, {0, 0, 0}), 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GridContact, RefusesWhatItCannotTell) {
  Model model = two_boxes(2, 0.3);
  model.materials.push_back({"other", NeoHookean{{1000, 1e5, 0.3}}});
  model.particles.material[3] = 2;
  EXPECT_EQ(refusal(model), "");
  ContactPairOptions pair;
  pair.materials = {"other", "b"};
  pair.friction = 0.5;
  model.contact.pairs = {pair};
  EXPECT_NE(refusal(model).find("friction between bodies 'a' and 'b'"), std::string::npos);
  pair.materials.clear();
  pair.bodies = {"a", "b"};
  model.contact.pairs.push_back(pair);
  EXPECT_EQ(refusal(model), "");
  model.contact.adhesion = -1;
  EXPECT_NE(refusal(model).find("contact.adhesion"), std::string::npos);
  model.contact.adhesion = 1;
  model.bodies[0].formulation = Formulation::total_lagrangian;
  EXPECT_NE(refusal(model).find("adhesion in contact"), std::string::npos);
  model.contact.adhesion = 0;
  model.bodies[1].formulation = Formulation::total_lagrangian;
  EXPECT_NE(refusal(model).find("without an updated-Lagrangian body"), std::string::npos);
}

}  // namespace
}  // namespace scarp
