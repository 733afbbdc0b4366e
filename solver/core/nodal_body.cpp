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

/// Keeps the entries of `chosen` alone.
template <class T>
void keep_only(std::vector<T>& values, const std::vector<std::uint32_t>& chosen) {
  std::vector<T> kept;
  kept.reserve(chosen.size());
  for (const std::uint32_t i : chosen) kept.push_back(values[i]);
  values = std::move(kept);
}

std::size_t pitch_of(std::size_t doubles) { return (doubles + 511) / 512 * 512 + kStagger; }

/// Rows of the list that belong to the same nodes.
std::vector<std::uint32_t> groups_of(const std::vector<SharedRow>& shared) {
  std::vector<std::uint32_t> begins;
  for (std::uint32_t i = 0; i < shared.size(); ++i)
    if (i == 0 || shared[i].node != shared[i - 1].node) begins.push_back(i);
  begins.push_back(static_cast<std::uint32_t>(shared.size()));
  return begins;
}

}  // namespace

NodalBody::NodalBody(const Model& model, TotalBody& body, bool average, const kernels::Kernels& chosen)
    : model_(model), body_(body), kernels_(chosen), average_(average) {
  const auto laws = kernels_of(model);
  layout_ = lay_out(model, body, laws);
  shared_groups_ = groups_of(layout_.shared);
  for (const auto& law : laws) laws_.push_back(law.value_or(kernels::LawParameters{}));
  choose_special_nodes();
  slab_results_.resize(layout_.slabs.size());
  chunk_results_.resize((layout_.nodes() + kNodesPerTask - 1) / kNodesPerTask);
}

void NodalBody::reserve_fields() {
  const std::size_t nodes = pitch_of(layout_.nodes()), sums = pitch_of(layout_.sums);
  memory_.assign(12 * nodes + 3 * sums, 0);
  double* next = memory_.data();
  const auto take = [&](std::size_t pitch) {
    double* const field = next;
    next += pitch;
    return field;
  };
  for (int c = 0; c < 3; ++c) {
    nodes_.U[c] = take(nodes);
    nodes_.W[c] = take(nodes);
    nodes_.A[c] = take(nodes);
    nodes_.v[c] = take(nodes);
    nodes_.sum[c] = take(sums);
  }
  nodes_.per_mass = per_mass_.data();
}

void NodalBody::choose_special_nodes() {
  const std::size_t count = body_.grid.nodes.size();
  per_mass_.assign(pitch_of(layout_.nodes()), 0);
  std::vector<bool> special(count, false);
  for (std::size_t i = 0; i < count; ++i) special[i] = body_.held[i] != 0;
  body_.conditions.faces.mark(special);
  body_.conditions.loads.mark(special);
  body_.conditions.rigid.mark(special);
  std::vector<std::uint32_t> chosen, place(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (special[i]) {
      place[i] = static_cast<std::uint32_t>(chosen.size());
      chosen.push_back(i);
      special_.push_back(layout_.node_of[i]);
      special_mass_.push_back(body_.grid.node_mass[i]);
    } else {
      per_mass_[layout_.node_of[i]] = body_.inverse_mass[i];
    }
  }
  special_momentum_.assign(special_.size(), Vec3{0, 0, 0});
  body_.conditions.faces.renumber(place);
  body_.conditions.loads.renumber(place);
  body_.conditions.rigid.renumber(place);
  body_.velocity.assign(chosen.size(), Vec3{0, 0, 0});
  body_.velocity_updated.assign(chosen.size(), Vec3{0, 0, 0});
  keep_only(body_.inverse_mass, chosen);
  keep_only(body_.held, chosen);
  keep_only(body_.held_now, chosen);
}

Vec3 NodalBody::node_position(std::size_t node) const {
  const NodeBlock& block = layout_.blocks[node / kSegment];
  const auto x = static_cast<double>(block.x) + static_cast<double>(node % kSegment);
  return layout_.origin + layout_.cell * Vec3{x, 1.0 * block.y, 1.0 * block.z};
}

void NodalBody::restart(const Particles& particles, int threads) {
  if (memory_.empty()) {
    reserve_fields();
    fill_history();
  }
  for (int c = 0; c < 3; ++c) {
    std::fill_n(nodes_.W[c], layout_.nodes(), 0.0);
    std::fill_n(nodes_.A[c], layout_.nodes(), 0.0);
    std::fill_n(nodes_.sum[c], layout_.sums, 0.0);
  }
  share_ = 1;
  start_square_ = 0;
  start_velocity_.assign(1, Vec3{0, 0, 0});
  if (!particles.velocity.empty()) {
    const auto begin = particles.velocity.begin() + static_cast<std::ptrdiff_t>(body_.begin),
               end = particles.velocity.begin() + static_cast<std::ptrdiff_t>(body_.end);
    if (std::all_of(begin, end, [&](const Vec3& v) { return v == *begin; }))
      start_velocity_.front() = *begin;
    else
      start_velocity_.assign(begin, end);
    for (std::size_t p = body_.begin; p < body_.end; ++p)
      start_square_ += particles.mass[p] * dot(particles.velocity[p], particles.velocity[p]);
  }
  moves_ = start_square_ > 0;
  if (moves_) map_start_momentum(particles);
  find_velocities(0, threads);
  sweep_stress(true, threads);
}

void NodalBody::map_start_momentum(const Particles& particles) {
  const std::size_t pitch = pitch_of(layout_.nodes());
  start_momentum_.assign(3 * pitch, 0);
  for (int c = 0; c < 3; ++c) nodes_.P0[c] = P0_[c] = start_momentum_.data() + static_cast<std::size_t>(c) * pitch;
  scatter(P0_, [&](std::size_t p) { return particles.mass[p] * particles.velocity[p]; });
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
  for (std::size_t i = 0; i < special_.size(); ++i) {
    const Vec3 force = at(nodes_.sum, special_[i]);
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
  for (std::size_t i = 0; i < special_.size(); ++i) {
    const std::uint32_t node = special_[i];
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
        kernels_.add_copies(nodes_.sum[c] + row.node, nodes_.sum[c] + row.copy, row.count);
    }
  });
}

/// (5) v_I of the momenta that stand in the sums; U.
void NodalBody::find_velocities(double dt, int threads) {
  for (std::size_t i = 0; i < special_.size(); ++i) {
    const std::uint32_t node = special_[i];
    special_momentum_[i] = at(nodes_.sum, node);
    if (moves_) special_momentum_[i] = special_momentum_[i] + share_ * at(P0_, node);
    body_.velocity[i] = body_.inverse_mass[i] * special_momentum_[i];
    hold(body_.velocity[i], body_.held_now[i]);
  }
  if (dt > 0) {
    body_.conditions.loads.hold(body_.velocity);
    body_.conditions.rigid.hold(body_.velocity);
  }
  const kernels::VelocitySweep sweep{nodes_, dt, start_share()};
  for_each_chunk(layout_.nodes(), threads,
                 [&](std::size_t, std::size_t begin, std::size_t end) { kernels_.velocities(sweep, begin, end); });
  for (std::size_t i = 0; i < special_.size(); ++i)
    put(nodes_.U, special_[i], at(nodes_.U, special_[i]) + dt * body_.velocity[i]);
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
      if (found.largest_speed_squared > result.largest_speed_squared) {
        result.largest_speed_squared = found.largest_speed_squared;
        result.fastest_segment = run.begin + found.fastest_segment;
      }
      if (result.bad_segment < 0 && found.bad_segment >= 0) result.bad_segment = run.begin + found.bad_segment;
    }
  });
  add_shared_rows(threads);
  outcome_ = {find_speed ? 0 : outcome_.largest_wave_speed_squared, -1};
  for (const kernels::StressResult& result : slab_results_) {
    if (result.largest_speed_squared > outcome_.largest_wave_speed_squared) {
      outcome_.largest_wave_speed_squared = result.largest_speed_squared;
      stiffest_ = static_cast<std::size_t>(result.fastest_segment);
    }
    if (outcome_.bad_particle < 0 && result.bad_segment >= 0)
      outcome_.bad_particle = find_bad_particle(static_cast<std::size_t>(result.bad_segment));
  }
}

/// Of nodes [begin, end) but those that the kernels leave alone, and of those at `special`: what they add to the sums
/// over particles. As sums m_p phi_Ip v_p are the momenta p_I and linear functions give X_p and x_p exactly,
///   sum_p m_p v_p^2 = sum_I A_I . (p_I + a P0_I) + a^2 sum_p m_p v_p(0)^2
///   sum_p m_p (x_p - c) x v_p = sum_I (X_I + W_I - c) x p_I
void NodalBody::add_motion(NodeSums& sums, std::size_t node, const Vec3& p, double mass, const Vec3& about) const {
  const Vec3 A = at(nodes_.A, node), W = at(nodes_.W, node);
  sums.of_change += dot(A, p);
  if (moves_) sums.of_start += dot(A, at(P0_, node));
  sums.momentum = sums.momentum + p;
  sums.angular = sums.angular + cross(node_position(node) + W - about, p);
  sums.displaced = sums.displaced + mass * W;
}

double NodalBody::kinetic_energy_of_nodes(int threads) const {
  const double of_kernels = sum_over_nodes(layout_.nodes(), threads, [&](std::size_t node) {
    const Vec3 v = at(nodes_.v, node);
    return per_mass_[node] > 0 ? 0.5 * dot(v, v) / per_mass_[node] : 0;
  });
  return of_kernels + scarp::kinetic_energy_of_nodes(special_mass_, body_.velocity, 1);
}

NodalBody::NodeSums NodalBody::measure_nodes(const Vec3& about, int threads) const {
  std::vector<NodeSums> parts((layout_.nodes() + kNodesPerTask - 1) / kNodesPerTask + 1);
  for_each_chunk(layout_.nodes(), threads, [&](std::size_t task, std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      if (!(per_mass_[node] > 0)) continue;
      const double mass = 1 / per_mass_[node];
      add_motion(parts[task], node, mass * at(nodes_.v, node), mass, about);
    }
  });
  for (std::size_t i = 0; i < special_.size(); ++i)
    add_motion(parts.back(), special_[i], special_momentum_[i], special_mass_[i], about);
  NodeSums sum;
  for (const NodeSums& part : parts) {
    sum.of_change += part.of_change;
    sum.of_start += part.of_start;
    sum.momentum = sum.momentum + part.momentum;
    sum.angular = sum.angular + part.angular;
    sum.displaced = sum.displaced + part.displaced;
  }
  return sum;
}

HistorySample NodalBody::measure(const Vec3& gravity, const Vec3& about, int threads) const {
  HistorySample sample;
  const NodeSums nodes = measure_nodes(about, threads);
  sample.momentum = nodes.momentum;
  sample.angular_momentum = nodes.angular;
  sample.centre = nodes.displaced;
  sample.kinetic = 0.5 * (nodes.of_change + share_ * (share_ * start_square_ + nodes.of_start));
  sample.potential = -dot(gravity, nodes.displaced);
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
