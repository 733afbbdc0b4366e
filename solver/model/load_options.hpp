// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/body_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// A start at rest under gravity, sought by damped motion before t = 0.
struct RelaxOptions {
  double until = 1e-6;
  std::optional<double> time;
  double damping = 0.7;

  template <class V>
  void describe(V&& v) {
    v("until", until,
      Spec{.text =
               "at rest once the kinetic energy stays below this share of its largest so far, for as long as a wave "
               "takes across the domain",
           .above = 0,
           .below = 1});
    v("time", time, Spec{.text = "relax for this long instead", .unit = "s", .above = 0});
    v("damping", damping, Spec{.text = "local damping factor while relaxing", .above = 0, .below = 1});
  }
};

/// A face of the domain, in the order of Domain::faces.
enum class FaceName { x_min, x_max, y_min, y_max, z_min, z_max };
template <>
struct enum_names<FaceName> {
  static constexpr std::array<std::pair<std::string_view, FaceName>, 6> value{{{"x_min", FaceName::x_min},
                                                                               {"x_max", FaceName::x_max},
                                                                               {"y_min", FaceName::y_min},
                                                                               {"y_max", FaceName::y_max},
                                                                               {"z_min", FaceName::z_min},
                                                                               {"z_max", FaceName::z_max}}};
};

/// What is in all that is given.
struct LoadRegion {
  std::optional<BoxShape> box;
  std::optional<FaceName> face;
  std::optional<std::string> body;

  template <class V>
  void describe(V&& v) {
    v("box", box,
      Spec{.text = "a box (2D: rectangle) in the reference configuration; it may be flat to name a plane of nodes"});
    v("face", face, Spec{.text = "what stands on a face of the domain: \"x_min\" to \"z_max\""});
    v("body", body,
      Spec{.text = "one body of all; nodes of updated-Lagrangian bodies are nobody's own and do not know it"});
  }
};

/// Something that acts on a part of the bodies in time: one of velocity, displacement, traction and force.
struct LoadOptions {
  std::string name;
  LoadRegion where;
  std::optional<Vec3> velocity;
  std::optional<Vec3> displacement;
  std::string axes = "xyz";
  std::optional<Vec3> traction;
  std::optional<Vec3> force;
  std::vector<Vec2> table;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "what messages call it"});
    v("where", where, Spec{.text = "on which nodes or particles", .required = true});
    v("velocity", velocity,
      Spec{.text = "imposed on the grid's nodes in the region; in updated-Lagrangian bodies these stand in space, and "
                   "move whatever comes by",
           .unit = "m/s"});
    v("displacement", displacement,
      Spec{.text = "imposed on the same nodes, exactly at every step; needs a table that is 0 at time 0", .unit = "m"});
    v("axes", axes, Spec{.text = "along which axes the velocity or displacement is imposed, of \"xyz\""});
    v("traction", traction,
      Spec{.text = "on the surface particles in the region, each of which stands for the face of its volume; of fixed "
                   "direction and reference area",
           .unit = "Pa"});
    v("force", force, Spec{.text = "shared by the particles in the region in proportion to their mass", .unit = "N"});
    v("table", table,
      Spec{.text = "rows [time in s, factor], times rising: linear between rows, constant beyond; default: factor 1"});
  }
};

}  // namespace scarp
