// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// How a rigid body moves.
enum class RigidMotion { fixed, given, free };
template <>
struct enum_names<RigidMotion> {
  static constexpr std::array<std::pair<std::string_view, RigidMotion>, 3> value{
      {{"fixed", RigidMotion::fixed}, {"given", RigidMotion::given}, {"free", RigidMotion::free}}};
};

/// What a rigid body's surface does to what touches it: rough, it sticks; or Coulomb's friction.
struct RigidSurface {
  bool rough = false;
  double friction = 0;

  bool operator==(const RigidSurface&) const = default;
  template <class V>
  void describe(V&& v) {
    v("friction", friction, Spec{.text = "Coulomb coefficient", .at_least = 0, .required = true});
  }
};
/// A surface is a name, or { friction = 0.4 }.
template <>
struct short_names<RigidSurface> {
  static constexpr std::array<std::pair<std::string_view, RigidSurface>, 2> value{
      {{"rough", RigidSurface{true, 0}}, {"smooth", RigidSurface{false, 0}}}};
  static constexpr RigidSurface table{false, 0};
};

/// What makes a rigid body of a volume. Its velocity is that of the body.
struct RigidOptions {
  RigidMotion motion = RigidMotion::fixed;
  double angular_velocity = 0;
  std::optional<Vec3> axis;
  std::optional<Vec3> about;
  std::vector<Vec2> table;
  RigidSurface surface{true, 0};
  std::vector<std::string> grips;

  template <class V>
  void describe(V&& v) {
    v("motion", motion,
      Spec{.text = "\"fixed\": stands still; \"given\": moves with the body's velocity and with angular_velocity, "
                   "whatever it meets; \"free\": starts with these and obeys gravity and contact, with mass and "
                   "moments of inertia of its volume; needs contact.method = \"penalty\"",
           .required = true});
    v("angular_velocity", angular_velocity,
      Spec{.text = "about the axis, in radians; in plane strain counter-clockwise; of a free body at the start",
           .unit = "1/s"});
    v("axis", axis, Spec{.text = "direction of the axis of rotation, through `about` (3D only); default: z"});
    v("about", about,
      Spec{.text = "a point of the axis at the start, which moves with the body's velocity; default: the centre of the "
                   "body's bounds; a free body turns about its centre of mass",
           .unit = "m",
           .role = Role::position});
    v("table", table,
      Spec{.text = "rows [time in s, factor], times rising, by which both velocities are multiplied: linear between "
                   "rows, constant beyond; default: factor 1"});
    v("surface", surface,
      Spec{.text =
               "\"rough\": what touches it sticks; \"smooth\": slides; { friction = 0.4 }: after Coulomb. With "
               "contact.method = \"penalty\" this holds for what presses on it, and contact.pairs go before it; of two "
               "rigid bodies the smoother counts; else "
               "for the nodes of updated-Lagrangian bodies that lie in it or within half a cell of it: in one that "
               "is rough they have its velocity, other ones they do not enter"});
    v("grips", grips,
      Spec{.text = "names of total-Lagrangian bodies that it holds: their nodes that lie in it, or on its surface, at "
                   "the start move with it"});
  }
};

}  // namespace scarp
