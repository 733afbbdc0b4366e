// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/k0_options.hpp"
#include "solver/model/load_options.hpp"
#include "solver/model/math.hpp"
#include "solver/model/output_field.hpp"
#include "solver/model/run_out_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

enum class UpdateOrder { musl, usl, usf };
template <>
struct enum_names<UpdateOrder> {
  static constexpr std::array<std::pair<std::string_view, UpdateOrder>, 3> value{
      {{"musl", UpdateOrder::musl}, {"usl", UpdateOrder::usl}, {"usf", UpdateOrder::usf}}};
};

enum class ShapeFunction { linear, quadratic_bspline, gimp };
template <>
struct enum_names<ShapeFunction> {
  static constexpr std::array<std::pair<std::string_view, ShapeFunction>, 3> value{
      {{"linear", ShapeFunction::linear},
       {"quadratic-bspline", ShapeFunction::quadratic_bspline},
       {"gimp", ShapeFunction::gimp}}};
};

/// How velocities go from nodes to particles and back: see transfer.hpp, apic.hpp, xpic.hpp.
enum class Transfer { flip, apic, xpic };
template <>
struct enum_names<Transfer> {
  static constexpr std::array<std::pair<std::string_view, Transfer>, 3> value{
      {{"flip", Transfer::flip}, {"apic", Transfer::apic}, {"xpic", Transfer::xpic}}};
};

/// Against volumetric locking, see averaged_stress.hpp.
enum class AntiLocking { none, f_bar };
template <>
struct enum_names<AntiLocking> {
  static constexpr std::array<std::pair<std::string_view, AntiLocking>, 2> value{
      {{"none", AntiLocking::none}, {"f-bar", AntiLocking::f_bar}}};
};

/// In which form total-Lagrangian bodies are stepped; the method is the same.
enum class BackEnd { nodal, particle_state };
template <>
struct enum_names<BackEnd> {
  static constexpr std::array<std::pair<std::string_view, BackEnd>, 2> value{
      {{"nodal", BackEnd::nodal}, {"particle-state", BackEnd::particle_state}}};
};

struct SolverOptions {
  UpdateOrder update = UpdateOrder::musl;
  ShapeFunction shape = ShapeFunction::linear;
  AntiLocking anti_locking = AntiLocking::none;
  BackEnd back_end = BackEnd::nodal;
  std::optional<double> reference_update;
  Transfer transfer = Transfer::flip;
  double flip = 1.0;
  double pic_rate = 0;
  std::optional<std::int64_t> xpic_order;
  std::optional<Vec3> gravity;
  std::vector<std::string> body_force;
  double gravity_ramp = 0;
  double damping = 0;
  std::optional<K0Options> k0;
  std::optional<RelaxOptions> relax;
  double courant = 0.4;
  double end_time = 0;
  std::int64_t max_steps = 100'000'000;

  template <class V>
  void describe(V&& v) {
    v("update", update,
      Spec{.text = "when the stress is updated: \"musl\", last, after the momentum has been mapped a second time; "
                   "\"usl\", last, \"usf\", first, in updated-Lagrangian bodies only"});
    v("shape", shape,
      Spec{.text =
               "shape functions of the grid; \"quadratic-bspline\" and \"gimp\" in updated-Lagrangian bodies only"});
    v("anti_locking", anti_locking,
      Spec{.text = "\"f-bar\": the laws see the mean volume ratio of the cell, so that cells do not lock where volume "
                   "stays as it is (plastic flow without dilatancy, a Poisson's ratio near 0.5)"});
    v("back_end", back_end,
      Spec{.text =
               "form in which total-Lagrangian bodies are stepped: \"nodal\", with accumulators on the nodes, several "
               "times faster, where the body's laws and options allow it; \"particle-state\" throughout. "
               "Updated-Lagrangian bodies are stepped in packs of particles or, with the latter, one by one. Results "
               "differ by rounding"});
    v("reference_update", reference_update,
      Spec{
          .text =
              "total-Lagrangian bodies take their current configuration as the reference one, and their grid anew from "
              "it, as soon as the ratio of the largest to the smallest principal stretch since the last time exceeds "
              "this in one of their particles (2.6 is a shear of 1), so that they may flow and part; with courant at "
              "most 0.5; default: never",
          .above = 1});
    v("transfer", transfer,
      Spec{.text = "how velocities go from nodes to particles: \"flip\", changes, blended with PIC by `flip` and "
                   "`pic_rate`; \"apic\", the velocity and its gradient, which keeps angular momentum; \"xpic\", FLIP "
                   "without what the nodes cannot see"});
    v("flip", flip,
      Spec{.text = "FLIP share of the velocity update; the rest is PIC. With transfer = \"flip\"",
           .at_least = 0,
           .at_most = 1});
    v("pic_rate", pic_rate,
      Spec{.text =
               "rate at which FLIP velocities turn into PIC ones, whatever the time step: the FLIP share of a step is "
               "flip exp(-pic_rate dt)",
           .unit = "1/s",
           .at_least = 0});
    v("xpic_order", xpic_order,
      Spec{.text =
               "order of transfer = \"xpic\"; default 2. Higher ones keep shorter waves and cost a map to the nodes "
               "and back each",
           .at_least = 2,
           .at_most = 5});
    v("gravity", gravity, Spec{.text = "acceleration of gravity; default 9.81 downwards", .unit = "m/s2"});
    v("body_force", body_force,
      Spec{.text =
               "acceleration beside gravity, m/s2: a formula of the reference position X, Y, Z (m), t (s) and pi per "
               "axis; on total-Lagrangian bodies"});
    v("gravity_ramp", gravity_ramp,
      Spec{.text = "gravity grows smoothly from nothing over this time; with `relax`, while relaxing",
           .unit = "s",
           .at_least = 0});
    v("damping", damping,
      Spec{.text = "local damping: share of a node's out-of-balance force that works against its velocity",
           .at_least = 0,
           .below = 1});
    v("k0", k0,
      Spec{.text = "start from the stress of the overburden, horizontal in a ratio to vertical; a slope needs `relax` "
                   "beside it, which then starts from there"});
    v("relax", relax,
      Spec{.text =
               "start from rest under gravity: relax first, then set velocity and displacement to zero, keep stress"});
    v("courant", courant, Spec{.text = "time step as a share of the stable one", .above = 0, .at_most = 1});
    v("end_time", end_time, Spec{.text = "simulated time", .unit = "s", .above = 0, .required = true});
    v("max_steps", max_steps, Spec{.text = "stop with a failure after this many steps", .at_least = 1});
  }
};

struct OutputOptions {
  std::optional<double> every;
  std::optional<double> history_every;
  std::vector<OutputField> fields{OutputField::displacement, OutputField::velocity, OutputField::stress,
                                  OutputField::equivalent_plastic_strain};
  RunOutOptions run_out;
  bool absolute = false;

  template <class V>
  void describe(V&& v) {
    v("every", every,
      Spec{.text = "interval between frames; default: a twentieth of the end time", .unit = "s", .above = 0});
    v("history_every", history_every,
      Spec{.text = "interval between rows of history.csv; default: a tenth of the frames'", .unit = "s", .above = 0});
    v("fields", fields, Spec{.text = "what a frame holds per particle, beside id, body, material, surface and colour"});
    v("run_out", run_out, Spec{.text = "how run-out, deposit and footprint in summary.json are measured"});
    v("absolute", absolute,
      Spec{.text = "positions, displacements and velocities of frames with the motion of a rigidly shaken base; "
                   "otherwise relative to it"});
  }
};

}  // namespace scarp
