// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/kernels/cell_particles.hpp"
#include "solver/kernels/nodal.hpp"
#include "solver/kernels/particles.hpp"

namespace scarp::kernels {

/// The kernels of one instruction set. Ranges of nodes begin and end at multiples of kSegment.
struct Kernels {
  const char* name = "";  ///< "x86-64-v4", ...
  int lanes = 1;
  /// [law][D - 2][whether laws see the mean volume ratio of their cell]
  void (*stress[kLawKinds][2][2])(const StressSweep&, const Segment*, const Segment*, StressResult&);
  /// Of all places of a segment; changes nothing else.
  void (*states[kLawKinds][2][2])(const StressSweep&, const Segment&, PointState* places);
  void (*momentum[2])(const MomentumSweep&, const Segment*, const Segment*);  ///< [D - 2]
  void (*forces)(const ForceSweep&, std::size_t begin, std::size_t end, ForceResult&);
  void (*velocities)(const VelocitySweep&, std::size_t begin, std::size_t end);
  /// Adds `count` numbers, a multiple of kSegment, to a row, and sets them back to zero.
  void (*add_copies)(double* row, double* copy, std::size_t count);
  void (*energy[kLawKinds][2][2])(const StressSweep&, const Segment*, const Segment*, EnergyResult&);
  ParticleKernels particles;
  CellKernels cells;
  // Of `count` numbers, a multiple of kSegment; for tests and benchmarks.
  void (*natural_log)(const double* x, double* result, std::size_t count);
  void (*exponential)(const double* x, double* result, std::size_t count);
  void (*inverse_root)(const double* x, double* result, std::size_t count);
  // Of kSegment symmetric tensors, [entry][lane]; [D - 2]: ln(I + A) / 2 and exp(2 e) - I.
  void (*half_log[2])(const double* A, double* result);
  void (*exp_twice[2])(const double* e, double* result);
  /// `rounds` times twelve independent fused multiply-adds per lane: what the processor can do at best. Some number.
  double (*multiply_add)(std::int64_t rounds);
};

}  // namespace scarp::kernels
