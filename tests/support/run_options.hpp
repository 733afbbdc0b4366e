// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/solver_options.hpp"

namespace scarp::test {

inline SolverOptions solver(double end_time, Vec3 gravity, double courant = SolverOptions{}.courant,
                            ShapeFunction shape = ShapeFunction::linear) {
  SolverOptions options;
  options.end_time = end_time;
  options.gravity = gravity;
  options.courant = courant;
  options.shape = shape;
  return options;
}

inline OutputOptions output(double every, double history_every) {
  OutputOptions options;
  options.every = every;
  options.history_every = history_every;
  return options;
}

}  // namespace scarp::test
