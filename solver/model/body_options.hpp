// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/domain.hpp"
#include "solver/model/math.hpp"
#include "solver/model/rigid_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

enum class Formulation { total_lagrangian, updated_lagrangian, rigid };
template <>
struct enum_names<Formulation> {
  static constexpr std::array<std::pair<std::string_view, Formulation>, 3> value{
      {{"total-lagrangian", Formulation::total_lagrangian},
       {"updated-lagrangian", Formulation::updated_lagrangian},
       {"rigid", Formulation::rigid}}};
};

/// How an open terrain surface becomes a solid.
enum class Closing { plane, depth, surface };
template <>
struct enum_names<Closing> {
  static constexpr std::array<std::pair<std::string_view, Closing>, 3> value{
      {{"plane", Closing::plane}, {"depth", Closing::depth}, {"surface", Closing::surface}}};
};

/// The ground below a scanned surface: TIN on top, a base below, a vertical skirt on the outline.
struct ScanVolume {
  static constexpr std::string_view name = "scan";
  std::string scan;
  Closing close = Closing::plane;
  std::optional<double> depth;
  std::optional<double> base_elevation;
  std::optional<std::string> base_scan;
  std::vector<Vec2> outline;
  double longest_edge = 0;
  Condition base = Condition::fixed;
  bool hold_skirt = false;

  template <class V>
  void describe(V&& v) {
    v("scan", scan, Spec{.text = "name of the scan whose surface is the top", .required = true});
    v("close", close,
      Spec{.text =
               "base: a horizontal plane, a fixed depth below the surface, or the surface of another scan, as where "
               "two surveys or a slip surface bound a released mass"});
    v("depth", depth,
      Spec{.text = "vertical depth of the base below the surface, for close = \"depth\"", .unit = "m", .above = 0});
    v("base_elevation", base_elevation,
      Spec{.text = "elevation of the base, for close = \"plane\"", .unit = "m", .role = Role::elevation});
    v("base_scan", base_scan,
      Spec{.text = "name of the scan whose surface is the base, for close = \"surface\"; where it is above the top, or "
                   "one of them is not, nothing is filled"});
    v("outline", outline,
      Spec{.text = "polygon in plan that bounds the solid; default: the extent of the TIN",
           .unit = "m",
           .role = Role::position});
    v("longest_edge", longest_edge,
      Spec{.text = "triangles at the border of the top's TIN with a longer plan edge are left out; 0 keeps all",
           .unit = "m",
           .at_least = 0});
    v("base", base, Spec{.text = "what the ground below the base does to the nodes there"});
    v("hold_skirt", hold_skirt,
      Spec{.text = "whether the ground beyond the outline holds the nodes there, as where a scan ends raggedly"});
  }
};

struct BoxShape {
  Vec3 min{0, 0, 0};
  Vec3 max{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("min", min, Spec{.text = "lower corner", .unit = "m", .required = true, .role = Role::position});
    v("max", max, Spec{.text = "upper corner", .unit = "m", .required = true, .role = Role::position});
  }
};

/// A disk (2D) or sphere (3D).
struct BallShape {
  Vec3 centre{0, 0, 0};
  double radius = 0;
  template <class V>
  void describe(V&& v) {
    v("centre", centre, Spec{.text = "centre", .unit = "m", .required = true, .role = Role::position});
    v("radius", radius, Spec{.text = "radius", .unit = "m", .above = 0, .required = true});
  }
};

struct BoxVolume {
  static constexpr std::string_view name = "box";
  BoxShape box;
  template <class V>
  void describe(V&& v) {
    v("box", box, Spec{.text = "an axis-aligned box (2D: rectangle)", .required = true});
  }
};
struct DiskVolume {
  static constexpr std::string_view name = "disk";
  BallShape disk;
  template <class V>
  void describe(V&& v) {
    v("disk", disk, Spec{.text = "a disk (2D only)", .required = true});
  }
};
struct SphereVolume {
  static constexpr std::string_view name = "sphere";
  BallShape sphere;
  template <class V>
  void describe(V&& v) {
    v("sphere", sphere, Spec{.text = "a sphere (3D only)", .required = true});
  }
};
struct PolygonVolume {
  static constexpr std::string_view name = "polygon";
  std::vector<Vec2> polygon;
  template <class V>
  void describe(V&& v) {
    v("polygon", polygon,
      Spec{.text = "corners of a simple polygon (2D only)", .unit = "m", .required = true, .role = Role::position});
  }
};
struct MeshVolume {
  static constexpr std::string_view name = "mesh";
  InputFile mesh;
  template <class V>
  void describe(V&& v) {
    v("mesh", mesh, Spec{.text = "closed triangle mesh: PLY, OBJ or STL (3D only)", .required = true});
  }
};

using Volume = std::variant<ScanVolume, BoxVolume, DiskVolume, SphereVolume, PolygonVolume, MeshVolume>;
template <>
struct choice_key<Volume> {
  static constexpr std::string_view value = "";
};

/// Rules that give single points another material than their body's; later rules win.
struct BoxRule {
  static constexpr std::string_view name = "box";
  BoxShape box;
  std::string use;
  template <class V>
  void describe(V&& v) {
    v("box", box, Spec{.text = "points inside this box", .required = true});
    v("use", use, Spec{.text = "material of the points that the rule takes", .required = true});
  }
};
struct PrismRule {
  static constexpr std::string_view name = "prism";
  std::vector<Vec2> prism;
  std::string use;
  template <class V>
  void describe(V&& v) {
    v("prism", prism,
      Spec{.text = "points inside this polygon in plan (x, y), at any height",
           .unit = "m",
           .required = true,
           .role = Role::position});
    v("use", use, Spec{.text = "material of the points that the rule takes", .required = true});
  }
};
struct BelowRule {
  static constexpr std::string_view name = "below";
  InputFile below;
  std::string use;
  template <class V>
  void describe(V&& v) {
    v("below", below, Spec{.text = "points below this surface (ESRI ASCII grid or GeoTIFF)", .required = true});
    v("use", use, Spec{.text = "material of the points that the rule takes", .required = true});
  }
};
struct ClassRule {
  static constexpr std::string_view name = "class";
  int asprs_class = 0;
  std::string use;
  template <class V>
  void describe(V&& v) {
    v("class", asprs_class,
      Spec{.text = "points whose nearest scan point has this ASPRS class",
           .at_least = 0,
           .at_most = 255,
           .required = true});
    v("use", use, Spec{.text = "material of the points that the rule takes", .required = true});
  }
};

using MaterialRule = std::variant<BoxRule, PrismRule, BelowRule, ClassRule>;
template <>
struct choice_key<MaterialRule> {
  static constexpr std::string_view value = "";
};

struct BodyOptions {
  std::string name;
  Volume volume;
  int points_per_cell = 0;
  std::optional<double> cell;
  std::string material;
  std::vector<MaterialRule> materials;
  Vec3 velocity{0, 0, 0};
  std::vector<std::string> velocity_field;
  Formulation formulation = Formulation::total_lagrangian;
  std::optional<RigidOptions> rigid;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "name of the body", .required = true});
    v("volume", volume, Spec{.text = "the space that the body fills", .required = true});
    v("points_per_cell", points_per_cell,
      Spec{.text = "material points in a full cell: n squared in 2D, n cubed in 3D; 0 means 4 and 8",
           .at_least = 0,
           .at_most = 1000});
    v("cell", cell,
      Spec{.text = "cell of the body's reference grid; default: that of the domain", .unit = "m", .above = 0});
    v("material", material, Spec{.text = "name of its material", .required = true});
    v("materials", materials, Spec{.text = "rules that give single points another material; later rules win"});
    v("velocity", velocity,
      Spec{.text = "initial velocity; of a rigid body whose motion is given, that of its motion", .unit = "m/s"});
    v("velocity_field", velocity_field,
      Spec{.text = "added to it: m/s, a formula of X, Y, Z (m) and pi per axis, such as \"0.1 * sin(pi * X / 50)\""});
    v("formulation", formulation,
      Spec{.text =
               "configuration in which the weights are taken: \"total-lagrangian\", the reference one, on a grid of "
               "the body's own; \"updated-lagrangian\", the current one, on the domain's grid, where such bodies "
               "meet and stick, part and flow without limit; \"rigid\": none, the body does not deform, and `rigid` "
               "says how it moves"});
    v("rigid", rigid, Spec{.text = "motion and surface of a body with formulation = \"rigid\""});
  }
};

}  // namespace scarp
