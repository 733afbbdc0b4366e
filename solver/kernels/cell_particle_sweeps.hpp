// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps over cells whose particles carry their state, see cell_particles.hpp.
#pragma once

#include "solver/kernels/cell_particles.hpp"
#include "solver/kernels/cell_sweeps.hpp"
#include "solver/kernels/neighbours.hpp"
#include "solver/kernels/packed_laws.hpp"

namespace SCARP_KERNELS {
namespace {

using scarp::kernels::CellResult;
using scarp::kernels::CellSweep;
using scarp::kernels::LawParameters;

/// Particles from `first` on, side by side, and those that a cell has less than lanes repeated.
struct Neighbours {
  std::uint32_t index[kLanes];
  Lanes lanes;

  SCARP_INLINE Neighbours(std::size_t first, std::size_t end)
      : lanes(number(index, first), static_cast<int>(end - first < kLanes ? end - first : kLanes)) {}

 private:
  static SCARP_INLINE const std::uint32_t* number(std::uint32_t (&index)[kLanes], std::size_t first) {
    for (int l = 0; l < kLanes; ++l) index[l] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(l);
    return index;
  }
};

/// phi of the corners at the lanes' places, and their slopes along an axis.
template <int D>
struct CornerWeights {
  Pack x[D], y[D];  ///< xi and 1 - xi

  SCARP_INLINE explicit CornerWeights(const Pack (&xi)[D]) {
#pragma GCC unroll 3
    for (int a = 0; a < D; ++a) {
      x[a] = xi[a];
      y[a] = 1.0 - xi[a];
    }
  }
  SCARP_INLINE Pack along(int axis, int corner) const { return corner >> axis & 1 ? x[axis] : y[axis]; }
  SCARP_INLINE void values(Pack (&phi)[kCorners<D>]) const {
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k) {
      phi[k] = along(0, k) * along(1, k);
      if constexpr (D == 3) phi[k] *= along(2, k);
    }
  }
  /// Of the corners with 1 along the axis; those across from them have the same with the other sign.
  SCARP_INLINE void slopes(double per_cell, Pack (&rise)[D][kCorners<D>]) const {
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis)
#pragma GCC unroll 8
      for (int k = 0; k < kCorners<D>; ++k) {
        if (!(k >> axis & 1)) continue;
        const int b = (axis + 1) % D;
        rise[axis][k] = per_cell * along(b, k);
        if constexpr (D == 3) rise[axis][k] *= along((axis + 2) % D, k);
        rise[axis][k ^ (1 << axis)] = -rise[axis][k];
      }
  }
};

/// Sets, or for all packs of a cell but the first adds, the corners' sums over the lanes of give(corner, component).
template <int D, class F>
SCARP_INLINE void give_to_slots(double* slots, bool first, F&& give) {
  constexpr int count = 3 * kCorners<D>, whole = (count + kLanes - 1) / kLanes * kLanes;
  alignas(64) double rest[kLanes];
#pragma GCC unroll 12
  for (int i = 0; i < whole; i += kLanes) {
    Pack group[kLanes];
#pragma GCC unroll 8
    for (int l = 0; l < kLanes; ++l)
      group[l] = i + l < count && (i + l) % 3 < D ? give((i + l) / 3, (i + l) % 3) : Pack{};
    Pack sums = sums_of(group);
    if (i + kLanes <= count) {
      if (!first) sums += load(slots + i);
      store(slots + i, sums);
    } else {
      store(rest, sums);
      for (int l = 0; i + l < count; ++l) slots[i + l] = first ? rest[l] : slots[i + l] + rest[l];
    }
  }
}

/// f(neighbours, whether it is the first of its cell) for the packs of a cell; ask(p) for what f will need of the
/// particles from p on some packs later: these are more streams than the processor foresees.
template <class Ask, class F>
SCARP_INLINE void each_pack_of_cell(const CellSweep& sweep, std::size_t cell, Ask&& ask, F&& f) {
  const std::size_t begin = sweep.cell_begin[cell], end = sweep.cell_begin[cell + 1];
  for (std::size_t p = begin; p < end; p += kLanes) {
    ask(p + kAhead);
    f(Neighbours(p, end).lanes, p == begin);
  }
}

/// Of the model's particles, as its arrays are.
SCARP_INLINE const double* places_of(const CellSweep& sweep) { return sweep.xi - 3 * sweep.first; }

template <int D>
SCARP_INLINE CornerWeights<D> weights_of(const CellSweep& sweep, const Lanes& lanes) {
  Pack xi[D];
  load_neighbours<D, 3>(places_of(sweep), lanes, xi);
  return CornerWeights<D>(xi);
}

template <int D>
void advance_cells(const CellSweep& sweep, std::size_t begin, std::size_t end) {
  for (std::size_t cell = begin; cell < end; ++cell) {
    const std::uint32_t* const nodes = sweep.cell_nodes + cell * kCorners<D>;
    double* const slots = sweep.slots + cell * (3 * kCorners<D>);
    each_pack_of_cell(
        sweep, cell,
        [&](std::size_t p) __attribute__((always_inline)) { ask_for_moved(sweep.particles, places_of(sweep), p); },
        [&](const Lanes& lanes, bool first) __attribute__((always_inline)) {
          Pack phi[kCorners<D>], v[D], x[D], held[D] = {}, carried[D] = {};
          weights_of<D>(sweep, lanes).values(phi);
#pragma GCC unroll 8
          for (int k = 0; k < kCorners<D>; ++k) {
            const double* const before = sweep.node_velocity + std::size_t{nodes[k]} * 3;
            const double* const after = sweep.node_updated + std::size_t{nodes[k]} * 3;
#pragma GCC unroll 3
            for (int d = 0; d < D; ++d) {
              held[d] += phi[k] * before[d];
              carried[d] += phi[k] * after[d];
            }
          }
          load_neighbours<D, 3>(sweep.particles.velocity, lanes, v);
          load_neighbours<D, 3>(sweep.particles.position, lanes, x);
#pragma GCC unroll 3
          for (int d = 0; d < D; ++d) {
            v[d] = sweep.kept * v[d] - sweep.less * held[d] + carried[d];
            x[d] += sweep.dt * carried[d];
          }
          store_neighbours<D, 3>(sweep.particles.velocity, lanes, v);
          store_neighbours<D, 3>(sweep.particles.position, lanes, x);
          const Pack mass = choose(lanes.valid(), load_neighbours(sweep.particles.mass, lanes), Pack{});
#pragma GCC unroll 3
          for (int d = 0; d < D; ++d) v[d] *= mass;
          give_to_slots<D>(
              slots, first, [&](int k, int d) __attribute__((always_inline)) { return phi[k] * v[d]; });
        });
  }
}

/// F <- F + dt sum v_I x grad0 phi_I.
template <int D>
SCARP_INLINE void advance_gradient(const CellSweep& sweep, const std::uint32_t* nodes, const Lanes& lanes,
                                   const Pack (&rise)[D][kCorners<D>], Pack (&old)[9], Deformation<D>& d) {
  load_neighbours<9, 9>(sweep.particles.deformation_gradient, lanes, old);
  for (int i = 0; i < 9; ++i) d.F[i] = old[i];
  Pack slope[D][D] = {};
#pragma GCC unroll 8
  for (int k = 0; k < kCorners<D>; ++k) {
    const double* const v = sweep.node_velocity + std::size_t{nodes[k]} * 3;
#pragma GCC unroll 3
    for (int i = 0; i < D; ++i)
#pragma GCC unroll 3
      for (int axis = 0; axis < D; ++axis) slope[i][axis] += rise[axis][k] * v[i];
  }
#pragma GCC unroll 3
  for (int i = 0; i < D; ++i)
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis) d.F[3 * i + axis] += sweep.dt * slope[i][axis];
  store_neighbours<9, 9>(sweep.particles.deformation_gradient, lanes, d.F);
  d.complete();
}

/// b_e of the trial step, f b_e f^T with f = F F_old^-1, or F F^T of a law without a history.
template <int D, class Law>
SCARP_INLINE CurrentHistory<D> trial_history(const CellSweep& sweep, const Lanes& lanes, const Pack (&old)[9],
                                             const Deformation<D>& d) {
  if constexpr (Law::template fields<D> == 0) {
    return {left_product<D>(d.F), Pack{}, Pack{}};
  } else {
    Deformation<D> before;
    for_entries<D>([&](int i) { before.F[i] = old[i]; });
    before.complete();
    Symmetric<D> b;
    load_neighbours<Symmetric<D>::n, 6>(sweep.particles.elastic_left_cauchy_green, lanes, b.a);
    return {push_forward<D>(d.F, pull_back<D>(before, b)), load_neighbours(sweep.particles.plastic_strain, lanes),
            load_neighbours(sweep.particles.plastic_work, lanes)};
  }
}

template <int D, class Law>
SCARP_INLINE void keep_history(const CellSweep& sweep, const Lanes& lanes, const CurrentHistory<D>& history) {
  if constexpr (Law::template fields < D >> 0) {
    store_neighbours<Symmetric<D>::n, 6>(sweep.particles.elastic_left_cauchy_green, lanes, history.b_e.a);
    store_neighbours<1, 1>(sweep.particles.plastic_strain, lanes, &history.strain);
    store_neighbours<1, 1>(sweep.particles.plastic_work, lanes, &history.work);
  }
}

/// Notes the first lane that is not good.
SCARP_INLINE void note_bad(const Lanes& lanes, Mask good, CellResult& result) {
  if (result.bad_particle >= 0 || !any(lanes.valid() & ~good)) return;
  for (int l = lanes.count; l-- > 0;)
    if (!good[l]) result.bad_particle = lanes.particle[l];
}

template <int D, class Law>
void deform_cells(const CellSweep& sweep, std::size_t begin, std::size_t end, const LawParameters& parameters,
                  CellResult& result) {
  const Law law(parameters.value);
  for (std::size_t cell = begin; cell < end; ++cell) {
    const std::uint32_t* const nodes = sweep.cell_nodes + cell * kCorners<D>;
    double* const slots = sweep.slots + cell * (3 * kCorners<D>);
    Pack stiffness{}, weight{};
    each_pack_of_cell(
        sweep, cell,
        [&](std::size_t p) __attribute__((always_inline)) {
          ask_for_deformed<(Law::template fields<D> > 0)>(sweep.particles, places_of(sweep), p);
        },
        [&](const Lanes& lanes, bool first) __attribute__((always_inline)) {
          Pack rise[D][kCorners<D>], old[9], P[9];
          weights_of<D>(sweep, lanes).slopes(sweep.per_cell, rise);
          Deformation<D> d;
          advance_gradient<D>(sweep, nodes, lanes, rise, old, d);
          CurrentHistory<D> history = trial_history<D, Law>(sweep, lanes, old, d);
          const Symmetric<D> tau = kirchhoff<D>(law, history, d.J);
          keep_history<D, Law>(sweep, lanes, history);
          Pack sigma[Symmetric<D>::n], check{};
#pragma GCC unroll 6
          for (int i = 0; i < Symmetric<D>::n; ++i) {
            sigma[i] = tau.a[i] * d.per_J;
            check += sigma[i];
          }
          store_neighbours<Symmetric<D>::n, 6>(sweep.particles.stress, lanes, sigma);
          if (sweep.find_speed) {
            const Pack mass = choose(lanes.valid(), load_neighbours(sweep.particles.mass, lanes), Pack{});
            const Pack speed = law.template speed_squared<D>(stretch_of<D>(d), history);
            check += speed;
            stiffness += mass * speed;
            weight += mass;
          }
          note_bad(lanes, (d.J > 0.0) & (d.J < 1e100) & ((check - check) == 0.0), result);
          first_piola<D>(tau, d, P);
          const Pack V0 = choose(lanes.valid(), load_neighbours(sweep.particles.reference_volume, lanes), Pack{});
          for_entries<D>([&](int i) { P[i] *= -V0; });
          give_to_slots<D>(
              slots, first, [&](int k, int i) __attribute__((always_inline)) {
                Pack force = P[3 * i] * rise[0][k] + P[3 * i + 1] * rise[1][k];
                if constexpr (D == 3) force += P[3 * i + 2] * rise[2][k];
                return force;
              });
        });
    if (!sweep.find_speed) continue;
    const double mean = sum(stiffness) / sum(weight);
    if (mean > result.largest_speed_squared) result.largest_speed_squared = mean;
  }
}

template <class Law>
void enter_cells(scarp::kernels::CellKernels& table, scarp::kernels::LawKind kind) {
  table.deform[static_cast<int>(kind)][0] = deform_cells<2, Law>;
  table.deform[static_cast<int>(kind)][1] = deform_cells<3, Law>;
}

SCARP_INLINE scarp::kernels::CellKernels cell_kernels() {
  using scarp::kernels::LawKind;
  scarp::kernels::CellKernels table{};
  table.advance[0] = advance_cells<2>;
  table.advance[1] = advance_cells<3>;
  enter_cells<NeoHookean>(table, LawKind::neo_hookean);
  enter_cells<Hencky>(table, LawKind::hencky);
  enter_cells<VonMises>(table, LawKind::von_mises);
  enter_cells<DruckerPrager>(table, LawKind::drucker_prager);
  enter_cells<MohrCoulomb>(table, LawKind::mohr_coulomb);
  return table;
}

}  // namespace
}  // namespace SCARP_KERNELS
