// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NodalBody where it meets particles: what they bring at the start, and their state when someone asks for it.
#include <algorithm>
#include <cmath>

#include "solver/core/law_kernels.hpp"
#include "solver/core/linear_cell.hpp"
#include "solver/core/nodal_body.hpp"
#include "solver/core/step_limit.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

using kernels::kSegment;
using kernels::Segment;

template <int D>
std::uint32_t corner_node(const Segment& segment, int lane, int corner) {
  return segment.read[corner >> 1] + static_cast<std::uint32_t>(lane + (corner & 1));
}

/// A nodal field at the corners of a cell, in monomials.
template <int D>
void gather(double* const (&field)[3], const Segment& segment, int lane, typename LinearCell<D>::Values (&values)[D]) {
  for (int c = 0; c < D; ++c) {
    for (int k = 0; k < LinearCell<D>::N; ++k) values[c][k] = field[c][corner_node<D>(segment, lane, k)];
    LinearCell<D>::to_monomials(values[c]);
  }
}

template <int D>
Mat3 gradient(const typename LinearCell<D>::Values (&u)[D], const typename LinearCell<D>::Values& m, double per_cell) {
  Mat3 F = kIdentity;
  for (int i = 0; i < D; ++i) {
    F[3 * i] += per_cell * LinearCell<D>::template derivative<0>(u[i], m);
    F[3 * i + 1] += per_cell * LinearCell<D>::template derivative<1>(u[i], m);
    if constexpr (D == 3) F[3 * i + 2] += per_cell * LinearCell<D>::template derivative<2>(u[i], m);
  }
  return F;
}

/// Particle p's entry, or the field's default where none has left it.
template <class T>
T entry(const std::vector<T>& field, std::size_t p, const T& initial) {
  return field.empty() ? initial : field[p];
}
PointHistory start_history(const Particles& particles, std::size_t p) {
  return {entry(particles.elastic_left_cauchy_green, p, PointHistory{}.elastic_left_cauchy_green),
          entry(particles.equivalent_plastic_strain, p, 0.0), entry(particles.plastic_work, p, 0.0)};
}

/// Whether the stress of a particle at rest is the one that its law finds.
bool stress_is_of_law(const Particles& particles, const std::vector<PreparedLaw>& laws, std::size_t p) {
  return std::visit(
      [&](const auto& law) {
        const Motion rest = make_motion(kIdentity, kIdentity);
        PointHistory history = start_history(particles, p);
        const Sym6 stress = entry(particles.stress, p, Sym6{0, 0, 0, 0, 0, 0});
        const double stiffness =
            particles.mass[p] / particles.reference_volume[p] * law.wave_speed_squared(rest, history);
        const Sym6 sigma = law.stress(rest, history);
        double off = 0;
        for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(sigma[i] - stress[i]));
        return off <= 1e-12 * stiffness;
      },
      laws[particles.material[p]]);
}

}  // namespace

std::optional<std::string> NodalBody::obstacle(const Model& model, const TotalBody& body, bool average) {
  const bool mixed =
      std::any_of(body.tasks.begin(), body.tasks.end(), [](const CellTask& t) { return t.material < 0; });
  if (average && mixed) return "cells of several materials see one mean volume ratio";
  if (model.water) return "the water's force is one of its particles' places";
  const auto kernels = kernels_of(model);
  const Particles& particles = model.particles;
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const NamedMaterial& material = model.materials[particles.material[p]];
    if (!kernels[particles.material[p]]) return "material '" + material.name + "' has no kernel";
    const Vec3& X = particles.reference_position[p];
    if (entry(particles.deformation_gradient, p, kIdentity) != kIdentity || entry(particles.position, p, X) != X)
      return "the body starts deformed";
    if (!stress_is_of_law(particles, body.laws, p)) return "the stress at the start is not that of the law";
  }
  return std::nullopt;
}

void NodalBody::fill_history() {
  history_.assign(layout_.history, 0);
  for (std::size_t s = 0; s < layout_.segments.size(); ++s) {
    const Segment& segment = layout_.segments[s];
    const int fields = history_fields(laws_[segment.law].kind, layout_.dimension), tensor = fields - 2;
    if (fields == 0) continue;
    for (int i = 0; i < segment.places * kSegment; ++i) {
      const std::uint32_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(i)];
      const PointHistory start = p == NodalLayout::kEmpty ? PointHistory{} : start_history(model_.particles, p);
      double* history =
          &history_[segment.history + static_cast<std::size_t>(i / kSegment * fields * kSegment + i % kSegment)];
      for (int f = 0; f < tensor; ++f) history[f * kSegment] = start.elastic_left_cauchy_green[f];
      history[tensor * kSegment] = start.equivalent_plastic_strain;
      history[(tensor + 1) * kSegment] = start.plastic_work;
    }
  }
}

template <int D, class F>
void NodalBody::scatter_segments(double* const (&field)[3], F&& value) const {
  using Cell = LinearCell<D>;
  for (std::size_t s = 0; s < layout_.segments.size(); ++s) {
    const Segment& segment = layout_.segments[s];
    for (int i = 0; i < segment.places * kSegment; ++i) {
      const std::uint32_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(i)];
      if (p == NodalLayout::kEmpty) continue;
      const int lane = i % kSegment;
      typename Cell::Values m, weights{};
      Cell::monomials(place_in_cell(layout_, segment, i / kSegment, lane), m);
      Cell::add_value(weights, m, 1);
      Cell::to_corners(weights);
      const Vec3 f = value(static_cast<std::size_t>(p));
      for (int k = 0; k < Cell::N; ++k)
        for (int c = 0; c < D; ++c) field[c][corner_node<D>(segment, lane, k)] += weights[k] * f[c];
    }
  }
}

void NodalBody::scatter(double* const (&field)[3], const std::function<Vec3(std::size_t)>& value) const {
  layout_.dimension == 2 ? scatter_segments<2>(field, value) : scatter_segments<3>(field, value);
}

/// Of the particles [begin, end) of the model that `block` holds.
void NodalBody::write_segment(Particles& block, std::size_t begin, std::size_t end, std::size_t s) const {
  const Segment& segment = layout_.segments[s];
  const auto kernel = kernels_.states[static_cast<int>(laws_[segment.law].kind)][layout_.dimension - 2][average_];
  std::vector<kernels::PointState> places(segment.places);
  kernel(stress_sweep_of(const_cast<double*>(history_.data()), false), segment, places.data());
  const int fields = history_fields(laws_[segment.law].kind, layout_.dimension);
  for (int place = 0; place < segment.places; ++place)
    for (int lane = 0; lane < kSegment; ++lane) {
      const std::uint32_t slot =
          layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(place * kSegment + lane)];
      if (slot == NodalLayout::kEmpty || slot < begin || slot >= end) continue;
      const std::size_t p = slot - begin;
      const kernels::PointState& state = places[static_cast<std::size_t>(place)];
      const Vec3& v0 = start_velocity_[start_velocity_.size() == 1 ? 0 : slot - body_.begin];
      for (int d = 0; d < layout_.dimension; ++d) {
        block.position[p][d] = block.reference_position[p][d] + state.displacement[d][lane];
        block.velocity[p][d] = share_ * v0[d] + state.velocity[d][lane];
      }
      for (int i = 0; i < 9; ++i) block.deformation_gradient[p][i] = state.F[i][lane];
      for (int i = 0; i < 6; ++i) block.elastic_left_cauchy_green[p][i] = state.b_e[i][lane];
      if (determinant(block.deformation_gradient[p]) > 0)
        for (int i = 0; i < 6; ++i) block.stress[p][i] = state.stress[i][lane];
      if (fields == 0) continue;
      const double* history =
          &history_[segment.history + static_cast<std::size_t>((place + 1) * fields * kSegment + lane)];
      block.equivalent_plastic_strain[p] = history[-2 * kSegment];
      block.plastic_work[p] = history[-kSegment];
    }
}

void NodalBody::write(Particles& particles, int threads) const { write(particles, 0, particles.size(), threads); }

void NodalBody::write(Particles& block, std::size_t begin, std::size_t end, int threads) const {
  // Segments of the same cells have the same first particle.
  const auto& first = layout_.first;
  const auto after = std::lower_bound(first.begin(), first.end(), end);
  const auto holds = std::upper_bound(first.begin(), after, begin);
  const auto from = holds == first.begin() ? holds : std::lower_bound(first.begin(), holds, *(holds - 1));
  const auto offset = static_cast<std::size_t>(from - first.begin());
  parallel_for(static_cast<std::size_t>(after - from), threads,
               [&](std::size_t i) { write_segment(block, begin, end, offset + i); });
}

StepLimit NodalBody::step_limit() const {
  StepLimit limit;
  double most = -1;
  const std::uint32_t* slots = &layout_.slots[layout_.slot_begin[stiffest_]];
  Particles cell;
  for (int lane = 0; lane < kSegment; ++lane) {
    std::uint32_t begin = NodalLayout::kEmpty, end = 0;  // of one material in a cell: they stand together
    for (int place = 0; place < layout_.segments[stiffest_].places; ++place) {
      const std::uint32_t p = slots[place * kSegment + lane];
      if (p == NodalLayout::kEmpty) continue;
      begin = std::min(begin, p);
      end = std::max(end, p + 1);
    }
    if (end == 0) continue;
    copy_particles(model_.particles, begin, end, cell);
    complete_state(cell);
    write(cell, begin, end, 1);
    look_at_cell(limit, most, cell, body_.laws, 0, end - begin);
  }
  return limit;
}

/// The first particle of a segment that is turned inside out, else the first of which something is not finite.
std::int64_t NodalBody::find_bad_particle(std::size_t s) const {
  const Segment& segment = layout_.segments[s];
  const auto deformation = [&](int lane, int place) {
    const Vec3 xi = place_in_cell(layout_, segment, place, lane);
    if (layout_.dimension == 2) {
      LinearCell<2>::Values U[2], m;
      gather<2>(nodes_.U, segment, lane, U);
      LinearCell<2>::monomials(xi, m);
      return gradient<2>(U, m, 1 / layout_.cell);
    }
    LinearCell<3>::Values U[3], m;
    gather<3>(nodes_.U, segment, lane, U);
    LinearCell<3>::monomials(xi, m);
    return gradient<3>(U, m, 1 / layout_.cell);
  };
  std::int64_t inverted = -1, not_finite = -1, first = -1;
  for (int place = 0; place < segment.places; ++place)
    for (int lane = 0; lane < kSegment; ++lane) {
      const std::uint32_t slot =
          layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(place * kSegment + lane)];
      if (slot == NodalLayout::kEmpty) continue;
      const double J = determinant(deformation(lane, place));
      const std::int64_t p = slot;
      const auto note = [p](std::int64_t& least) { least = least < 0 ? p : std::min(least, p); };
      note(first);
      if (!std::isfinite(J))
        note(not_finite);
      else if (J <= 0)
        note(inverted);
    }
  return inverted >= 0 ? inverted : not_finite >= 0 ? not_finite : first;
}

}  // namespace scarp
