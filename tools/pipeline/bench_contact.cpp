// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/bench_contact.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/formulations.hpp"
#include "tools/pipeline/bench_block.hpp"
#include "tools/pipeline/fastest.hpp"

namespace scarp {
namespace {

constexpr int kThickness = 10;     // cells of a slab
constexpr double kSpeed = 1;       // m/s, of each towards the other: waves run at 119 m/s
constexpr double kFriction = 0.3;  // Coulomb
constexpr double kSlide = 0.5;     // m/s, of each along the face, so that friction acts

struct ContactCase {
  std::string name;
  Formulation formulation = Formulation::total_lagrangian;
  ShapeFunction shape = ShapeFunction::linear;
  ContactMethod method = ContactMethod::penalty;
};

std::vector<ContactCase> all_cases() {
  constexpr auto updated = Formulation::updated_lagrangian;
  return {{.name = "TL contact, springs"},
          {"UL contact, grid, linear", updated, ShapeFunction::linear, ContactMethod::grid},
          {"UL contact, grid, GIMP", updated, ShapeFunction::gimp, ContactMethod::grid},
          {"UL contact, grid, B-spline", updated, ShapeFunction::quadratic_bspline, ContactMethod::grid}};
}

/// A slab of whole cells, eight points in each, from z = `base`.
void add_slab(Model& model, Formulation formulation, const char* name, int width, double base, const Vec3& velocity) {
  add_block(
      model, name, formulation, {2 * width, 2 * width, 2 * kThickness},
      [&](int i, int j, int k) {
        return Vec3{2.25 + 0.5 * i, 2.25 + 0.5 * j, base + 0.25 + 0.5 * k};
      },
      [&](const Vec3&) { return velocity; });
}

Model slabs(const ContactCase& c, std::int64_t particles) {
  const int width =
      std::max(4, static_cast<int>(std::lround(std::sqrt(static_cast<double>(particles) / (2 * 8 * kThickness)))));
  Model model;
  const double end = width + 4;
  model.domain = {3, 1, {0, 0, 0}, {end, end, 2 * kThickness + 4.0}, {}};
  model.materials = {{"material", NeoHookean{{1900, 20e6, 0.3}}}};
  add_slab(model, c.formulation, "lower", width, 2, {kSlide, 0, kSpeed});
  add_slab(model, c.formulation, "upper", width, 2 + kThickness, {-kSlide, 0, -kSpeed});
  return model;
}

}  // namespace

std::vector<ContactCost> bench_contact(const BenchOptions& options) {
  std::vector<ContactCost> costs;
  for (const ContactCase& c : all_cases()) {
    if (c.name.find(options.only) == std::string::npos) continue;
    ContactCost cost{c.name, options.kernels[0]->name, options.threads[0], 0, 0, 0};
    for (const ContactMethod method : {ContactMethod::none, c.method}) {
      Model model = slabs(c, options.particles);
      model.contact.method = method;
      model.contact.friction = kFriction;
      SolverOptions solver;
      solver.shape = c.shape;
      solver.end_time = 1e9;
      Formulations run(model, solver, options.threads[0], *options.kernels[0]);
      const auto step = [&] { run.step(run.stable_time_step()); };
      for (int i = 0; i < 8; ++i) step();  // until the faces are pressed
      const Times times = fastest(options.steps, [&] {
        for (int i = 0; i < 4; ++i) step();
      });
      const double ns = 1e9 * times.processor / 4 / static_cast<double>(model.particles.size());
      (method == ContactMethod::none ? cost.without_ns : cost.with_ns) = ns;
      cost.particles = static_cast<std::int64_t>(model.particles.size());
    }
    costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace scarp
