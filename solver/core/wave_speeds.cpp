// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/wave_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/linear_cell.hpp"
#include "solver/materials/law.hpp"

namespace scarp {
namespace {

template <int D>
void add_momenta(std::vector<Vec2>& sums, const Model& model, const ReferenceGrid& grid, std::size_t begin,
                 const std::vector<Vec2>& speeds) {
  using Cell = LinearCell<D>;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    typename Cell::Values m, of_cell[2]{};
    for (std::size_t p = grid.cell_begin[c]; p < grid.cell_begin[c + 1]; ++p) {
      Cell::monomials(grid.place(c, p - begin, model.particles.reference_position[p]), m);
      for (int i = 0; i < 2; ++i)
        Cell::add_value(of_cell[i], m, model.particles.mass[p] * wave_speeds_of(model, speeds, p)[i]);
    }
    for (int i = 0; i < 2; ++i) {
      Cell::to_corners(of_cell[i]);
      for (int k = 0; k < Cell::N; ++k) sums[grid.cell_nodes[c * Cell::N + k]][i] += of_cell[i][k];
    }
  }
}

}  // namespace

bool has_absorbing_face(const Domain& domain) {
  return std::any_of(domain.faces.begin(), domain.faces.end(),
                     [](const Face& face) { return face.condition == FaceCondition::absorbing; });
}

std::vector<Vec2> material_wave_speeds(const Model& model) {
  std::vector<Vec2> speeds;
  for (const NamedMaterial& material : model.materials)
    speeds.push_back(std::visit(
        [](const auto& m) {
          return Vec2{m.wave_speed(), m.shear_wave_speed()};
        },
        material.law));
  return speeds;
}

Vec2 wave_speeds_of(const Model& model, const std::vector<Vec2>& of_materials, std::size_t p) {
  const std::int32_t material = model.particles.material[p];
  const double density = std::visit([](const auto& m) { return m.density; }, model.materials[material].law);
  const double heavier = model.particles.mass[p] / (density * model.particles.reference_volume[p]);
  const Vec2& speeds = of_materials[material];
  return {speeds[0] / std::sqrt(heavier), speeds[1] / std::sqrt(heavier)};
}

std::vector<Vec2> node_wave_speeds(const Model& model, const ReferenceGrid& grid, std::size_t begin) {
  std::vector<Vec2> speeds(grid.nodes.size(), Vec2{0, 0});
  const std::vector<Vec2> of_materials = material_wave_speeds(model);
  grid.dimension == 2 ? add_momenta<2>(speeds, model, grid, begin, of_materials)
                      : add_momenta<3>(speeds, model, grid, begin, of_materials);
  for (std::size_t i = 0; i < speeds.size(); ++i)
    for (double& c : speeds[i]) c /= grid.node_mass[i];
  return speeds;
}

}  // namespace scarp
