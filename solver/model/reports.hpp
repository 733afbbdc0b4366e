// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each stage says about its work. Counts and measures only; the wording is the command line's business.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// One cleaning step: how many points went in and stayed.
struct CleanReport {
  std::string filter;
  std::size_t before = 0;
  std::size_t after = 0;
};

struct IngestReport {
  std::string scan;
  std::size_t points_read = 0;
  std::size_t points_kept = 0;
  std::size_t not_finite = 0;  ///< dropped because a coordinate was NaN or infinite
  std::vector<CleanReport> steps;
  Box3 bounds;  ///< of what was kept, local
};

/// The truth about volume: what the input geometry holds and what the material points hold.
struct VolumeReport {
  std::string body;
  double input_volume = 0;     ///< m3 (2D: m2), of the closed mesh, TIN prism or shape, exact
  double particle_volume = 0;  ///< sum of V0
  std::size_t particles = 0;
  std::size_t cells = 0;               ///< lattice cells that hold at least one particle
  std::size_t full_cells = 0;          ///< cells with the full count of points
  std::size_t isolated_particles = 0;  ///< alone in their cell with no neighbouring cell occupied
  double mean_thickness_in_cells = 0;  ///< 2.5D solids: volume / (plan area x cell); else 0
  std::vector<std::pair<std::string, double>> volume_by_material;
  bool closed = true;
  bool self_intersecting = false;
  double plan_area = 0;                        ///< m2, 2.5D solids: of the part that has thickness; else 0
  std::size_t points_beside_rule_surface = 0;  ///< where a `below` rule's raster has no value, so that it took none

  double relative_difference() const { return input_volume > 0 ? (particle_volume - input_volume) / input_volume : 0; }
};

/// One row of history.csv. Energies in J, momentum in kg m/s (2D: per metre).
struct HistorySample {
  double time = 0;
  std::int64_t step = 0;
  double dt = 0;
  double kinetic = 0;
  double strain = 0;
  double plastic = 0;
  double potential = 0;  ///< gravity, relative to the reference configuration
  double friction = 0;   ///< lost on faces with friction and between bodies since the start
  double damping = 0;    ///< lost to damping and absorbing faces since the start
  double external =
      0;  ///< done on the model by loads since the start, and by gravity as far as it differs from its steady value
  double contact = 0;  ///< stored in the springs between bodies
  double total = 0;    ///< kinetic + strain + plastic + potential + contact + friction + damping - external
  Vec3 momentum{0, 0, 0};
  Vec3 angular_momentum{0, 0, 0};  ///< sum of (x - RunReport::reference_centre) x m v, kg m2/s; plane strain: about z
  Vec3 centre{0, 0, 0};            ///< of mass, local, m
  /// By contact on each body, and by what they carry or hold on rigid ones, N: the mean since the sample before. Empty
  /// where there is neither; see reports_contact_force.
  std::vector<Vec3> contact_force;
};

/// What sets the time step: the cell of a total-Lagrangian body or the particle of an updated-Lagrangian one that a
/// signal crosses first.
struct StepLimit {
  double time_step = 0;  ///< s, the largest stable one
  double time = 0;       ///< s, when
  std::int32_t body = -1;
  std::int32_t material = -1;
  std::int64_t particle =
      -1;                  ///< id; of a cell the stiffest, of an updated-Lagrangian body the faster of its two causes
  Vec3 position{0, 0, 0};  ///< of the particle, local, m
  double wave_speed = 0;   ///< m/s; total-Lagrangian: of the cell, in the reference configuration
  double particle_speed = 0;  ///< m/s, of the fastest particle; 0 where it does not count (total-Lagrangian)
};

/// How a simulation failed: a value, not an exception, so that everything before it is kept.
struct Failure {
  std::string what;
  std::int64_t step = 0;
  double time = 0;
  std::int64_t particle = -1;  ///< id, or -1
  Vec3 position{0, 0, 0};      ///< local, m
};

/// In which form a total-Lagrangian body was stepped.
struct BodyForm {
  std::string body;
  std::string obstacle;                ///< empty: nodal; else why its particles carried the state
  std::int64_t reference_updates = 0;  ///< how often its reference configuration has moved
};

struct RunReport {
  bool failed = false;
  Failure failure;
  std::int64_t steps = 0;
  std::int64_t particle_steps = 0;
  double end_time = 0;
  double smallest_dt = 0;
  double largest_dt = 0;
  double largest_displacement = 0;  ///< m, at the end
  HistorySample first, last;
  double largest_energy_error = 0;  ///< max over samples of |total - total at start|, J
  double largest_energy = 0;  ///< max over samples of what moved: kinetic + strain + plastic + friction + damping, J
  Vec3 reference_centre{0, 0, 0};  ///< of mass in the reference configuration, local, m
  StepLimit step_limit;            ///< the tightest of those at the start, at each frame and at a collapse
  double largest_kinetic = 0;
  std::string instruction_set;  ///< that the kernels were compiled for
  std::vector<BodyForm> forms;
};

}  // namespace scarp
