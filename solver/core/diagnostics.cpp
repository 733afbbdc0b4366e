// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/diagnostics.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/history.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// Strain and plastic energy of [begin, end), all of one law.
template <class Law>
void add_material_energy(HistorySample& sum, const Particles& particles, const Law& law, std::size_t begin,
                         std::size_t end) {
  for (std::size_t p = begin; p < end; ++p) {
    const PointHistory history = load_history<Law>(particles, p);
    const Mat3& F = particles.deformation_gradient[p];
    sum.strain += particles.reference_volume[p] * law.stored_energy(make_motion(F, F), history);
    if constexpr (Law::has_history) sum.plastic += particles.reference_volume[p] * history.plastic_work;
  }
}

/// Of particles of one body.
HistorySample measure_range(const Particles& particles, const std::vector<PreparedLaw>& laws, const Vec3& gravity,
                            std::size_t begin, std::size_t end) {
  HistorySample sum;
  for (std::size_t p = begin; p < end; ++p) {
    const double mass = particles.mass[p];
    const Vec3& v = particles.velocity[p];
    sum.kinetic += 0.5 * mass * dot(v, v);
    sum.potential -= mass * dot(gravity, particles.position[p] - particles.reference_position[p]);
    sum.momentum = sum.momentum + mass * v;
  }
  for (std::size_t p = begin, next = p; p < end; p = next) {
    while (next < end && particles.material[next] == particles.material[p]) ++next;
    std::visit([&](const auto& law) { add_material_energy(sum, particles, law, p, next); },
               laws[particles.material[p]]);
  }
  return sum;
}

/// f(begin, end) of the parts of bodies that deform in a block of particles.
template <class F>
void each_part(const Model& model, std::size_t block, F&& f) {
  const std::size_t begin = block * kReductionBlock, end = begin + kReductionBlock;
  for (const Body& body : model.bodies)
    if (body.formulation != Formulation::rigid && body.begin < end && body.end > begin)
      f(std::max(begin, body.begin), std::min(end, body.end));
}

}  // namespace

Diagnostics::Diagnostics(const Model& model, const RigidBodies* rigid)
    : blocks_((model.particles.size() + kReductionBlock - 1) / kReductionBlock), rigid_(rigid) {
  const Particles& particles = model.particles;
  Vec3 moment{0, 0, 0};
  for (const Body& body : model.bodies)
    for (std::size_t p = body.begin; p < body.end && body.formulation != Formulation::rigid; ++p) {
      mass_ += particles.mass[p];
      moment = moment + particles.mass[p] * particles.reference_position[p];
    }
  each_free([&](const RigidBody& body) {
    mass_ += body.inertia.mass;
    moment = moment + body.inertia.mass * body.reference_centre;
  });
  reference_centre_ = (1 / mass_) * moment;
}

HistorySample Diagnostics::measure(const Model& model, const std::vector<PreparedLaw>& laws, const Vec3& gravity,
                                   int threads) {
  parallel_for(blocks_.size(), threads, [&](std::size_t b) {
    blocks_[b] = {};
    each_part(model, b, [&](std::size_t begin, std::size_t end) {
      add(blocks_[b], measure_range(model.particles, laws, gravity, begin, end));
    });
  });
  HistorySample sum;
  for (const HistorySample& block : blocks_) add(sum, block);
  sum.total = sum.kinetic + sum.strain + sum.plastic + sum.potential;
  return sum;
}

void Diagnostics::add_motion(HistorySample& sample, const Model& model, int threads) {
  const Particles& particles = model.particles;
  parallel_for(blocks_.size(), threads, [&](std::size_t b) {
    HistorySample& block = blocks_[b] = {};
    each_part(model, b, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        const Vec3 moment = particles.mass[p] * (particles.position[p] - reference_centre_);
        block.angular_momentum = block.angular_momentum + cross(moment, particles.velocity[p]);
        block.centre = block.centre + moment;
      }
    });
  });
  Vec3 moment{0, 0, 0};
  sample.angular_momentum = {0, 0, 0};
  for (const HistorySample& block : blocks_) {
    sample.angular_momentum = sample.angular_momentum + block.angular_momentum;
    moment = moment + block.centre;
  }
  each_free(
      [&](const RigidBody& body) { moment = moment + body.inertia.mass * (body.now.centre - reference_centre_); });
  if (rigid_) rigid_->add_to(sample, reference_centre_);
  sample.centre = reference_centre_ + (1 / mass_) * moment;
}

void add(HistorySample& sum, const HistorySample& part) {
  sum.kinetic += part.kinetic;
  sum.strain += part.strain;
  sum.plastic += part.plastic;
  sum.potential += part.potential;
  sum.momentum = sum.momentum + part.momentum;
  sum.total += part.total;
}

void add_work(HistorySample& sample, const NodeWork& work) {
  sample.friction = work.friction;
  sample.damping = work.damping;
  sample.external = work.external;
  sample.total += work.friction + work.damping - work.external;
}

double largest_displacement(const ParticleStates& states) {
  double largest = 0;
  states.each_block([&](const Particles& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      largest = std::max(largest, norm(particles.position[p] - particles.reference_position[p]));
  });
  return largest;
}

Failure describe_bad_particle(const Particles& particles, std::int64_t index) {
  const Mat3& F = particles.deformation_gradient[index];
  const double J = determinant(F);
  Failure failure;
  failure.what = std::isfinite(J) && J <= 0 ? "a particle is turned inside out (J = det F <= 0)"
                                            : "the deformation or the stress of a particle is not finite";
  failure.particle = particles.id[index];
  failure.position = particles.position[index];
  return failure;
}

}  // namespace scarp
