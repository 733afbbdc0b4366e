// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "solver/core/cell_list.hpp"
#include "solver/core/contact_surface.hpp"
#include "solver/core/run.hpp"
#include "solver/core/total_body.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using std::numbers::pi;

const NeoHookean kSoft{{1000, 1000, 0.3}};

ContactSurface surface_of(Model& model) {
  sort_by_cell(model);
  return find_contact_surface(model, model.bodies[0], make_total_body(model, model.bodies[0]));
}

double total_area(const ContactSurface& surface) {
  double sum = 0;
  for (double a : surface.area) sum += a;
  return sum;
}

TEST(CellList, FindsWhatALoopOverAllFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3, 3);
  for (int dimension : {2, 3}) {
    std::vector<Vec3> points(500);
    for (Vec3& x : points) x = {place(random), place(random), dimension == 3 ? place(random) : 0};
    CellList cells;
    cells.build(points, 0.7, dimension);
    for (int i = 0; i < 50; ++i) {
      const Vec3 x{place(random), place(random), dimension == 3 ? place(random) : 0};
      std::vector<std::uint32_t> found, expected;
      cells.each_near(x, [&](std::uint32_t p) {
        if (norm(points[p] - x) < 0.7) found.push_back(p);
      });
      for (std::uint32_t p = 0; p < points.size(); ++p)
        if (norm(points[p] - x) < 0.7) expected.push_back(p);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(ContactSurface, StandsOnTheFacesOfABlock) {
  for (int dimension : {2, 3}) {
    Model model = test::empty_model({-1, -1, dimension == 3 ? -1. : 0}, {3, 3, dimension == 3 ? 3. : 0}, 0.25);
    test::seed_body(model, "block", kSoft, 2, [](const Vec3& X) {
      return X[0] > 0 && X[0] < 2 && X[1] > 0 && X[1] < 2 && X[2] > -1e-9 && X[2] < 2;
    });
    const ContactSurface surface = surface_of(model);
    EXPECT_NEAR(total_area(surface), dimension == 2 ? 8 : 24, dimension == 2 ? 0.4 : 2);
    int on_top = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const Vec3& Y = surface.Y[i];
      const bool inside = Y[0] > 0.4 && Y[0] < 1.6 && (dimension == 2 || (Y[2] > 0.4 && Y[2] < 1.6));
      if (!inside || Y[1] < 1) continue;
      ++on_top;
      EXPECT_NEAR(Y[1], 2, 1e-9);
      EXPECT_NEAR(surface.N[i][1], 1, 1e-9);
      EXPECT_NEAR(surface.area[i], std::pow(0.125, dimension - 1), 0.1 * std::pow(0.125, dimension - 1));
    }
    EXPECT_GE(on_top, dimension == 2 ? 9 : 81);
  }
}

TEST(ContactSurface, IsRoundWhereTheBodyIs) {
  Model model = test::empty_model({-1, -1, 0}, {1, 1, 0}, 0.05);
  test::seed_body(model, "disk", kSoft, 2, [](const Vec3& X) { return std::hypot(X[0], X[1]) < 0.8; });
  const ContactSurface surface = surface_of(model);
  EXPECT_NEAR(total_area(surface), 2 * pi * 0.8, 0.05 * 2 * pi * 0.8);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double r = norm(surface.Y[i]);
    EXPECT_NEAR(r, 0.8, 0.6 * surface.spacing);
    EXPECT_GT(dot(surface.N[i], surface.Y[i]) / r, 0.9);
  }
}

/// A body that knows the boundary that it was cut from has its surface there, whatever its lattice.
TEST(ContactSurface, StandsOnAKnownBoundary) {
  Model disk = test::empty_model({-1, -1, 0}, {1, 1, 0}, 0.05);
  test::seed_body(disk, "disk", kSoft, 2, [](const Vec3& X) { return std::hypot(X[0], X[1]) < 0.8; });
  disk.bodies[0].boundary = prism_mesh(circle_outline({0, 0}, 0.8, 1e-5), 0.025);
  Model ball = test::empty_model({-1, -1, -1}, {1, 1, 1}, 0.2);
  test::seed_body(ball, "ball", kSoft, 2, [](const Vec3& X) { return norm(X) < 0.8; });
  ball.bodies[0].boundary = sphere_mesh({0, 0, 0}, 0.8, 1e-4);
  for (const auto& [model, area, tolerance] :
       {std::tuple(&disk, 2 * pi * 0.8, 2e-5), std::tuple(&ball, 4 * pi * 0.64, 2e-4)}) {
    const ContactSurface surface = surface_of(*model);
    EXPECT_NEAR(total_area(surface), area, 0.05 * area);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      EXPECT_NEAR(norm(surface.Y[i]), 0.8, tolerance);
      EXPECT_NEAR(norm(surface.N[i]), 1, 1e-12);
      EXPECT_GT(dot(surface.N[i], surface.Y[i]), 0.8 * 0.999);
    }
  }
}

/// Shape functions continued to the surface still sum to one and reproduce places.
TEST(ContactSurface, WeightsReproduceItsPlaces) {
  Model model = test::empty_model({-1, -1, -1}, {1, 1, 1}, 0.2);
  test::seed_body(model, "ball", kSoft, 2, [](const Vec3& X) { return norm(X) < 0.8; });
  sort_by_cell(model);
  const TotalBody body = make_total_body(model, model.bodies[0]);
  const ContactSurface surface = find_contact_surface(model, model.bodies[0], body);
  ASSERT_GT(surface.size(), 100u);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    double sum = 0;
    Vec3 place{0, 0, 0};
    for (std::size_t k = 8 * i; k < 8 * i + 8; ++k) {
      sum += surface.weights[k];
      place = place + surface.weights[k] * body.node_positions[surface.nodes[k]];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(norm(place - surface.Y[i]), 0, 1e-12);
  }
}

/// A block falls on one that is held; particles and their spacing differ. In 3D and 2D, either form, either formulation
/// of the one that falls.
class Drop : public testing::TestWithParam<std::tuple<int, BackEnd, Formulation>> {};

Model two_blocks(int dimension, Formulation falling) {
  const double deep = dimension == 3 ? 1 : 0;
  Model model = test::empty_model({0, 0, 0}, {1, 2, deep}, 0.25);
  const auto below = [](const Vec3& X) { return X[1] < 0.5; };
  const auto above = [](const Vec3& X) {
    return X[1] > 0.75 && X[1] < 1.25 && X[0] > 0.25 && X[0] < 0.75 && (X[2] == 0 || (X[2] > 0.25 && X[2] < 0.75));
  };
  test::seed_body(model, "lower", NeoHookean{{1000, 1e5, 0.3}}, 2, below);
  test::seed_body(model, "upper", NeoHookean{{1000, 1e5, 0.3}}, 3, above, [](const Vec3&) { return Vec3{0.3, -1, 0}; });
  model.bodies[1].formulation = falling;
  model.contact.method = ContactMethod::penalty;
  model.contact.friction = 0.3;
  return model;
}

TEST_P(Drop, KeepsMomentumAndEnergyAndGivesForcesThatAreTheImpulse) {
  const auto [dimension, form, falling] = GetParam();
  Model model = two_blocks(dimension, falling);
  SolverOptions options = test::solver(0.5, {0, 0, 0}, 0.1);
  options.back_end = form;
  test::RecordingSink sink;
  const RunReport report = run(model, options, test::output(0.5, 0.01), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  const double mass = dimension == 2 ? 250 : 125;
  Vec3 impulse{0, 0, 0};
  double last = 0;
  for (const HistorySample& s : sink.samples) {
    EXPECT_NEAR(s.momentum[0], 0.3 * mass, 1e-11 * mass);
    EXPECT_NEAR(s.momentum[1], -mass, 1e-11 * mass);
    ASSERT_EQ(s.contact_force.size(), 2u);
    EXPECT_NEAR(norm(s.contact_force[0] + s.contact_force[1]), 0, 1e-9 * norm(s.contact_force[0]));
    impulse = impulse + (s.time - last) * s.contact_force[1];
    last = s.time;
  }
  Vec3 gained{-0.3 * mass, mass, 0};
  for (std::size_t p = model.bodies[1].begin; p < model.bodies[1].end; ++p)
    gained = gained + model.particles.mass[p] * model.particles.velocity[p];
  EXPECT_GT(gained[1], 0.5 * mass);
  EXPECT_NEAR(norm(impulse - gained), 0, 1e-9 * norm(gained));
  EXPECT_GT(report.last.friction, 0);
  // In updated-Lagrangian bodies the springs follow particles, whose velocities are not those that forces do work on.
  const bool updated = falling == Formulation::updated_lagrangian;
  EXPECT_LT(report.largest_energy_error, (updated ? 0.1 : 0.03) * report.first.total);
  EXPECT_LT(report.last.total, 1.001 * report.first.total);
}

INSTANTIATE_TEST_SUITE_P(
    All, Drop,
    testing::Combine(testing::Values(2, 3), testing::Values(BackEnd::nodal, BackEnd::particle_state),
                     testing::Values(Formulation::total_lagrangian, Formulation::updated_lagrangian)));

/// A block falls on a face with friction from a cell above: it bounces, and the impulse is what it has lost.
TEST(ContactFace, StopsABodyThatComesToIt) {
  for (int dimension : {2, 3}) {
    const double deep = dimension == 3 ? 1 : 0;
    Model model = test::empty_model({0, 0, 0}, {3, 2, deep}, 0.25);
    model.domain.faces[2] = Face(FaceCondition::friction, 0.2);
    test::seed_body(
        model, "block", NeoHookean{{1000, 1e5, 0.3}}, 2,
        [](const Vec3& X) { return X[1] > 0.5 && X[1] < 1 && X[0] > 0.5 && X[0] < 1; },
        [](const Vec3&) {
          return Vec3{1, -1, 0};
        });
    model.contact.method = ContactMethod::penalty;
    test::RecordingSink sink;
    double lowest = 1;
    sink.on_frame = [&](const Model& m, double) {
      for (const Vec3& x : m.particles.position) lowest = std::min(lowest, x[1]);
    };
    const RunReport report = run(model, test::solver(1.2, {0, 0, 0}, 0.1), test::output(0.02, 0.02), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    const HistorySample &first = sink.samples.front(), &last = sink.samples.back();
    Vec3 impulse{0, 0, 0};
    double before = 0;
    for (const HistorySample& s : sink.samples) {
      impulse = impulse + (s.time - before) * s.contact_force[0];
      before = s.time;
    }
    EXPECT_GT(last.momentum[1], -0.5 * first.momentum[1]);  // the rest is vibration
    EXPECT_NEAR(norm(last.momentum - first.momentum - impulse), 0, 1e-9 * norm(impulse));
    EXPECT_NEAR(-impulse[0] / impulse[1], 0.2, 0.03);  // slides all the time
    EXPECT_GT(last.friction, 0);
    EXPECT_GT(lowest, 0);
    EXPECT_LT(report.largest_energy_error, 0.04 * report.first.total);
  }
}

/// The prongs of a fork swing towards each other, in the middle between them.
constexpr double kMiddle = 0.7;

Model fork(int dimension, bool self_contact) {
  Model model = test::empty_model({0, 0, 0}, {2, 1.4, dimension == 3 ? 0.3 : 0}, 0.1);
  test::seed_body(
      model, "fork", NeoHookean{{1000, 1e5, 0.3}}, 2,
      [](const Vec3& X) { return X[0] < 0.4 || std::abs(X[1] - kMiddle) > 0.2; },
      [](const Vec3& X) {
        return Vec3{0, X[0] < 0.4 ? 0 : X[1] < kMiddle ? 1. : -1., 0};
      });
  model.contact.method = ContactMethod::penalty;
  model.contact.self_contact = self_contact;
  return model;
}

double farthest_beyond_the_middle(bool self_contact, int dimension, BackEnd form, HistorySample& last,
                                  double& energy_error) {
  Model model = fork(dimension, self_contact);
  SolverOptions options = test::solver(0.5, {0, 0, 0}, 0.2);
  options.back_end = form;
  test::RecordingSink sink;
  double farthest = -1;
  sink.on_frame = [&](const Model& m, double) {
    for (std::size_t p = 0; p < m.particles.size(); ++p) {
      const bool lower = m.particles.reference_position[p][1] < kMiddle;
      const double beyond = (m.particles.position[p][1] - kMiddle) * (lower ? 1 : -1);
      if (m.particles.reference_position[p][0] > 0.4) farthest = std::max(farthest, beyond);
    }
  };
  const RunReport report = run(model, options, test::output(0.02, 0.02), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  last = report.last;
  energy_error = report.largest_energy_error / report.first.total;
  return farthest;
}

TEST(SelfContact, KeepsAForkFromPassingThroughItself) {
  for (int dimension : {2, 3})
    for (BackEnd form : {BackEnd::nodal, BackEnd::particle_state}) {
      HistorySample last;
      double energy_error = 0;
      EXPECT_GT(farthest_beyond_the_middle(false, dimension, form, last, energy_error), 0.05);
      EXPECT_LT(farthest_beyond_the_middle(true, dimension, form, last, energy_error), 0);
      EXPECT_LT(energy_error, 0.02);
      EXPECT_NEAR(norm(last.momentum), 0, 1e-9);
      ASSERT_EQ(last.contact_force.size(), 1u);
      EXPECT_NEAR(norm(last.contact_force[0]), 0, 1e-9) << "what a body does to itself sums to nothing";
    }
}

TEST(SelfContact, RubsAsAPairOfOneBodySays) {
  for (double friction : {0.0, 0.5}) {
    Model model = fork(2, true);
    model.contact.pairs = {{{"fork", "fork"}, {}, friction}};
    for (std::size_t p = 0; p < model.particles.size(); ++p)  // so that the prongs slide over each other
      if (model.particles.reference_position[p][0] > 0.4 && model.particles.reference_position[p][1] < kMiddle)
        model.particles.velocity[p][0] = 1;
    test::RecordingSink sink;
    const RunReport report = run(model, test::solver(0.5, {0, 0, 0}, 0.2), test::output(0.1, 0.1), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    if (friction > 0)
      EXPECT_GT(report.last.friction, 0);
    else
      EXPECT_EQ(report.last.friction, 0);
  }
}

std::string refusal(Model& model, const SolverOptions& options) {
  test::RecordingSink sink;
  try {
    run(model, options, test::output(1, 1), sink, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ContactChecks, RefuseWhatCannotBe) {
  const SolverOptions options = test::solver(0.1, {0, 0, 0});
  Model unknown = two_blocks(2, Formulation::total_lagrangian);
  unknown.contact.pairs = {{{"lower", "uper"}, {}, 0.1}};
  EXPECT_NE(refusal(unknown, options).find("uper"), std::string::npos);
  Model one = two_blocks(2, Formulation::total_lagrangian);
  one.contact.pairs = {{{"lower"}, {}, 0.1}};
  EXPECT_NE(refusal(one, options).find("two"), std::string::npos);
  Model twice = two_blocks(2, Formulation::total_lagrangian);
  twice.contact.pairs = {{{"lower", "lower"}, {}, 0.1}};
  EXPECT_NE(refusal(twice, options).find("twice"), std::string::npos);
  Model updated = two_blocks(2, Formulation::updated_lagrangian);
  updated.bodies[0].formulation = Formulation::updated_lagrangian;
  EXPECT_NE(refusal(updated, options).find("total-Lagrangian"), std::string::npos);
  Model alone = two_blocks(2, Formulation::total_lagrangian);
  alone.contact.method = ContactMethod::none;
  alone.contact.self_contact = true;
  EXPECT_NE(refusal(alone, options).find("self_contact"), std::string::npos);
  Model relaxed = two_blocks(2, Formulation::total_lagrangian);
  SolverOptions relaxing = options;
  relaxing.relax = RelaxOptions{};
  EXPECT_NE(refusal(relaxed, relaxing).find("relax"), std::string::npos);
  Model moving = two_blocks(2, Formulation::total_lagrangian);
  SolverOptions moved = options;
  moved.reference_update = 3;
  EXPECT_NE(refusal(moving, moved).find("reference_update"), std::string::npos);
}

TEST(ContactChecks, RefuseBodiesThatOverlap) {
  Model model = two_blocks(2, Formulation::total_lagrangian);
  for (std::size_t p = model.bodies[0].begin; p < model.bodies[0].end; ++p)
    model.particles.position[p][1] = model.particles.reference_position[p][1] += 0.375;
  EXPECT_NE(refusal(model, test::solver(0.1, {0, 0, 0})).find("overlap"), std::string::npos);
}

/// Of two pairs the bodies' one counts; else that of the materials.
TEST(ContactFriction, IsThatOfThePair) {
  std::vector<double> lost;
  for (const auto& [of_bodies, of_materials] :
       std::vector<std::pair<double, double>>{{0, 0.5}, {-1, 0.5}, {-1, 0}, {0.5, 0}}) {
    Model model = two_blocks(2, Formulation::total_lagrangian);
    model.contact.friction = 0.1;
    if (of_bodies >= 0) model.contact.pairs.push_back({{"upper", "lower"}, {}, of_bodies});
    model.contact.pairs.push_back({{}, {"lower", "upper"}, of_materials});
    test::RecordingSink sink;
    lost.push_back(run(model, test::solver(0.4, {0, 0, 0}), test::output(0.4, 0.4), sink, 1).last.friction);
  }
  EXPECT_EQ(lost[0], 0);
  EXPECT_GT(lost[1], 0);
  EXPECT_EQ(lost[2], 0);
  EXPECT_EQ(lost[3], lost[1]);
}

TEST(ContactThreads, ChangeNoBit) {
  std::vector<std::vector<Vec3>> places;
  for (int threads : {1, 3}) {
    Model model = two_blocks(3, Formulation::total_lagrangian);
    test::RecordingSink sink;
    run(model, test::solver(0.3, {0, 0, 0}), test::output(0.3, 0.3), sink, threads);
    places.push_back(model.particles.position);
  }
  EXPECT_EQ(places[0], places[1]);
}

/// A body that has moved by more than a cell: the kernels also see places without particles, whose nodes stay behind.
TEST(NodalBody, FliesFartherThanACell) {
  Model model = test::empty_model({0, 0, 0}, {3, 1, 0}, 0.05);
  test::seed_body(
      model, "disk", kSoft, 2, [](const Vec3& X) { return std::hypot(X[0] - 0.5, X[1] - 0.5) < 0.3; },
      [](const Vec3&) {
        return Vec3{1, 0, 0};
      });
  test::RecordingSink sink;
  const RunReport report = run(model, test::solver(0.5, {0, 0, 0}), test::output(0.5, 0.05), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  EXPECT_TRUE(report.forms[0].obstacle.empty());
  EXPECT_NEAR(report.last.total, report.first.total, 1e-9 * report.first.total);
}

}  // namespace
}  // namespace scarp
