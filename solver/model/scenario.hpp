// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// THE schema: everything that a scenario file can say. Positions and elevations are the site's coordinates.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/materials/material.hpp"
#include "solver/model/body_options.hpp"
#include "solver/model/compare_options.hpp"
#include "solver/model/contact_options.hpp"
#include "solver/model/domain.hpp"
#include "solver/model/probe_options.hpp"
#include "solver/model/render_options.hpp"
#include "solver/model/scan_options.hpp"
#include "solver/model/shaking_options.hpp"
#include "solver/model/solver_options.hpp"
#include "solver/model/water_table.hpp"

namespace scarp {

struct BoundaryOptions {
  Face x_min, x_max, y_min, y_max, z_min, z_max;

  template <class V>
  void describe(V&& v) {
    v("x_min", x_min, Spec{.text = "nodes on the face of lowest x"});
    v("x_max", x_max, Spec{.text = "nodes on the face of highest x"});
    v("y_min", y_min, Spec{.text = "nodes on the face of lowest y"});
    v("y_max", y_max, Spec{.text = "nodes on the face of highest y"});
    v("z_min", z_min, Spec{.text = "nodes on the face of lowest z"});
    v("z_max", z_max, Spec{.text = "nodes on the face of highest z"});
  }
};

struct DomainOptions {
  int dimension = 3;
  double cell = 0;
  std::optional<Vec3> min;
  std::optional<Vec3> max;
  BoundaryOptions boundary;

  template <class V>
  void describe(V&& v) {
    v("dimension", dimension, Spec{.text = "3, or 2 for plane strain (x right, y up)", .at_least = 2, .at_most = 3});
    v("cell", cell, Spec{.text = "edge of a grid cell", .unit = "m", .above = 0, .required = true});
    v("min", min,
      Spec{.text = "lower corner; default: the bodies' bounds, outwards to whole cells",
           .unit = "m",
           .role = Role::position});
    v("max", max,
      Spec{.text = "upper corner; default: the bodies' bounds, outwards to whole cells",
           .unit = "m",
           .role = Role::position});
    v("boundary", boundary, Spec{.text = "what holds the nodes on each face"});
  }
};

struct Scenario {
  std::string title;
  std::vector<ScanOptions> scans;
  DomainOptions domain;
  std::map<std::string, Material> materials;
  std::vector<BodyOptions> bodies;
  ContactOptions contact;
  std::optional<WaterTableOptions> water_table;
  std::vector<LoadOptions> loads;
  std::vector<ShakingOptions> shaking;
  SolverOptions solver;
  OutputOptions output;
  std::vector<ProbeOptions> probes;
  std::vector<RenderOptions> render;
  std::vector<CompareOptions> compare;

  /// Nothing is simulated: two scans are held against each other, which takes neither domain, materials, bodies nor
  /// solver.
  bool only_surveys() const {
    return bodies.empty() && !compare.empty() &&
           std::none_of(compare.begin(), compare.end(), [](const CompareOptions& c) { return c.of_frame(); });
  }

  template <class V>
  void describe(V&& v) {
    v("title", title, Spec{.text = "one line that names the run in pictures and reports", .required = true});
    v("scans", scans, Spec{.text = "what was observed"});
    v("domain", domain, Spec{.text = "the box, its grid and its faces"});
    v("materials", materials, Spec{.text = "laws and their parameters, by name"});
    v("bodies", bodies, Spec{.text = "what is simulated"});
    v("contact", contact, Spec{.text = "how bodies meet"});
    v("water_table", water_table,
      Spec{.text = "pore pressure as a given field: hydrostatic below this level; stresses are effective ones then"});
    v("loads", loads, Spec{.text = "what acts on the bodies in time, beside gravity"});
    v("shaking", shaking, Spec{.text = "records of acceleration that shake the base"});
    v("solver", solver, Spec{.text = "method and time"});
    v("output", output, Spec{.text = "what is kept of the run"});
    v("probes", probes, Spec{.text = "what is watched while the run goes"});
    v("render", render, Spec{.text = "pictures"});
    v("compare", compare, Spec{.text = "simulated surfaces held against observed ones, or two surveys"});
  }
};

}  // namespace scarp
