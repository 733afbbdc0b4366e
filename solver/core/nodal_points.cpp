// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NodalBody where it meets particles: what they bring at the start, and their state when someone asks for it.
#include <algorithm>
#include <cmath>

#include "solver/core/f_bar.hpp"
#include "solver/core/law_kernels.hpp"
#include "solver/core/linear_cell.hpp"
#include "solver/core/nodal_body.hpp"
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

/// Whether the stress of a particle at rest is the one that its law finds.
bool stress_is_of_law(const Particles& particles, const std::vector<PreparedLaw>& laws, std::size_t p) {
  return std::visit(
      [&](const auto& law) {
        const Motion rest = make_motion(kIdentity, kIdentity);
        PointHistory history{particles.elastic_left_cauchy_green[p], particles.equivalent_plastic_strain[p],
                             particles.plastic_work[p]};
        const double stiffness =
            particles.mass[p] / particles.reference_volume[p] * law.wave_speed_squared(rest, history);
        const Sym6 sigma = law.stress(rest, history);
        double off = 0;
        for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(sigma[i] - particles.stress[p][i]));
        return off <= 1e-12 * stiffness;
      },
      laws[particles.material[p]]);
}

}  // namespace

std::optional<std::string> NodalBody::obstacle(const Model& model, const TotalBody& body) {
  const bool mixed =
      std::any_of(body.tasks.begin(), body.tasks.end(), [](const CellTask& t) { return t.material < 0; });
  if (!body.since.empty() && mixed) return "cells of several materials see one mean volume ratio";
  if (model.water) return "the water's force is one of its particles' places";
  const auto kernels = kernels_of(model);
  const Particles& particles = model.particles;
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const NamedMaterial& material = model.materials[particles.material[p]];
    if (!kernels[particles.material[p]]) return "material '" + material.name + "' has no kernel";
    if (particles.deformation_gradient[p] != kIdentity || particles.position[p] != particles.reference_position[p])
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
      const std::int64_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(i)];
      double* history =
          &history_[segment.history + static_cast<std::size_t>(i / kSegment * fields * kSegment + i % kSegment)];
      for (int f = 0; f < tensor; ++f)
        history[f * kSegment] = p < 0 ? (f < 3 ? 1 : 0) : model_.particles.elastic_left_cauchy_green[p][f];
      if (p < 0) continue;
      history[tensor * kSegment] = model_.particles.equivalent_plastic_strain[p];
      history[(tensor + 1) * kSegment] = model_.particles.plastic_work[p];
    }
  }
}

PointHistory NodalBody::history_at(std::size_t s, int place, int lane, const Mat3& F) const {
  const Segment& segment = layout_.segments[s];
  const int fields = history_fields(laws_[segment.law].kind, layout_.dimension), tensor = fields - 2;
  PointHistory history;
  if (fields == 0) return history;
  const double* stored = &history_[segment.history + static_cast<std::size_t>(place * fields * kSegment + lane)];
  Sym6 plastic{};
  for (int f = 0; f < tensor; ++f) plastic[f] = stored[f * kSegment];
  history.elastic_left_cauchy_green = push_forward(F, plastic);
  history.equivalent_plastic_strain = stored[tensor * kSegment];
  history.plastic_work = stored[(tensor + 1) * kSegment];
  return history;
}

template <int D, class F>
void NodalBody::scatter_segments(double* const (&field)[3], F&& value) const {
  using Cell = LinearCell<D>;
  for (std::size_t s = 0; s < layout_.segments.size(); ++s) {
    const Segment& segment = layout_.segments[s];
    for (int i = 0; i < segment.places * kSegment; ++i) {
      const std::int64_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(i)];
      if (p < 0) continue;
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

/// Mean of det F over the points of a cell, weighted by V0.
template <int D>
double NodalBody::mean_volume(std::size_t s, int lane) const {
  const Segment& segment = layout_.segments[s];
  typename LinearCell<D>::Values U[D], m;
  gather<D>(nodes_.U, segment, lane, U);
  double volume = 0, deformed = 0;
  for (int place = 0; place < segment.places; ++place) {
    const std::int64_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(place * kSegment + lane)];
    if (p < 0) continue;
    LinearCell<D>::monomials(place_in_cell(layout_, segment, place, lane), m);
    const double V0 = model_.particles.reference_volume[static_cast<std::size_t>(p)];
    volume += V0;
    deformed += V0 * determinant(gradient<D>(U, m, 1 / layout_.cell));
  }
  return volume > 0 ? deformed / volume : 1;
}

template <int D, bool whole>
void NodalBody::write_segment(Particles& particles, std::size_t s) const {
  using Cell = LinearCell<D>;
  const Segment& segment = layout_.segments[s];
  const std::int64_t* slots = &layout_.slots[layout_.slot_begin[s]];
  for (int lane = 0; lane < kSegment; ++lane) {
    const double J_cell = whole && average_ ? mean_volume<D>(s, lane) : 0;
    typename Cell::Values U[D], W[D], A[D], m;
    bool gathered = false;
    for (int place = 0; place < segment.places; ++place) {
      const std::int64_t p = slots[place * kSegment + lane];
      if (p < 0) continue;
      if (!gathered) {
        if constexpr (whole) gather<D>(nodes_.U, segment, lane, U);
        gather<D>(nodes_.W, segment, lane, W);
        gather<D>(nodes_.A, segment, lane, A);
        gathered = true;
      }
      Cell::monomials(place_in_cell(layout_, segment, place, lane), m);
      const std::size_t in_body = static_cast<std::size_t>(p) - body_.begin;
      const Vec3& v0 = start_velocity_[start_velocity_.size() == 1 ? 0 : in_body];
      for (int d = 0; d < D; ++d) {
        particles.position[p][d] = particles.reference_position[p][d] + Cell::value(W[d], m);
        particles.velocity[p][d] = share_ * v0[d] + Cell::value(A[d], m);
      }
      if constexpr (!whole) continue;
      Mat3 F = gradient<D>(U, m, 1 / layout_.cell);
      if (average_) F = dilated<D>(F, dilation<D>(J_cell / determinant(F)));
      particles.deformation_gradient[p] = F;
      PointHistory history = history_at(s, place, lane, F);
      particles.elastic_left_cauchy_green[p] = history.elastic_left_cauchy_green;
      particles.equivalent_plastic_strain[p] = history.equivalent_plastic_strain;
      particles.plastic_work[p] = history.plastic_work;
      // Without a step the law finds the stress that goes with the history.
      const Motion motion = make_motion(F, F);
      if (motion.J > 0)
        particles.stress[p] =
            std::visit([&](const auto& law) { return law.stress(motion, history); }, body_.laws[particles.material[p]]);
    }
  }
}

void NodalBody::write(Particles& particles, int threads) const {
  parallel_for(layout_.segments.size(), threads, [&](std::size_t s) {
    layout_.dimension == 2 ? write_segment<2, true>(particles, s) : write_segment<3, true>(particles, s);
  });
}

void NodalBody::write_motion(Particles& particles, int threads) const {
  parallel_for(layout_.segments.size(), threads, [&](std::size_t s) {
    layout_.dimension == 2 ? write_segment<2, false>(particles, s) : write_segment<3, false>(particles, s);
  });
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
      const std::int64_t p = layout_.slots[layout_.slot_begin[s] + static_cast<std::size_t>(place * kSegment + lane)];
      if (p < 0) continue;
      const double J = determinant(deformation(lane, place));
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
