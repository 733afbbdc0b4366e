// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// The material points of all bodies, one array per field. A body owns a contiguous range.
struct Particles {
  std::vector<std::int64_t> id;                 ///< place in the order of seeding; survives every sort
  std::vector<std::int32_t> body;               ///< index into Model::bodies
  std::vector<std::int32_t> material;           ///< index into Model::materials
  std::vector<std::uint8_t> surface;            ///< 1: borders the free surface that a scan would see
  std::vector<Rgb8> colour;                     ///< colour of the nearest scan point; black without a scan
  std::vector<double> mass;                     ///< kg (2D: per metre of thickness)
  std::vector<double> reference_volume;         ///< V0, m3 (2D: m2 x 1 m)
  std::vector<Vec3> reference_position;         ///< X, m, local
  std::vector<Vec3> position;                   ///< x, m, local
  std::vector<Vec3> velocity;                   ///< m/s
  std::vector<Mat3> deformation_gradient;       ///< F = dx/dX
  std::vector<Sym6> stress;                     ///< Cauchy, Pa, tension positive
  std::vector<Sym6> elastic_left_cauchy_green;  ///< b_e, history of the finite-strain return maps
  std::vector<double> equivalent_plastic_strain;
  std::vector<double> plastic_work;  ///< dissipated per reference volume, J/m3
  std::vector<double> hardening;     ///< one more internal variable, of the laws that have one; see the law

  std::size_t size() const { return id.size(); }
};

/// THE field list: f(name, unit, vector, default). Resize, permute, write, read, checksum and finiteness
/// checks iterate it; a new field is one member above and one line here.
template <class P, class F>
void for_each_field(P&& p, F&& f) {
  constexpr Sym6 unit_tensor{1, 1, 1, 0, 0, 0};
  f("id", "1", p.id, std::int64_t{0});
  f("body", "1", p.body, std::int32_t{0});
  f("material", "1", p.material, std::int32_t{0});
  f("surface", "1", p.surface, std::uint8_t{0});
  f("colour", "1", p.colour, Rgb8{0, 0, 0});
  f("mass", "kg", p.mass, 0.0);
  f("reference_volume", "m3", p.reference_volume, 0.0);
  f("reference_position", "m", p.reference_position, Vec3{0, 0, 0});
  f("position", "m", p.position, Vec3{0, 0, 0});
  f("velocity", "m/s", p.velocity, Vec3{0, 0, 0});
  f("deformation_gradient", "1", p.deformation_gradient, kIdentity);
  f("stress", "Pa", p.stress, Sym6{0, 0, 0, 0, 0, 0});
  f("elastic_left_cauchy_green", "1", p.elastic_left_cauchy_green, unit_tensor);
  f("equivalent_plastic_strain", "1", p.equivalent_plastic_strain, 0.0);
  f("plastic_work", "J/m3", p.plastic_work, 0.0);
  f("hardening", "1", p.hardening, 0.0);
}

/// Grows or shrinks every field; new entries get the field's default.
inline void resize_particles(Particles& particles, std::size_t count) {
  for_each_field(particles,
                 [&](const char*, const char*, auto& values, const auto& initial) { values.resize(count, initial); });
}

/// Reorders every field: entry i becomes what stood at order[i].
inline void permute_particles(Particles& particles, const std::vector<std::size_t>& order) {
  for_each_field(particles, [&](const char*, const char*, auto& values, const auto&) {
    std::remove_reference_t<decltype(values)> moved;
    moved.reserve(order.size());
    for (std::size_t i : order) moved.push_back(values[i]);
    values = std::move(moved);
  });
}

}  // namespace scarp
