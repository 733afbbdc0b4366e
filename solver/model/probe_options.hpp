// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "solver/model/body_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// Where a probe looks for its material points: where they are now, or where they were in the reference configuration.
enum class ProbePlace { current, reference };
template <>
struct enum_names<ProbePlace> {
  static constexpr std::array<std::pair<std::string_view, ProbePlace>, 2> value{
      {{"current", ProbePlace::current}, {"reference", ProbePlace::reference}}};
};

/// A watch point: one material point for good.
struct PointProbe {
  static constexpr std::string_view name = "point";
  Vec3 point{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("point", point,
      Spec{.text = "the material point nearest to this position in the reference configuration is watched",
           .unit = "m",
           .required = true,
           .role = Role::position});
  }
};

struct LineShape {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};
  std::optional<double> radius;
  int bins = 20;
  template <class V>
  void describe(V&& v) {
    v("from", from, Spec{.text = "start of the line", .unit = "m", .required = true, .role = Role::position});
    v("to", to, Spec{.text = "end of the line", .unit = "m", .required = true, .role = Role::position});
    v("radius", radius,
      Spec{.text = "material points up to this far from the line count; default: a cell", .unit = "m", .above = 0});
    v("bins", bins, Spec{.text = "equal parts of the line, a row each", .at_least = 1, .at_most = 10000});
  }
};

/// A profile along a line.
struct LineProbe {
  static constexpr std::string_view name = "line";
  LineShape line;
  ProbePlace place = ProbePlace::current;
  template <class V>
  void describe(V&& v) {
    v("line", line, Spec{.text = "a line along which material points are averaged in bins", .required = true});
    v("place", place, Spec{.text = "configuration in which the line lies"});
  }
};

struct PlaneShape {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("point", point, Spec{.text = "a point of the plane", .unit = "m", .required = true, .role = Role::position});
    v("normal", normal, Spec{.text = "normal of the plane, of any length", .required = true});
  }
};

/// The force through a section.
struct PlaneProbe {
  static constexpr std::string_view name = "plane";
  PlaneShape plane;
  std::optional<BoxShape> within;
  template <class V>
  void describe(V&& v) {
    v("plane", plane, Spec{.text = "a section through the bodies as they lie now", .required = true});
    v("within", within, Spec{.text = "only the part of the section in this box counts"});
  }
};

/// A region over time.
struct BoxProbe {
  static constexpr std::string_view name = "box";
  BoxShape box;
  ProbePlace place = ProbePlace::current;
  template <class V>
  void describe(V&& v) {
    v("box", box, Spec{.text = "a region (2D: rectangle)", .required = true});
    v("place", place, Spec{.text = "configuration in which the region lies"});
  }
};

using ProbeShape = std::variant<PointProbe, LineProbe, PlaneProbe, BoxProbe>;
template <>
struct choice_key<ProbeShape> {
  static constexpr std::string_view value = "";
};

/// Something that is watched while the run goes: probes/NAME.csv.
struct ProbeOptions {
  std::string name;
  ProbeShape where;
  std::optional<double> every;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "stem of the CSV file", .required = true});
    v("where", where,
      Spec{.text = "a point, a line, a plane or a region; stress and strain are averaged by volume, motion by mass",
           .required = true});
    v("every", every,
      Spec{.text = "least interval between its rows, of those of history.csv; default: output.history_every",
           .unit = "s",
           .above = 0});
  }
};

}  // namespace scarp
