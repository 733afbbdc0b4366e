// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/nodal_body.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/law_kernels.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

using kernels::kSegment;
using kernels::Segment;

constexpr std::size_t kNodesPerTask = 4096;
/// Arrays begin this many doubles apart modulo a page, so that equal indices do not fall on the same lines of a cache.
constexpr std::size_t kStagger = 17 * 8;

template <class F>
void for_each_chunk(std::size_t nodes, int threads, F&& f) {
  parallel_for((nodes + kNodesPerTask - 1) / kNodesPerTask, threads,
               [&](std::size_t t) { f(t, t * kNodesPerTask, std::min(nodes, (t + 1) * kNodesPerTask)); });
}

inline Vec3 at(double* const (&field)[3], std::size_t node) { return {field[0][node], field[1][node], field[2][node]}; }
inline void put(double* const (&field)[3], std::size_t node, const Vec3& value) {
  for (int c = 0; c < 3; ++c) field[c][node] = value[c];
}
inline void hold(Vec3& v, std::uint8_t held) {
  for (int a = 0; a < 3; ++a)
    if (held >> a & 1) v[a] = 0;
}

/// Rows of the list that belong to the same nodes.
std::vector<std::uint32_t> groups_of(const std::vector<SharedRow>& shared) {
  std::vector<std::uint32_t> begins;
  for (std::uint32_t i = 0; i < shared.size(); ++i)
    if (i == 0 || shared[i].node != shared[i - 1].node) begins.push_back(i);
  begins.push_back(static_cast<std::uint32_t>(shared.size()));
  return begins;
}

}  // namespace

NodalBody::NodalBody(const Model& model, TotalBody& body, const kernels::Kernels& chosen)
    : model_(model), body_(body), kernels_(chosen), average_(!body.since.empty()) {
  const auto laws = kernels_of(model);
  layout_ = lay_out(model, body, laws);
  shared_groups_ = groups_of(layout_.shared);
  for (const auto& law : laws) laws_.push_back(law.value_or(kernels::LawParameters{}));
  reserve_fields();
  choose_special_nodes();
  fill_history();
  slab_results_.resize(layout_.slabs.size());
  chunk_results_.resize((layout_.nodes() + kNodesPerTask - 1) / kNodesPerTask);
}

void NodalBody::reserve_fields() {
  const std::size_t nodes = layout_.nodes();
  const std::size_t pitch = (std::max(nodes, layout_.sums) + 511) / 512 * 512 + kStagger;
  memory_.assign(19 * pitch, 0);
  double* next = memory_.data();
  const auto take = [&] {
    double* const field = next;
    next += pitch;
    return field;
  };
  for (int c = 0; c < 3; ++c) {
    nodes_.U[c] = take();
    nodes_.W[c] = take();
    nodes_.A[c] = take();
    nodes_.v[c] = take();
    nodes_.sum[c] = take();
    nodes_.P0[c] = P0_[c] = take();
  }
  nodes_.per_mass = per_mass_ = take();
}

void NodalBody::choose_special_nodes() {
  const std::size_t count = body_.grid.nodes.size();
  std::vector<bool> special(count, false);
  for (std::size_t i = 0; i < count; ++i) special[i] = body_.held[i] != 0;
  body_.conditions.faces.mark(special);
  body_.conditions.loads.mark(special);
  special_mass_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (special[i]) {
      special_.push_back(static_cast<std::uint32_t>(i));
      special_mass_[i] = body_.grid.node_mass[i];
    } else {
      per_mass_[layout_.node_of[i]] = body_.inverse_mass[i];
    }
  }
  special_momentum_.assign(special_.size(), Vec3{0, 0, 0});
}

void NodalBody::restart(const Particles& particles, int threads) {
  for (int c = 0; c < 3; ++c) {
    std::fill_n(nodes_.W[c], layout_.nodes(), 0.0);
    std::fill_n(nodes_.A[c], layout_.nodes(), 0.0);
    std::fill_n(P0_[c], layout_.nodes(), 0.0);
    std::fill_n(nodes_.sum[c], layout_.sums, 0.0);
  }
  share_ = 1;
  start_square_ = 0;
  start_velocity_.assign(particles.velocity.begin() + static_cast<std::ptrdiff_t>(body_.begin),
                         particles.velocity.begin() + static_cast<std::ptrdiff_t>(body_.end));
  for (std::size_t p = body_.begin; p < body_.end; ++p)
    start_square_ += particles.mass[p] * dot(particles.velocity[p], particles.velocity[p]);
  moves_ = start_square_ > 0;
  if (moves_) scatter(P0_, [&](std::size_t p) { return particles.mass[p] * particles.velocity[p]; });
  const Vec3 first = start_velocity_.front();
  if (std::all_of(start_velocity_.begin(), start_velocity_.end(), [&](const Vec3& v) { return v == first; })) {
    start_velocity_.assign(1, first);
    start_velocity_.shrink_to_fit();
  }
  find_velocities(0, threads);
  sweep_stress(true, threads);
}

void NodalBody::add_body_force(const Particles& particles, const std::vector<Vec3>& acceleration) {
  double* field[3];
  for (int d = 0; d < 3; ++d) {
    body_force_[d].assign(layout_.nodes(), 0);
    field[d] = body_force_[d].data();
  }
  scatter(field, [&](std::size_t p) { return particles.mass[p] * acceleration[p]; });
  for (int d = 0; d < layout_.dimension; ++d)
    for (std::size_t i = 0; i < layout_.nodes(); ++i) nodes_.sum[d][i] += body_force_[d][i];
}

double NodalBody::body_force_times_displacement() const {
  double sum = 0;
  for (int d = 0; d < layout_.dimension; ++d)
    for (std::size_t i = 0; i < layout_.nodes(); ++i) sum += body_force_[d][i] * nodes_.W[d][i];
  return sum;
}

NodeWork NodalBody::step(const NodalStep& step, int threads) {
  const NodeWork work = advance_forces(step, threads);
  sweep_momentum(threads);
  find_velocities(step.dt, threads);
  sweep_stress(step.find_speed, threads);
  return work;
}

/// (2), (3) v' of every node, and what the particles would get of it.
NodeWork NodalBody::advance_forces(const NodalStep& step, int threads) {
  for (std::uint32_t i : special_) {
    const Vec3 force = at(nodes_.sum, layout_.node_of[i]);
    Vec3& after = body_.velocity_updated[i];
    after = body_.velocity[i] + step.dt * (body_.inverse_mass[i] * force + step.gravity);
    hold(after, body_.held[i]);
  }
  const NodeStep nodes{special_mass_.size(),
                       special_mass_.data(),
                       body_.velocity.data(),
                       body_.velocity_updated.data(),
                       step.dt,
                       step.time};
  NodeWork work = act_on_nodes(body_.conditions, nodes, body_.held_now, step.missing_gravity, threads);
  kernels::ForceSweep sweep{nodes_, {}, step.dt, step.flip, body_.conditions.damping};
  std::copy(step.gravity.begin(), step.gravity.end(), sweep.gravity);
  for_each_chunk(layout_.nodes(), threads, [&](std::size_t task, std::size_t begin, std::size_t end) {
    chunk_results_[task] = {};
    kernels_.forces(sweep, begin, end, chunk_results_[task]);
  });
  for (const kernels::ForceResult& result : chunk_results_) {
    work.damping += result.damped;
    for (int c = 0; c < 3; ++c) work.external += step.dt * step.missing_gravity[c] * result.momentum[c];
  }
  for (std::uint32_t i : special_) {
    const std::uint32_t node = layout_.node_of[i];
    const Vec3 &v = body_.velocity[i], &next = body_.velocity_updated[i];
    put(nodes_.W, node, at(nodes_.W, node) + step.dt * next);
    put(nodes_.A, node, step.flip * at(nodes_.A, node) + (next - step.flip * v));
  }
  share_ *= step.flip;
  return work;
}

void NodalBody::sweep_momentum(int threads) {
  const kernels::MomentumSweep sweep{nodes_, layout_.points.data()};
  const auto kernel = kernels_.momentum[layout_.dimension - 2];
  parallel_for(layout_.slabs.size(), threads, [&](std::size_t s) {
    const Slab& slab = layout_.slabs[s];
    kernel(sweep, &layout_.segments[slab.begin], layout_.segments.data() + slab.end);
  });
  add_shared_rows(threads);
}

/// Copies onto the sums that they belong to, in the order of the slabs, and back to zero.
void NodalBody::add_shared_rows(int threads) {
  parallel_for(shared_groups_.size() - 1, threads, [&](std::size_t g) {
    for (std::uint32_t i = shared_groups_[g]; i < shared_groups_[g + 1]; ++i) {
      const SharedRow& row = layout_.shared[i];
      for (int c = 0; c < layout_.dimension; ++c)
        for (std::uint32_t k = 0; k < row.count; ++k) {
          nodes_.sum[c][row.node + k] += nodes_.sum[c][row.copy + k];
          nodes_.sum[c][row.copy + k] = 0;
        }
    }
  });
}

/// (5) v_I of the momenta that stand in the sums; U.
void NodalBody::find_velocities(double dt, int threads) {
  for (std::size_t k = 0; k < special_.size(); ++k) {
    const std::uint32_t i = special_[k], node = layout_.node_of[i];
    special_momentum_[k] = at(nodes_.sum, node);
    if (moves_) special_momentum_[k] = special_momentum_[k] + share_ * at(P0_, node);
    body_.velocity[i] = body_.inverse_mass[i] * special_momentum_[k];
    hold(body_.velocity[i], body_.held_now[i]);
  }
  if (dt > 0) body_.conditions.loads.hold(body_.velocity);
  const kernels::VelocitySweep sweep{nodes_, dt, start_share()};
  for_each_chunk(layout_.nodes(), threads,
                 [&](std::size_t, std::size_t begin, std::size_t end) { kernels_.velocities(sweep, begin, end); });
  for (std::uint32_t i : special_) {
    const std::uint32_t node = layout_.node_of[i];
    put(nodes_.U, node, at(nodes_.U, node) + dt * body_.velocity[i]);
  }
}

kernels::StressSweep NodalBody::stress_sweep_of(double* history, bool find_speed) const {
  return {nodes_, 1 / layout_.cell, layout_.points.data(), history, laws_.data(), find_speed};
}

/// (5), (6), (1) F, stress and forces.
void NodalBody::sweep_stress(bool find_speed, int threads) {
  const kernels::StressSweep sweep = stress_sweep_of(history_.data(), find_speed);
  parallel_for(layout_.slabs.size(), threads, [&](std::size_t s) {
    kernels::StressResult& result = slab_results_[s];
    result = {};
    for (const Slab::Run& run : layout_.slabs[s].runs) {
      kernels::StressResult found;
      kernels_.stress[static_cast<int>(run.law)][layout_.dimension - 2][average_](
          sweep, &layout_.segments[run.begin], layout_.segments.data() + run.end, found);
      result.largest_speed_squared = std::max(result.largest_speed_squared, found.largest_speed_squared);
      if (result.bad_segment < 0 && found.bad_segment >= 0) result.bad_segment = run.begin + found.bad_segment;
    }
  });
  add_shared_rows(threads);
  outcome_ = {find_speed ? 0 : outcome_.largest_wave_speed_squared, -1};
  for (const kernels::StressResult& result : slab_results_) {
    outcome_.largest_wave_speed_squared = std::max(outcome_.largest_wave_speed_squared, result.largest_speed_squared);
    if (outcome_.bad_particle < 0 && result.bad_segment >= 0)
      outcome_.bad_particle = find_bad_particle(static_cast<std::size_t>(result.bad_segment));
  }
}

HistorySample NodalBody::measure(const Vec3& gravity, int threads) const {
  HistorySample sample;
  double of_start = 0, of_change = 0;
  Vec3 displaced{0, 0, 0};
  std::size_t next_special = 0;
  for (std::size_t i = 0; i < body_.grid.nodes.size(); ++i) {
    const std::uint32_t node = layout_.node_of[i];
    const bool special = next_special < special_.size() && special_[next_special] == i;
    const Vec3 p = special ? special_momentum_[next_special++] : body_.grid.node_mass[i] * at(nodes_.v, node);
    const Vec3 A = at(nodes_.A, node);
    of_change += dot(A, p);
    if (moves_) of_start += dot(A, at(P0_, node));
    sample.momentum = sample.momentum + p;
    displaced = displaced + body_.grid.node_mass[i] * at(nodes_.W, node);
  }
  sample.kinetic = 0.5 * (of_change + share_ * (share_ * start_square_ + of_start));
  sample.potential = -dot(gravity, displaced);
  std::vector<kernels::EnergyResult> found(layout_.slabs.size());
  const kernels::StressSweep sweep = stress_sweep_of(const_cast<double*>(history_.data()), false);
  parallel_for(layout_.slabs.size(), threads, [&](std::size_t s) {
    for (const Slab::Run& run : layout_.slabs[s].runs)
      kernels_.energy[static_cast<int>(run.law)][layout_.dimension - 2][average_](
          sweep, &layout_.segments[run.begin], layout_.segments.data() + run.end, found[s]);
  });
  for (const kernels::EnergyResult& result : found) {
    sample.strain += result.strain;
    sample.plastic += result.plastic;
  }
  sample.total = sample.kinetic + sample.strain + sample.plastic + sample.potential;
  return sample;
}

}  // namespace scarp
