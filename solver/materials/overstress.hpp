// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viscoplastic regularisation after Duvaut and Lions (1972; Simo, Kennedy, Govindjee 1988): the plastic strain follows
// that of the rate-independent law with a time of relaxation T,
//   d eps_p / dt = C^-1 (tau - tau_inf) / T,   tau_inf: where the return map would bring tau,
// integrated exactly over a step for the return from its trial stress: the share exp(-dt / T) of the way is left. At a
// held strain the overstress so dies as exp(-t / T) in any number of steps, T = 0 is the rate-independent law to the
// last digit, and no T limits the time step. Softening then spreads over a width of about (wave speed) T instead of one
// cell: loads over times much longer than T see the rate-independent strength.
#pragma once

#include <cmath>

#include "solver/model/schema.hpp"

namespace scarp {

/// Share of the overstress that is left after a step.
inline double overstress_left(double relaxation_time, double per_dt) {
  return relaxation_time > 0 ? std::exp(-1 / (per_dt * relaxation_time)) : 0;
}

template <class V>
void describe_relaxation(V&& v, double& relaxation_time) {
  v("relaxation_time", relaxation_time,
    Spec{.text = "viscoplastic regularisation (Duvaut-Lions): time in which stress beyond the strength falls to 37 %; "
                 "0: independent of the rate",
         .unit = "s",
         .at_least = 0});
}

}  // namespace scarp
