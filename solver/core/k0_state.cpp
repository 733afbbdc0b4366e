// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/k0_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "solver/core/pore_water.hpp"
#include "solver/materials/elastic_state.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// A particle's part in one column.
struct Slice {
  std::uint64_t column;
  double elevation;
  std::uint32_t particle;
  double share;     ///< of the particle
  double pressure;  ///< of this part on the column's area, Pa
};

/// Bins of one axis in plan.
struct Bins {
  double first = 0, width = 0;
  std::uint64_t count = 1;

  /// f(bin, share of the edge in it).
  template <class F>
  void each(double centre, double edge, F&& f) const {
    constexpr double sliver = 1e-6;
    const double low = (centre - 0.5 * edge - first) / width, high = (centre + 0.5 * edge - first) / width;
    const auto begin = static_cast<std::uint64_t>(std::max(0.0, std::floor(low + sliver)));
    for (std::uint64_t bin = begin; bin < count && static_cast<double>(bin) < high - sliver; ++bin) {
      const double b = static_cast<double>(bin);
      f(bin, (std::min(high, b + 1) - std::max(low, b)) / (high - low));
    }
  }
};

/// Rigid bodies neither bear nor weigh on what deforms here: others have their weight.
bool is_rigid(const Model& model, std::size_t p) {
  return model.bodies[model.particles.body[p]].formulation == Formulation::rigid;
}

double edge_of(const Model& model, std::size_t p) {
  return std::pow(model.particles.reference_volume[p], 1.0 / model.domain.dimension);
}

Bins lay_bins(const Model& model, int axis, double width) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    const double half = 0.5 * edge_of(model, p), x = model.particles.position[p][axis];
    low = std::min(low, x - half);
    high = std::max(high, x + half);
  }
  return {low, width, static_cast<std::uint64_t>(std::ceil((high - low) / width - 1e-6)) + 1};
}

std::vector<Slice> slice(const Model& model, double gravity) {
  const int D = model.domain.dimension;
  const Particles& particles = model.particles;
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < particles.size(); ++p) width = std::min(width, edge_of(model, p));
  const Bins x = lay_bins(model, 0, width), y = D == 3 ? lay_bins(model, 1, width) : Bins{-0.5, 1, 1};
  const double area = D == 3 ? width * width : width;
  std::vector<Slice> slices;
  slices.reserve(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (is_rigid(model, p)) continue;
    const double edge = edge_of(model, p);
    double weight = particles.mass[p] * gravity;
    if (model.water)
      weight -= submerged_share(*model.water, particles.position[p], edge, D) * particles.reference_volume[p] *
                model.water->unit_weight;
    y.each(D == 3 ? particles.position[p][1] : 0, D == 3 ? edge : 1, [&](std::uint64_t j, double part_y) {
      x.each(particles.position[p][0], edge, [&](std::uint64_t i, double part_x) {
        const double share = part_x * part_y;
        slices.push_back({j * x.count + i, particles.position[p][D - 1], static_cast<std::uint32_t>(p), share,
                          share * weight / area});
      });
    });
  }
  return slices;
}

double ratio_of(const NamedMaterial& material, const K0Options& k0) {
  if (k0.ratio) return *k0.ratio;
  return std::visit(
      [&](const auto& m) {
        if constexpr (requires { m.friction_angle; })
          if (const std::optional<double> angle = m.friction_angle; angle && k0.rule == K0Rule::jaky)
            return 1 - std::sin(*angle * std::numbers::pi / 180);
        if constexpr (requires { m.poissons_ratio; }) return m.poissons_ratio / (1 - m.poissons_ratio);
        return 1.0;  // what has neither bears no shear
      },
      material.law);
}

void refuse_stress(const Model& model, std::size_t p, double ratio, double pressure) {
  throw Error("solve",
              "the k0 stress of particle " + std::to_string(model.particles.id[p]) + ", which material '" +
                  model.materials[model.particles.material[p]].name + "' cannot bear at rest",
              "K0 = " + shortest(ratio) + " under " + shortest(pressure) + " Pa", "a ratio within its strength");
}

}  // namespace

std::vector<double> vertical_effective_pressure(const Model& model, double gravity) {
  std::vector<Slice> slices = slice(model, gravity);
  std::sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
    if (a.column != b.column) return a.column < b.column;
    if (a.elevation != b.elevation) return a.elevation > b.elevation;
    return a.particle < b.particle;
  });
  std::vector<double> pressure(model.particles.size(), 0);
  double above = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (i > 0 && slices[i].column != slices[i - 1].column) above = 0;
    pressure[slices[i].particle] += slices[i].share * (above + 0.5 * slices[i].pressure);
    above += slices[i].pressure;
  }
  return pressure;
}

void set_k0_stress(Model& model, const SolverOptions& options, int threads) {
  if (!options.k0) return;
  const int D = model.domain.dimension;
  const double gravity = vertical_gravity(options, D, "k0");
  if (options.gravity_ramp > 0)
    throw Error("solve", "gravity_ramp with k0, whose stress bears all of gravity",
                shortest(options.gravity_ramp) + " s", "0 s");
  std::vector<double> ratios;
  std::vector<PreparedLaw> laws;
  for (const NamedMaterial& material : model.materials) {
    ratios.push_back(ratio_of(material, *options.k0));
    laws.push_back(prepare(material.law, model.domain.cell));
  }
  complete_state(model.particles);
  const std::vector<double> pressure = vertical_effective_pressure(model, gravity);
  Particles& particles = model.particles;
  std::vector<std::uint8_t> borne(particles.size(), 1);
  parallel_for(particles.size(), threads, [&](std::size_t p) {
    if (is_rigid(model, p)) return;
    const double v = std::max(0.0, pressure[p]), h = ratios[particles.material[p]] * v;
    Vec3 stress{-h, -h, -h};
    stress[D - 1] = -v;
    const std::optional<ElasticState> state = elastic_state(laws[particles.material[p]], stress);
    borne[p] = state.has_value();
    if (!state) return;
    particles.stress[p] = {stress[0], stress[1], stress[2], 0, 0, 0};
    particles.deformation_gradient[p] = state->F;
    particles.elastic_left_cauchy_green[p] = state->history.elastic_left_cauchy_green;
  });
  for (std::size_t p = 0; p < particles.size(); ++p)
    if (!borne[p]) refuse_stress(model, p, ratios[particles.material[p]], pressure[p]);
}

}  // namespace scarp
