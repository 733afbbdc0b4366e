// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/grid_contact.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/node_step.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

constexpr std::size_t kPlacesPerTask = 64;

/// Sweeps over the pairs of a place, and the change of an impulse, against the largest one, at which they agree.
constexpr int kSweeps = 100;
constexpr double kAgree = 1e-12;

/// Velocity of a node per impulse, kg^-1; none along axes on which it does not move freely.
Vec3 mobility(const UpdatedGrid& grid, std::uint32_t node) {
  const double w = 1 / grid.mass[node];
  return free_part({w, w, w}, grid.kept[node]);
}

Vec3 times(const Vec3& a, const Vec3& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// The impulse on b, of all so far, that lets a come nearer to b by `allowed` at most, given their velocities and
/// mobilities after the impulse `sum`.
/// @param pull  impulse that adhesion bears along n, N s
Vec3 pressed(const Vec3& n, double friction, double pull, double allowed, const Vec3& sum, const Vec3& sliding,
             const Vec3& yields) {
  const double normal_yield = dot(times(n, n), yields);
  if (!(normal_yield > 0)) return sum;
  const double before = dot(sum, n), press = std::max(-pull, before + (dot(sliding, n) - allowed) / normal_yield);
  Vec3 across{0, 0, 0};
  if (friction > 0) {
    const Vec3 slid = sliding - (press - before) * times(n, yields);
    const Vec3 along = slid - dot(slid, n) * n;
    const double square = dot(along, along), yield = dot(times(along, along), yields);
    across = sum - before * n;
    if (yield > 0) across = across + (square / yield) * along;
    const double size = norm(across), most = friction * (press + pull);
    if (size > most) across = (most / size) * across;
  }
  return press * n + across;
}

}  // namespace

template <class Allowed>
void GridContact::bind(UpdatedGrid& grid, std::vector<Vec3>& velocity, bool rubs, double dt, int threads,
                       Allowed&& allowed) {
  parallel_for((places_.size() + kPlacesPerTask - 1) / kPlacesPerTask, threads, [&](std::size_t t) {
    for (std::size_t i = t * kPlacesPerTask; i < std::min(places_.size(), (t + 1) * kPlacesPerTask); ++i) {
      const Place& place = places_[i];
      for (std::uint32_t k = place.pair_begin; k < place.pair_end; ++k) pairs_[k].impulse = {0, 0, 0};
      for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double change = 0, largest = 0;
        for (std::uint32_t k = place.pair_begin; k < place.pair_end; ++k) {
          Pair& pair = pairs_[k];
          if (pair.n == Vec3{0, 0, 0}) continue;
          const std::uint32_t a = place_nodes_[pair.a].node, b = place_nodes_[pair.b].node;
          if (!(grid.mass[a] > grid.light_mass && grid.mass[b] > grid.light_mass)) continue;
          const Vec3 wa = mobility(grid, a), wb = mobility(grid, b);
          const Vec3 next = pressed(pair.n, rubs ? pair.law.friction : 0, rubs ? dt * pair.pull : 0,
                                    allowed(pair, a, b), pair.impulse, velocity[a] - velocity[b], wa + wb);
          const Vec3 more = next - pair.impulse;
          if (more == Vec3{0, 0, 0}) continue;
          velocity[a] = velocity[a] - times(wa, more);
          velocity[b] = velocity[b] + times(wb, more);
          pair.impulse = next;
          change = std::max(change, norm(more));
          largest = std::max(largest, norm(next));
        }
        if (!(change > kAgree * largest)) break;
      }
    }
  });
}

void GridContact::hold(UpdatedGrid& grid, double dt, int threads) {
  bind(grid, grid.velocity, false, dt, threads,
       [&](const Pair& pair, std::uint32_t, std::uint32_t) { return std::max(0.0, pair.gap) / dt; });
}

void GridContact::hold_after(UpdatedGrid& grid, double dt, int threads) {
  bind(grid, grid.velocity, false, dt, threads, [&](const Pair& pair, std::uint32_t a, std::uint32_t b) {
    const double closed = dt * dot(grid.velocity_updated[a] - grid.velocity_updated[b], pair.n);
    return std::max(0.0, pair.gap - closed) / dt;
  });
}

double GridContact::act(UpdatedGrid& grid, double dt, double handed, int threads) {
  const auto give = [&](double share) {
    for (const Pair& pair : pairs_) {
      const auto body = [&](std::uint32_t k) { return grid.fields[place_nodes_[k].field].bodies[0]; };
      impulse_[body(pair.a)] = impulse_[body(pair.a)] - share * pair.impulse;
      impulse_[body(pair.b)] = impulse_[body(pair.b)] + share * pair.impulse;
    }
  };
  if (handed > 0) give(handed);  // of hold
  for (std::size_t k = 0; k < place_nodes_.size(); ++k) before_[k] = grid.velocity_updated[place_nodes_[k].node];
  bind(grid, grid.velocity_updated, true, dt, threads, [&](const Pair& pair, std::uint32_t, std::uint32_t) {
    return pair.pull > 0 ? 0 : std::max(0.0, pair.gap) / dt;
  });
  give(1);
  double lost = 0;
  for (std::size_t k = 0; k < place_nodes_.size(); ++k) {
    const std::uint32_t node = place_nodes_[k].node;
    lost -= work_on_node(grid.mass[node], grid.velocity[node], before_[k], grid.velocity_updated[node]);
  }
  return lost;
}

}  // namespace scarp
