// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the moved mass went, from its first state to its last.
#pragma once

#include <optional>
#include <string>

#include "solver/model/domain.hpp"
#include "solver/model/particle_states.hpp"
#include "solver/model/run_out_options.hpp"

namespace scarp {

/// A value, or why there is none.
struct Extent {
  std::optional<double> value;
  std::string why_not;

  Extent() = default;
  Extent(double v) : value(v) {}
  static Extent none(std::string why) {
    Extent extent;
    extent.why_not = std::move(why);
    return extent;
  }
};

/// Of the material points that moved by the threshold or more ("the moved mass"). Lengths in m; plane strain per metre:
/// volumes are m2, areas are lengths. Points count as centres: what they stand for reaches half a spacing further, at
/// either end of a difference.
/// Up is z (plane strain: y). "Along" is along the direction of motion, in plan.
struct RunOut {
  double threshold = 0;
  double moved_volume = 0;                             ///< of the reference configuration
  double moved_share = 0;                              ///< of the volume of all bodies
  std::string why_nothing;                             ///< why there is no moved mass; empty if there is
  Vec3 centre_before{0, 0, 0}, centre_after{0, 0, 0};  ///< of the moved mass, local

  Vec3 direction{0, 0, 0};  ///< unit vector in plan; zero where why_no_direction says so
  std::string why_no_direction;

  Extent run_out;        ///< foremost point along, after minus before
  Extent crest_drop;     ///< fall of the crest: of the highest moved points before, the foremost
  Extent crest_retreat;  ///< from the crest back to the rearmost moved point before, along
  /// Fahrboeschung (Heim 1932): from the highest point of the moved mass before (of several the rearmost) to its
  /// foremost after (of several the lowest), in the vertical plane along, deg below the horizontal.
  Extent travel_angle;
  Extent deposit_length;                 ///< moved mass after, from rear to front, along
  Extent deposit_width;                  ///< the same across; none in plane strain
  double deposit_thickness_largest = 0;  ///< present volume per area of the plan cells that hold it
  double deposit_thickness_mean = 0;
  /// Area of the plan cells (of the domain's size) that hold moved mass before, after, and both times.
  double footprint_before = 0, footprint_after = 0, footprint_overlap = 0;
};

/// @param gravity  for the heights' figures, which need it vertical within 1 degree
RunOut measure_run_out(const ParticleStates& states, const Domain& domain, const Vec3& gravity,
                       const RunOutOptions& options);

}  // namespace scarp
