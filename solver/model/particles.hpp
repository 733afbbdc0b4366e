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

/// What does not change: f(name, unit, member, default).
template <class F>
void for_each_constant(F&& f) {
  f("id", "1", &Particles::id, std::int64_t{0});
  f("body", "1", &Particles::body, std::int32_t{0});
  f("material", "1", &Particles::material, std::int32_t{0});
  f("surface", "1", &Particles::surface, std::uint8_t{0});
  f("colour", "1", &Particles::colour, Rgb8{0, 0, 0});
  f("mass", "kg", &Particles::mass, 0.0);
  f("reference_volume", "m3", &Particles::reference_volume, 0.0);
  f("reference_position", "m", &Particles::reference_position, Vec3{0, 0, 0});
}

/// The state, which is most of a particle's bytes. A field of it may be empty: then all particles have its default, and
/// stand at their reference positions. So do models come from discretize and from disk; see also run.hpp.
template <class F>
void for_each_of_state(F&& f) {
  f("position", "m", &Particles::position, Vec3{0, 0, 0});
  f("velocity", "m/s", &Particles::velocity, Vec3{0, 0, 0});
  f("deformation_gradient", "1", &Particles::deformation_gradient, kIdentity);
  f("stress", "Pa", &Particles::stress, Sym6{0, 0, 0, 0, 0, 0});
  f("elastic_left_cauchy_green", "1", &Particles::elastic_left_cauchy_green, Sym6{1, 1, 1, 0, 0, 0});
  f("equivalent_plastic_strain", "1", &Particles::equivalent_plastic_strain, 0.0);
  f("plastic_work", "J/m3", &Particles::plastic_work, 0.0);
  f("hardening", "1", &Particles::hardening, 0.0);
}

/// THE field list, of those two: f(name, unit, vector, default). Resize, permute, write, read, checksum and finiteness
/// checks iterate it; a new field is one member and one line above.
template <class P, class F>
void for_each_field(P&& p, F&& f) {
  const auto with = [&](const char* name, const char* unit, auto member, const auto& initial) {
    f(name, unit, p.*member, initial);
  };
  for_each_constant(with);
  for_each_of_state(with);
}

/// Grows or shrinks what does not change.
inline void resize_constants(Particles& particles, std::size_t count) {
  for_each_constant(
      [&](const char*, const char*, auto member, const auto& initial) { (particles.*member).resize(count, initial); });
}

/// Grows or shrinks every field; new entries get the field's default.
inline void resize_particles(Particles& particles, std::size_t count) {
  for_each_field(particles,
                 [&](const char*, const char*, auto& values, const auto& initial) { values.resize(count, initial); });
}

/// Where the particles are: at their reference positions where they have no state yet.
inline const std::vector<Vec3>& current_positions(const Particles& particles) {
  return particles.position.empty() ? particles.reference_position : particles.position;
}

/// Fills the fields of the state that are empty.
inline void complete_state(Particles& particles) {
  if (particles.position.empty()) particles.position = particles.reference_position;
  for_each_of_state([&](const char*, const char*, auto member, const auto& initial) {
    if ((particles.*member).empty()) (particles.*member).resize(particles.size(), initial);
  });
}

/// Gives the memory of the state back.
inline void drop_state(Particles& particles) {
  for_each_of_state([&](const char*, const char*, auto member, const auto&) {
    std::remove_reference_t<decltype(particles.*member)>().swap(particles.*member);
  });
}

/// Makes `block` particles [begin, end), with the fields that there are.
inline void copy_particles(const Particles& particles, std::size_t begin, std::size_t end, Particles& block) {
  const auto copy = [&](const char*, const char*, auto member, const auto&) {
    const auto& from = particles.*member;
    if (from.empty())
      (block.*member).clear();
    else
      (block.*member)
          .assign(from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for_each_constant(copy);
  for_each_of_state(copy);
}

/// Reorders every field that there is: entry i becomes what stood at order[i].
inline void permute_particles(Particles& particles, const std::vector<std::size_t>& order) {
  for_each_field(particles, [&](const char*, const char*, auto& values, const auto&) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> moved;
    moved.reserve(order.size());
    for (std::size_t i : order) moved.push_back(values[i]);
    values = std::move(moved);
  });
}

}  // namespace scarp
