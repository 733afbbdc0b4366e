// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/initial_state.hpp"

#include <algorithm>
#include <limits>

#include "solver/core/wave_speeds.hpp"

namespace scarp {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

/// How long the motion must have died down to count as rest: what a wave takes across the domain's longest side. A
/// turning point, where all of it swings back at once, is much shorter.
double quiet_time(const Domain& domain, double stable_step, double courant) {
  const Vec3 side = domain.max - domain.min;
  return std::max({side[0], side[1], side[2]}) / domain.cell * stable_step / courant;
}

/// Tells when the kinetic energy has stayed below a share of its largest for long enough.
struct Quiet {
  double share = 0;
  double not_before = 0;  ///< s
  double largest = 0;
  double since = kForever;

  double after(double time, double kinetic) {
    largest = std::max(largest, kinetic);
    since = kinetic <= share * largest && time >= not_before ? std::min(since, time) : kForever;
    return time - since;
  }
};

/// A K0 start needs the loads under absorbing faces, which bear nothing by themselves: one step at rest finds them.
void find_supports(Formulations& method, const Model& model) {
  if (!has_absorbing_face(model.domain)) return;
  method.begin_relaxing(RelaxOptions{}.damping);
  method.step(method.stable_time_step());
  method.rest();
}

}  // namespace

std::optional<Failure> relax(Formulations& method, const Model& model, const SolverOptions& options) {
  if (method.failure()) return std::nullopt;
  if (options.k0 && !options.relax) find_supports(method, model);
  if (!options.relax) return method.failure();
  const RelaxOptions& wanted = *options.relax;
  const double end = wanted.time.value_or(kForever), first_stable = method.stable_time_step();
  Quiet quiet{wanted.until, options.gravity_ramp};
  method.begin_relaxing(wanted.damping);
  double time = 0;
  for (std::int64_t step = 0; time < end; ++step) {
    const double stable = method.stable_time_step();
    if (step >= options.max_steps) return Failure{.what = "max_steps reached before the start was at rest"};
    if (!(stable > 1e-6 * first_stable))
      return method.collapse("the time step has collapsed before the start was at rest");
    const double dt = std::min(stable, end - time);
    method.step(dt);
    if (auto failure = method.failure()) return failure;
    time = dt < stable ? end : time + dt;
    const double rested = quiet.after(time, method.kinetic_energy_of_nodes());
    if (!wanted.time && rested >= quiet_time(model.domain, stable, options.courant)) break;
  }
  method.rest();
  return std::nullopt;
}

}  // namespace scarp
