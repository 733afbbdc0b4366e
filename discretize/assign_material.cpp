// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/assign_material.hpp"

#include <algorithm>
#include <cmath>

#include "discretize/plan_polygon.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

std::int32_t material_index(const Model& model, const std::string& name, const std::string& who) {
  for (std::size_t m = 0; m < model.materials.size(); ++m)
    if (model.materials[m].name == name) return static_cast<std::int32_t>(m);
  std::string known;
  for (const NamedMaterial& material : model.materials) known += (known.empty() ? "" : ", ") + material.name;
  throw Error("discretize", who + ": unknown material", "'" + name + "'", known.empty() ? "none is defined" : known);
}

/// One body while its rules run.
struct Assignment {
  const RuleContext& context;
  const Body& body;
  Particles& particles;
  int threads;
  VolumeReport& report;
  std::string who;
  std::int32_t use = 0;

  template <class Takes>
  void where(Takes&& takes) {
    parallel_for(body.end - body.begin, threads, [&](std::size_t n) {
      if (takes(n, particles.reference_position[body.begin + n])) particles.material[body.begin + n] = use;
    });
  }

  void operator()(const BoxRule& rule) {
    const int dimension = context.dimension;
    where([&](std::size_t, const Vec3& p) {
      for (int a = 0; a < dimension; ++a)
        if (!(rule.box.min[a] <= p[a] && p[a] < rule.box.max[a])) return false;
      return true;
    });
  }

  void operator()(const PrismRule& rule) {
    const PlanPolygon polygon(rule.prism, who + ": prism");
    where([&](std::size_t, const Vec3& p) { return polygon.contains(p[0], p[1]); });
  }

  void operator()(const BelowRule& rule) {
    if (context.dimension != 3)
      throw Error("discretize", who + ": a surface in plan needs three dimensions", "dimension = 2", "dimension = 3");
    const auto found = context.surfaces.find(rule.below.path);
    if (found == context.surfaces.end())
      throw Error("discretize", who + ": surface not loaded", "'" + rule.below.path + "'", "a surface that was read");
    const Heightfield& surface = found->second;
    const std::size_t count = body.end - body.begin;
    std::vector<std::size_t> beside((count + kReductionBlock - 1) / kReductionBlock, 0);
    parallel_for(beside.size(), threads, [&](std::size_t b) {
      for (std::size_t p = body.begin + b * kReductionBlock;
           p < std::min(body.end, body.begin + (b + 1) * kReductionBlock); ++p) {
        const Vec3& x = particles.reference_position[p];
        const double height = height_at(surface, x[0], x[1]);
        beside[b] += std::isnan(height);
        if (x[2] < height) particles.material[p] = use;
      }
    });
    for (std::size_t n : beside) report.points_beside_rule_surface += n;
  }

  void operator()(const ClassRule& rule) {
    if (context.scan == nullptr)
      throw Error("discretize", who + ": a class rule needs a body made from a scan", "no scan",
                  "volume = { scan = ... }");
    if (context.scan->classification.empty())
      throw Error("discretize", who + ": a class rule needs a classified scan", "a scan without classes",
                  "a LAS or LAZ file with a classification");
    where([&](std::size_t n, const Vec3&) {
      return context.scan->classification[context.scan_points[n]] == rule.asprs_class;
    });
  }
};

/// Masses, stresses at rest, and the volumes by material: all points of a body have one volume, so counting is exact.
void weigh(const Body& body, int threads, Model& model, VolumeReport& report) {
  Particles& particles = model.particles;
  std::vector<double> density;
  std::vector<Sym6> stress;
  for (const NamedMaterial& material : model.materials) {
    density.push_back(density_of(material.law));
    stress.push_back(rest_stress(material.law));
  }
  constexpr Sym6 none{0, 0, 0, 0, 0, 0};
  if (std::any_of(stress.begin(), stress.end(), [&](const Sym6& s) { return s != none; }))
    particles.stress.resize(particles.size(), none);
  parallel_for(body.end - body.begin, threads, [&](std::size_t n) {
    const std::size_t p = body.begin + n;
    particles.mass[p] = density[particles.material[p]] * particles.reference_volume[p];
    if (!particles.stress.empty()) particles.stress[p] = stress[particles.material[p]];
  });
  std::vector<std::size_t> count(model.materials.size(), 0);
  for (std::size_t p = body.begin; p < body.end; ++p) ++count[particles.material[p]];
  const double volume = body.end > body.begin ? particles.reference_volume[body.begin] : 0;
  report.particle_volume = static_cast<double>(body.end - body.begin) * volume;
  for (std::size_t m = 0; m < count.size(); ++m)
    if (count[m] > 0)
      report.volume_by_material.emplace_back(model.materials[m].name, static_cast<double>(count[m]) * volume);
}

}  // namespace

bool needs_scan_points(const BodyOptions& options) {
  return std::any_of(options.materials.begin(), options.materials.end(),
                     [](const MaterialRule& rule) { return std::holds_alternative<ClassRule>(rule); });
}

void assign_materials(const BodyOptions& options, const RuleContext& context, std::size_t body, int threads,
                      Model& model, VolumeReport& report) {
  const Body& points = model.bodies[body];
  const std::string who = "body '" + options.name + "'";
  const std::int32_t own = material_index(model, options.material, who);
  std::fill(model.particles.material.begin() + static_cast<std::ptrdiff_t>(points.begin),
            model.particles.material.begin() + static_cast<std::ptrdiff_t>(points.end), own);
  for (std::size_t r = 0; r < options.materials.size(); ++r)
    std::visit(
        [&](const auto& rule) {
          const std::string rule_name = who + ", material rule " + std::to_string(r + 1);
          Assignment assign{
              context, points, model.particles, threads, report, rule_name, material_index(model, rule.use, rule_name)};
          assign(rule);
        },
        options.materials[r]);
  weigh(points, threads, model, report);
}

}  // namespace scarp
