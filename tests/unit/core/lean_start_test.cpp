// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model from discretize has no state in memory, only what does not change: every option must start from it, and give
// what it gives from the same model with its state filled in.
#include <gtest/gtest.h>

#include <functional>

#include "solver/core/estimate.hpp"
#include "solver/core/run.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/rigid_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

Model ground() {
  Model model = test::empty_model({0, 0, 0}, {3, 2, 0}, 0.25,
                                  {Condition::roller, Condition::roller, Condition::fixed, Condition::free});
  MohrCoulomb soil{{1800, 20e6, 0.3}, 10e3, 30, 0};
  soil.saturated_density = 2000;
  test::seed_body(model, "ground", soil, 2, [](const Vec3& X) { return X[1] < 1.5 && X[1] < 2.25 - 0.5 * X[0]; });
  return model;
}

WaterTable level_water() {
  WaterTable water;
  water.unit_weight = 9810;
  water.line = {{0, 0.8}};
  return water;
}

struct Start {
  const char* name;
  std::function<void(Model&, SolverOptions&)> change;
};

const Start kStarts[]{
    {"nothing", [](Model&, SolverOptions&) {}},
    {"water table", [](Model& model, SolverOptions&) { model.water = level_water(); }},
    {"K0", [](Model&, SolverOptions& options) { options.k0.emplace(); }},
    {"water table and K0",
     [](Model& model, SolverOptions& options) {
       model.water = level_water();
       options.k0.emplace();
     }},
    {"relaxed",
     [](Model&, SolverOptions& options) {
       options.relax.emplace();
       options.relax->time = 0.01;
     }},
    {"particle state", [](Model&, SolverOptions& options) { options.back_end = BackEnd::particle_state; }},
    {"APIC", [](Model&, SolverOptions& options) { options.transfer = Transfer::apic; }},
    {"XPIC", [](Model&, SolverOptions& options) { options.transfer = Transfer::xpic; }},
    {"moving reference", [](Model&, SolverOptions& options) { options.reference_update = 2.6; }},
    {"F-bar", [](Model&, SolverOptions& options) { options.anti_locking = AntiLocking::f_bar; }},
    {"body force",
     [](Model& model, SolverOptions&) { model.body_force = [](const Vec3& X, double) {
                                          return Vec3{X[1], 0, 0};
                                        }; }},
    {"contact with itself",
     [](Model& model, SolverOptions&) {
       model.contact.method = ContactMethod::penalty;
       model.contact.self_contact = true;
     }},
    {"rigid", [](Model& model, SolverOptions&) {
       RigidOptions wall;
       wall.motion = RigidMotion::fixed;
       model.contact.method = ContactMethod::penalty;
       test::seed_rigid_box(model, "wall", {{2.5, 1, 0}, {2.75, 1.5, 0}}, wall, {0, 0, 0});
     }}};

TEST(LeanStart, GivesWhatACompleteModelGives) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian})
    for (const Start& start : kStarts) {
      SolverOptions options = test::solver(0.02, {0, -9.81, 0}, 0.4, ShapeFunction::linear);
      Model complete = ground();
      complete.bodies[0].formulation = formulation;
      start.change(complete, options);
      const bool for_total_only = options.reference_update || complete.body_force || complete.contact.self_contact;
      if (formulation == Formulation::updated_lagrangian && for_total_only) continue;
      const std::string name = start.name + std::string(", ") + std::string(name_of(formulation));
      SCOPED_TRACE(name);
      complete_state(complete.particles);
      Model lean = complete;
      drop_state(lean.particles);
      EXPECT_EQ(estimate(lean, options, test::output(0.01, 0.01)).time_step,
                estimate(complete, options, test::output(0.01, 0.01)).time_step);
      test::RecordingSink of_complete, of_lean;
      ASSERT_FALSE(run(complete, options, test::output(0.01, 0.01), of_complete, 1).failed);
      ASSERT_FALSE(run(lean, options, test::output(0.01, 0.01), of_lean, 1).failed);
      complete_state(lean.particles);
      EXPECT_EQ(lean.particles.position, complete.particles.position);
      EXPECT_EQ(lean.particles.mass, complete.particles.mass);
      EXPECT_EQ(lean.particles.stress, complete.particles.stress);
      EXPECT_EQ(of_lean.samples.back().total, of_complete.samples.back().total);
    }
}

}  // namespace
}  // namespace scarp
