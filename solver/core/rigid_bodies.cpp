// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/rigid_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/loads.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// Turn of a free body per step, at most.
constexpr double kMostTurn = 0.1;

/// Rotation by `angle` about a unit axis (Rodrigues).
Mat3 rotation(const Vec3& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {c + d * n[0] * n[0],        d * n[0] * n[1] - s * n[2], d * n[0] * n[2] + s * n[1],
          d * n[1] * n[0] + s * n[2], c + d * n[1] * n[1],        d * n[1] * n[2] - s * n[0],
          d * n[2] * n[0] - s * n[1], d * n[2] * n[1] + s * n[0], c + d * n[2] * n[2]};
}

Vec3 times(const Mat3& A, const Vec3& x) {
  return {A[0] * x[0] + A[1] * x[1] + A[2] * x[2], A[3] * x[0] + A[4] * x[1] + A[5] * x[2],
          A[6] * x[0] + A[7] * x[1] + A[8] * x[2]};
}

/// Columns made orthogonal and of unit length again: what rounding takes from them in a step.
Mat3 orthonormal(const Mat3& A) {
  Vec3 u{A[0], A[3], A[6]}, v{A[1], A[4], A[7]};
  u = (1 / norm(u)) * u;
  v = v - dot(u, v) * u;
  v = (1 / norm(v)) * v;
  const Vec3 w = cross(u, v);
  return {u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2]};
}

Vec3 divide(const Vec3& a, const Vec3& b) { return {a[0] / b[0], a[1] / b[1], a[2] / b[2]}; }

double density_of(const Model& model, const Body& body) {
  const Particles& p = model.particles;
  return p.mass[body.begin] / p.reference_volume[body.begin];
}

/// Along an axis of the domain, and so on a face of it for good.
bool stays_at(const Body& body, const Vec3& velocity, int axis) {
  if (body.rigid.motion == RigidMotion::fixed) return true;
  return body.rigid.motion == RigidMotion::given && body.rigid.angular_velocity == 0 && velocity[axis] == 0;
}

/// What of the boundary others can meet. Where it lies on a face of the domain, and stays there, nothing is beyond it:
/// it is no surface, and what is inside has been pushed in from elsewhere.
TriangleMesh met_surface(const Model& model, const Body& body) {
  const Domain& domain = model.domain;
  const double slack = 1e-6 * domain.cell;
  TriangleMesh met = body.boundary;
  const auto on_face = [&](const std::array<std::uint32_t, 3>& t, int axis, bool upper) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      const double x = body.boundary.vertices[v][axis];
      return upper ? x >= domain.max[axis] - slack : x <= domain.min[axis] + slack;
    });
  };
  std::erase_if(met.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    for (int axis = 0; axis < domain.dimension; ++axis)
      if (stays_at(body, model.particles.velocity[body.begin], axis) &&
          (on_face(t, axis, false) || on_face(t, axis, true)))
        return true;
    return false;
  });
  return met.triangles.empty() ? body.boundary : met;
}

Vec3 axis_of(const RigidOptions& options) {
  const Vec3 axis = options.axis.value_or(Vec3{0, 0, 1});
  return (1 / norm(axis)) * axis;
}

[[noreturn]] void refuse(const Body& body, const std::string& what, const std::string& value,
                         const std::string& allowed) {
  throw Error("solve", what + " of rigid body '" + body.name + "'", value, allowed);
}

void check_free(const Model& model, const Body& body) {
  if (!body.rigid.table.empty() || body.rigid.about)
    refuse(body, "table or about", "given", "none with motion = \"free\"");
  if (!body.rigid.grips.empty()) refuse(body, "grips", "given", "none with motion = \"free\"");
  const double density = density_of(model, body);
  for (std::size_t p = body.begin; p < body.end; ++p)
    if (std::abs(model.particles.mass[p] / model.particles.reference_volume[p] - density) > 1e-9 * density)
      refuse(body, "densities", "several", "one with motion = \"free\"");
}

void check(const Model& model, const Body& body) {
  const RigidOptions& options = body.rigid;
  const bool turns = options.angular_velocity != 0;
  if (!std::isfinite(options.angular_velocity))
    refuse(body, "angular_velocity", shortest(options.angular_velocity), "a finite number of 1/s");
  if (options.axis && !(is_finite(*options.axis) && norm(*options.axis) > 0))
    refuse(body, "axis", "", "a direction of some length");
  if (options.axis && model.domain.dimension == 2) refuse(body, "axis", "given", "none in plane strain: it is z");
  check_table(options.table, "rigid body '" + body.name + "'");
  if (!(options.surface.friction >= 0) || !std::isfinite(options.surface.friction))
    refuse(body, "friction", shortest(options.surface.friction), "0 or above");
  const Vec3 velocity = model.particles.velocity[body.begin];
  for (std::size_t p = body.begin; p < body.end; ++p)
    if (model.particles.velocity[p] != velocity)
      refuse(body, "velocities of the particles", "not the same", "one velocity: no velocity_field");
  if (options.motion == RigidMotion::free) check_free(model, body);
  if (options.motion == RigidMotion::fixed && (turns || norm(velocity) > 0 || !options.table.empty()))
    refuse(body, "velocity, angular_velocity or table", "given", "none with motion = \"fixed\"");
  if (options.motion == RigidMotion::given && !turns && norm(velocity) == 0)
    refuse(body, "velocity and angular_velocity", "0", "one that is not, or motion = \"fixed\"");
}

}  // namespace

Vec3 RigidBody::place(const RigidState& state, const Vec3& X) const {
  return state.centre + times(state.turn, X - reference_centre);
}

Vec3 RigidBody::material_point(const RigidState& state, const Vec3& x) const {
  return reference_centre + times(transpose(state.turn), x - state.centre);
}

std::optional<SignedDistance::Foot> RigidBody::foot(const Vec3& x, double max_distance) const {
  std::optional<SignedDistance::Foot> foot = surface.at(material_point(now, x), max_distance);
  if (foot) foot->normal = times(now.turn, foot->normal);
  return foot;
}

std::array<Vec3, 8> RigidBody::corners(const RigidState& state) const {
  const Box3& b = surface.bounds();
  std::array<Vec3, 8> places;
  for (std::size_t k = 0; k < 8; ++k)
    places[k] = place(state, {k & 1 ? b.max[0] : b.min[0], k & 2 ? b.max[1] : b.min[1], k & 4 ? b.max[2] : b.min[2]});
  return places;
}

void RigidBody::push(const Vec3& x, const Vec3& force) {
  wrench.force = wrench.force + force;
  wrench.moment = wrench.moment + cross(x - now.centre, force);
}

void RigidBody::stiffen(const Vec3& x, double stiffness) {
  if (free) stiffness_per_mass += stiffness * mobility(norm(x - now.centre));
}

double RigidBody::mobility(double arm) const {
  const double least = std::min({inertia.moments[0], inertia.moments[1], inertia.moments[2]});
  return 1 / inertia.mass + arm * arm / least;
}

double RigidBody::longest_arm() const {
  double arm = 0;
  for (const Vec3& x : corners(now)) arm = std::max(arm, norm(x - now.centre));
  return surface.is_ball() && free ? surface.radius() : arm;
}

RigidBodies::RigidBodies(const Model& model, const StepOptions& options) : model_(model), options_(options) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].formulation == Formulation::rigid) add(static_cast<std::int32_t>(b));
}

void RigidBodies::add(std::int32_t index) {
  const Body& body = model_.bodies[index];
  check(model_, body);
  if (body.boundary.triangles.empty()) refuse(body, "boundary", "none", "a closed surface");
  RigidBody rigid(SignedDistance(met_surface(model_, body), body.ball_radius, model_.domain.dimension == 2));
  rigid.body = index;
  rigid.kind = body.rigid.surface;
  rigid.given_velocity = model_.particles.velocity[body.begin];
  rigid.moves = body.rigid.motion != RigidMotion::fixed;
  rigid.free = body.rigid.motion == RigidMotion::free;
  rigid.reference_centre = body.rigid.about.value_or(rigid.surface.centre());
  if (rigid.free) {
    rigid.inertia = mass_properties(body.boundary, body.ball_radius, density_of(model_, body), model_.domain.dimension);
    rigid.reference_centre = rigid.inertia.centre;
    const Vec3 omega = body.rigid.angular_velocity * axis_of(body.rigid);
    const Vec3 local = times(transpose(rigid.inertia.axes), omega), &I = rigid.inertia.moments;
    rigid.angular_momentum = times(rigid.inertia.axes, Vec3{I[0] * local[0], I[1] * local[1], I[2] * local[2]});
    rigid.now = {rigid.reference_centre, kIdentity, rigid.given_velocity, omega};
  } else {
    rigid.now = given_state(rigid, 0);
  }
  rigid.before = rigid.now;
  bodies_.push_back(std::move(rigid));
}

RigidState RigidBodies::given_state(const RigidBody& rigid, double time) const {
  const Body& body = model_.bodies[rigid.body];
  RigidState state;
  state.centre = rigid.reference_centre;
  if (body.rigid.motion == RigidMotion::fixed || still_) return state;
  const Vec3 axis = axis_of(body.rigid), velocity = rigid.given_velocity;
  const double factor = factor_at(body.rigid.table, time), integral = integral_of_factor(body.rigid.table, time);
  state.centre = state.centre + integral * velocity;
  state.turn = rotation(axis, integral * body.rigid.angular_velocity);
  state.velocity = factor * velocity;
  state.angular_velocity = (factor * body.rigid.angular_velocity) * axis;
  return state;
}

bool RigidBodies::move() const {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const RigidBody& body) { return body.moves; });
}

double RigidBodies::time_to_go(double distance) const {
  double least = INFINITY;
  const auto within = [&](double time) { least = std::min(least, time); };
  for (const RigidBody& body : bodies_) {
    const double arm = body.longest_arm(), turning = norm(body.now.angular_velocity),
                 speed = norm(body.now.velocity) + turning * arm;
    if (speed > 0) within(distance / speed);
    if (!body.free) continue;
    const Vec3& I = body.inertia.moments;
    const double acceleration = norm(options_.gravity + (1 / body.inertia.mass) * body.wrench.force) +
                                norm(body.wrench.moment) / std::min({I[0], I[1], I[2]}) * arm;
    if (acceleration > 0) within(std::sqrt(2 * distance / acceleration));
    if (turning > 0) within(kMostTurn / turning);
  }
  return least;
}

void RigidBodies::step(double time, double dt) {
  last_step_ = dt;
  const Vec3 gravity = options_.gravity_at(time, dt);
  for (RigidBody& body : bodies_) {
    body.before = body.now;
    if (!body.free)
      body.now = given_state(body, time + dt);
    else if (!still_)
      step_free(body, gravity, dt);
  }
}

void RigidBodies::step_free(RigidBody& body, const Vec3& gravity, double dt) {
  RigidState& now = body.now;
  const MassProperties& inertia = body.inertia;
  now.velocity = now.velocity + dt * (gravity + (1 / inertia.mass) * body.wrench.force);
  now.centre = now.centre + dt * now.velocity;
  external_ += dt * inertia.mass * dot(gravity - options_.gravity, now.velocity);
  body.angular_momentum = body.angular_momentum + dt * body.wrench.moment;
  // From the principal axes to space, and L along the axes: a turn about one of them changes both.
  Mat3 Q = scarp::multiply(now.turn, inertia.axes);
  Vec3 local = times(transpose(Q), body.angular_momentum);
  const auto turn = [&](std::size_t axis, double time) {
    Vec3 n{0, 0, 0};
    n[axis] = 1;
    const Mat3 R = rotation(n, time * local[axis] / inertia.moments[axis]);
    Q = scarp::multiply(Q, R);
    local = times(transpose(R), local);
  };
  for (const auto& [axis, share] : {std::pair{0u, 0.5}, {1u, 0.5}, {2u, 1.0}, {1u, 0.5}, {0u, 0.5}})
    turn(axis, share * dt);
  Q = orthonormal(Q);
  now.turn = scarp::multiply(Q, transpose(inertia.axes));
  now.angular_velocity = times(Q, divide(times(transpose(Q), body.angular_momentum), inertia.moments));
}

void RigidBodies::hold_still(bool still) {
  still_ = still;
  external_ = 0;
  if (still)
    options_.begin_relaxing();
  else
    options_.rest();
  for (RigidBody& body : bodies_) {
    if (!body.free) body.now = given_state(body, 0);
    body.before = body.now;
    body.impulse = {0, 0, 0};
  }
}

void RigidBodies::write(Particles& particles) const {
  for (const RigidBody& rigid : bodies_) {
    const Body& body = model_.bodies[rigid.body];
    for (std::size_t p = body.begin; p < body.end; ++p) {
      particles.position[p] = rigid.place(rigid.now, particles.reference_position[p]);
      particles.velocity[p] = rigid.now.velocity_at(particles.position[p]);
      particles.deformation_gradient[p] = rigid.now.turn;
    }
  }
}

std::vector<Vec3> RigidBodies::take_impulse() {
  std::vector<Vec3> impulse(model_.bodies.size(), Vec3{0, 0, 0});
  for (RigidBody& body : bodies_) impulse[body.body] = std::exchange(body.impulse, Vec3{0, 0, 0});
  return impulse;
}

void RigidBodies::begin_contact() {
  for (RigidBody& body : bodies_) {
    body.wrench_before = body.wrench;
    body.wrench = {};
    body.stiffness_per_mass = 0;
  }
}

/// By the mean of the forces at both ends of the step, on the way between.
void RigidBodies::count_work() {
  for (const RigidBody& body : bodies_) {
    if (body.free) continue;
    const Vec3 force = 0.5 * (body.wrench.force + body.wrench_before.force),
               moment = 0.5 * (body.wrench.moment + body.wrench_before.moment);
    const Vec3 way = body.now.centre - body.before.centre,
               turn = (0.5 * last_step_) * (body.now.angular_velocity + body.before.angular_velocity);
    external_ -= dot(force, way) + dot(moment, turn);
  }
}

void RigidBodies::add_to(HistorySample& sample, const Vec3& about) const {
  for (const RigidBody& body : bodies_) {
    if (!body.free) continue;
    const double m = body.inertia.mass;
    const Vec3& v = body.now.velocity;
    const double kinetic = 0.5 * m * dot(v, v) + 0.5 * dot(body.angular_momentum, body.now.angular_velocity);
    const double potential = -m * dot(options_.gravity, body.now.centre - body.reference_centre);
    sample.kinetic += kinetic;
    sample.potential += potential;
    sample.total += kinetic + potential;
    sample.momentum = sample.momentum + m * v;
    sample.angular_momentum = sample.angular_momentum + cross(body.now.centre - about, m * v) + body.angular_momentum;
  }
}

}  // namespace scarp
