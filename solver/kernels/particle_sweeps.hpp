// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps over the particles of updated-Lagrangian bodies, see particles.hpp.
#pragma once

#include "solver/kernels/lanes.hpp"
#include "solver/kernels/packed_laws.hpp"
#include "solver/kernels/placing.hpp"

namespace SCARP_KERNELS {
namespace {

using scarp::kernels::CellRange;
using scarp::kernels::DeformResult;
using scarp::kernels::LawParameters;
using scarp::kernels::ParticleSweep;
using scarp::kernels::Shape;

template <Shape S>
constexpr int kWidth = S == Shape::linear              ? 2
                       : S == Shape::quadratic_bspline ? 3
                                                       : 4;
/// Functions of a tile per axis.
template <int D, Shape S>
constexpr int kTileEdge = scarp::kernels::block_edge(D) + kWidth<S> - 1;
template <int D>
constexpr int kSymmetric = Symmetric<D>::n;

/// phi and its slope per cell along one axis, at xi of cell `cell` of `cells`.
template <Shape S>
SCARP_INLINE void weigh(Pack xi, int cell, int cells, Pack half, Pack (&N)[kWidth<S>], Pack (&dN)[kWidth<S>]) {
  if constexpr (S == Shape::linear) {
    N[0] = 1.0 - xi;
    N[1] = xi;
    dN[0] = all(-1);
    dN[1] = all(1);
  } else if constexpr (S == Shape::quadratic_bspline) {
    const double before = cell > 0 ? 1 : 0, after = cell + 1 < cells ? 1 : 0;
    const double per_left = 1 / (1 + before), per_right = 1 / (1 + after);
    const Pack rest = 1.0 - xi;
    N[0] = rest * rest * per_left;
    N[2] = xi * xi * per_right;
    N[1] = (xi + before) * rest * per_left + (rest + after) * xi * per_right;
    dN[0] = -2.0 * per_left * rest;
    dN[2] = 2.0 * per_right * xi;
    dN[1] = -(dN[0] + dN[2]);
  } else {
    const Pack per_half = 1.0 / half;
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
      const Pack r = xi + static_cast<double>(1 - k), distance = magnitude(r);
      const Pack side = choose(r < 0.0, all(1), all(-1)), rest = 1.0 + half - distance;
      const Mask near = distance < half, flat = distance <= 1.0 - half, reaches = distance < 1.0 + half;
      N[k] = choose(near, 1.0 - (r * r + half * half) * 0.5 * per_half,
                    choose(flat, 1.0 - distance, choose(reaches, rest * rest * 0.25 * per_half, Pack{})));
      dN[k] = choose(near, -r * per_half, choose(flat, side, choose(reaches, side * rest * 0.5 * per_half, Pack{})));
    }
  }
}

template <int D, Shape S>
struct Weights {
  static constexpr int w = kWidth<S>;
  Pack N[D][w], dN[D][w];  ///< slopes in 1/m

  SCARP_INLINE Weights(const ParticleSweep& sweep, const CellRange& range, std::uint32_t c, const Lanes& lanes) {
    Pack xi[D], half = Pack{};
    load_field<D>(sweep.xi, 3, lanes, xi);
    if constexpr (S == Shape::gimp) half = gather_lanes(sweep.half_edge, 1, lanes);
#pragma GCC unroll 3
    for (int a = 0; a < D; ++a) {
      weigh<S>(xi[a], range.cells[c][a], sweep.cell_count[a], half, N[a], dN[a]);
#pragma GCC unroll 4
      for (int k = 0; k < w; ++k) dN[a][k] *= sweep.per_cell;
    }
  }

  /// f(j, k, place in the tile) for the rows of the window along x.
  template <class F>
  static SCARP_INLINE void each_row(F&& f) {
    constexpr int edge = kTileEdge<D, S>;
#pragma GCC unroll 1
    for (int k = 0; k < (D == 2 ? 1 : w); ++k)
#pragma GCC unroll 4
      for (int j = 0; j < w; ++j) f(j, k, (k * edge + j) * edge);
  }

  SCARP_INLINE Pack across(int j, int k) const { return D == 2 ? N[1][j] : N[1][j] * N[D - 1][k]; }
};

/// f(lanes) for the packs of a cell.
template <class F>
SCARP_INLINE void each_pack(const CellRange& range, std::uint32_t c, F&& f) {
  for (std::uint32_t m = range.cell_begin[c], end = range.cell_begin[c + 1]; m < end; m += kLanes)
    f(Lanes(range.members + m, static_cast<int>(end - m)));
}

/// V sigma of the lanes, and nothing of those that do not count.
template <int D>
SCARP_INLINE void load_stress(const ParticleSweep& sweep, const Lanes& lanes, Pack (&s)[kSymmetric<D>]) {
  load_field<kSymmetric<D>>(sweep.particles.stress, 6, lanes, s);
  const Pack V = choose(lanes.valid(), gather_lanes(sweep.volume, 1, lanes), Pack{});
#pragma GCC unroll 6
  for (int i = 0; i < kSymmetric<D>; ++i) s[i] *= V;
}

template <int D, Shape S>
void map_particles(const ParticleSweep& sweep, const CellRange& range) {
  for (std::uint32_t c = range.begin; c < range.end; ++c) {
    double* const window = range.tile + static_cast<std::size_t>(range.first_in_tile[c]) * 8;
    each_pack(
        range, c, [&](const Lanes& lanes) __attribute__((always_inline)) {
          const Weights<D, S> weights(sweep, range, c, lanes);
          const Pack mass = choose(lanes.valid(), gather_lanes(sweep.particles.mass, 1, lanes), Pack{});
          Pack v[D], s[kSymmetric<D>];
          load_field<D>(sweep.particles.velocity, 3, lanes, v);
          load_stress<D>(sweep, lanes, s);
          // Rows of V sigma: column a of row i is s[at[i][a]].
          constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
          Weights<D, S>::each_row([&](int j, int k, int row) __attribute__((always_inline)) {
            const Pack yz = weights.across(j, k), m_yz = mass * yz;
            const Pack dy = D == 2 ? weights.dN[1][j] : weights.dN[1][j] * weights.N[D - 1][k];
            const Pack dz = D == 2 ? Pack{} : weights.N[1][j] * weights.dN[D - 1][k];
            Pack along[D], beside[D];
#pragma GCC unroll 3
            for (int i = 0; i < D; ++i) {
              along[i] = s[at[i][0]] * yz;
              beside[i] = s[at[i][1]] * dy;
              if constexpr (D == 3) beside[i] += s[at[i][2]] * dz;
            }
#pragma GCC unroll 4
            for (int i = 0; i < kWidth<S>; ++i) {
              Pack sums[8] = {};
              sums[0] = m_yz * weights.N[0][i];
#pragma GCC unroll 3
              for (int a = 0; a < D; ++a) {
                sums[1 + a] = sums[0] * v[a];
                sums[4 + a] = -(along[a] * weights.dN[0][i] + beside[a] * weights.N[0][i]);
              }
              add_sums<8>(window + static_cast<std::size_t>(row + i) * 8, sums);
            }
          });
        });
  }
}

/// Adds weight m v and next_weight m v to the momenta of two nodes that stand side by side, or of the first alone.
template <int D, bool two>
SCARP_INLINE void add_momentum(double* node, Pack weight, Pack next_weight, const Pack (&mv)[D]) {
  Pack sums[8] = {};
#pragma GCC unroll 3
  for (int a = 0; a < D; ++a) {
    sums[a] = weight * mv[a];
    if constexpr (two) sums[4 + a] = next_weight * mv[a];
  }
  if constexpr (two || kLanes > 4) {
    if constexpr (two) return add_sums<8>(node, sums);
    alignas(64) double found[8] = {};
    add_sums<8>(found, sums);
#pragma GCC unroll 3
    for (int a = 0; a < D; ++a) node[a] += found[a];
  } else {
    const Pack(&first)[4] = reinterpret_cast<const Pack(&)[4]>(sums);
    add_sums<4>(node, first);
  }
}

template <int D, Shape S>
double advance_particles(const ParticleSweep& sweep, const CellRange& range) {
  constexpr int w = kWidth<S>;
  Pack fastest{};
  for (std::uint32_t c = range.begin; c < range.end; ++c) {
    double* const window = range.tile + static_cast<std::size_t>(range.first_in_tile[c]) * 4;
    const std::uint32_t* const nodes = range.tile_nodes + range.first_in_tile[c];
    each_pack(
        range, c, [&](const Lanes& lanes) __attribute__((always_inline)) {
          const Weights<D, S> weights(sweep, range, c, lanes);
          Pack held[D] = {}, carried[D] = {};
          Weights<D, S>::each_row([&](int j, int k, int row) __attribute__((always_inline)) {
            const Pack yz = weights.across(j, k);
#pragma GCC unroll 4
            for (int i = 0; i < w; ++i) {
              const Pack phi = weights.N[0][i] * yz;
              const double* const v = sweep.velocity + static_cast<std::size_t>(nodes[row + i]) * 3;
              const double* const updated = sweep.velocity_updated + static_cast<std::size_t>(nodes[row + i]) * 3;
#pragma GCC unroll 3
              for (int a = 0; a < D; ++a) {
                held[a] += phi * v[a];
                carried[a] += phi * updated[a];
              }
            }
          });
          Pack v[D], x[D], speed{};
          load_field<D>(sweep.particles.velocity, 3, lanes, v);
          load_field<D>(sweep.particles.position, 3, lanes, x);
#pragma GCC unroll 3
          for (int a = 0; a < D; ++a) {
            v[a] = sweep.kept * v[a] - sweep.less * held[a] + carried[a];
            x[a] += sweep.dt * carried[a];
            speed += v[a] * v[a];
          }
          fastest = larger(fastest, speed);
          store_field<D>(sweep.particles.velocity, 3, lanes, v);
          store_field<D>(sweep.particles.position, 3, lanes, x);
          const Pack mass = choose(lanes.valid(), gather_lanes(sweep.particles.mass, 1, lanes), Pack{});
#pragma GCC unroll 3
          for (int a = 0; a < D; ++a) v[a] *= mass;
          Weights<D, S>::each_row([&](int j, int k, int row) __attribute__((always_inline)) {
            const Pack yz = weights.across(j, k);
#pragma GCC unroll 2
            for (int i = 0; i + 1 < w; i += 2)
              add_momentum<D, true>(window + static_cast<std::size_t>(row + i) * 4, weights.N[0][i] * yz,
                                    weights.N[0][i + 1] * yz, v);
            if constexpr (w % 2 == 1)
              add_momentum<D, false>(window + static_cast<std::size_t>(row + w - 1) * 4, weights.N[0][w - 1] * yz,
                                     Pack{}, v);
          });
        });
  }
  return largest(fastest);
}

/// L of the lanes.
template <int D, Shape S>
SCARP_INLINE void velocity_gradient(const ParticleSweep& sweep, const Weights<D, S>& weights,
                                    const std::uint32_t* nodes, Pack (&L)[9]) {
  for (Pack& entry : L) entry = Pack{};
  Weights<D, S>::each_row([&](int j, int k, int row) __attribute__((always_inline)) {
    Pack value[D] = {}, slope[D] = {};
#pragma GCC unroll 4
    for (int i = 0; i < kWidth<S>; ++i) {
      const double* const v = sweep.velocity + static_cast<std::size_t>(nodes[row + i]) * 3;
#pragma GCC unroll 3
      for (int a = 0; a < D; ++a) {
        value[a] += weights.N[0][i] * v[a];
        slope[a] += weights.dN[0][i] * v[a];
      }
    }
    const Pack yz = weights.across(j, k);
    const Pack dy = D == 2 ? weights.dN[1][j] : weights.dN[1][j] * weights.N[D - 1][k];
#pragma GCC unroll 3
    for (int a = 0; a < D; ++a) {
      L[3 * a] += slope[a] * yz;
      L[3 * a + 1] += value[a] * dy;
      if constexpr (D == 3) L[3 * a + 2] += value[a] * (weights.N[1][j] * weights.dN[D - 1][k]);
    }
  });
}

/// F <- (I + dt L) F and J; in the plane or in space.
template <int D>
SCARP_INLINE Pack advance_gradient(const ParticleSweep& sweep, const Lanes& lanes, const Pack (&f)[9],
                                   Deformation<D>& d) {
  double* const base = sweep.particles.deformation_gradient;
  Pack old[9];
  if constexpr (D == 3)
    load_field<9>(base, 9, lanes, old);
  else
    for_entries<2>([&](int i) { old[i] = gather_lanes(base + i, 9, lanes); });
#pragma GCC unroll 3
  for (int i = 0; i < D; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < D; ++j) {
      Pack sum = f[3 * i] * old[j];
#pragma GCC unroll 3
      for (int k = 1; k < D; ++k) sum += f[3 * i + k] * old[3 * k + j];
      d.F[3 * i + j] = sum;
    }
  if constexpr (D == 3)
    store_field<9>(base, 9, lanes, d.F);
  else
    for_entries<2>([&](int i) { scatter_lanes(base + i, 9, lanes, d.F[i]); });
  if constexpr (D == 2) return d.F[0] * d.F[4] - d.F[1] * d.F[3];
  const Pack(&F)[9] = d.F;
  return F[0] * (F[4] * F[8] - F[5] * F[7]) + F[1] * (F[5] * F[6] - F[3] * F[8]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/// b_e of the trial step, f b_e f^T, or F F^T of a law without a history.
template <int D, class Law>
SCARP_INLINE CurrentHistory<D> load_history(const ParticleSweep& sweep, const Lanes& lanes, const Pack (&f)[9],
                                            const Deformation<D>& d) {
  if constexpr (Law::template fields<D> == 0) {
    return {left_product<D>(d.F), Pack{}, Pack{}};
  } else {
    Symmetric<D> b;
    load_field<kSymmetric<D>>(sweep.particles.elastic_left_cauchy_green, 6, lanes, b.a);
    return {push_forward<D>(f, b), gather_lanes(sweep.particles.plastic_strain, 1, lanes),
            gather_lanes(sweep.particles.plastic_work, 1, lanes)};
  }
}

template <int D, class Law>
SCARP_INLINE void store_history(const ParticleSweep& sweep, const Lanes& lanes, const CurrentHistory<D>& history) {
  if constexpr (Law::template fields < D >> 0) {
    store_field<kSymmetric<D>>(sweep.particles.elastic_left_cauchy_green, 6, lanes, history.b_e.a);
    scatter_lanes(sweep.particles.plastic_strain, 1, lanes, history.strain);
    scatter_lanes(sweep.particles.plastic_work, 1, lanes, history.work);
  }
}

template <int D, Shape S, class Law>
void deform_particles(const ParticleSweep& sweep, const CellRange& range, const LawParameters& parameters,
                      DeformResult& result) {
  const Law law(parameters.value);
  Pack fastest{};
  for (std::uint32_t c = range.begin; c < range.end; ++c) {
    const std::uint32_t* const nodes = range.tile_nodes + range.first_in_tile[c];
    each_pack(
        range, c, [&](const Lanes& lanes) __attribute__((always_inline)) {
          const Weights<D, S> weights(sweep, range, c, lanes);
          Pack f[9];
          velocity_gradient<D, S>(sweep, weights, nodes, f);
          for_entries<D>([&](int i) { f[i] = sweep.dt * f[i] + (i % 4 == 0 ? all(1) : Pack{}); });
          Deformation<D> d;
          const Pack J = advance_gradient<D>(sweep, lanes, f, d);
          CurrentHistory<D> history = load_history<D, Law>(sweep, lanes, f, d);
          const Symmetric<D> tau = kirchhoff<D>(law, history, J);
          store_history<D, Law>(sweep, lanes, history);
          const Pack per_J = 1.0 / J;
          Pack sigma[kSymmetric<D>], check{};
#pragma GCC unroll 6
          for (int i = 0; i < kSymmetric<D>; ++i) {
            sigma[i] = tau.a[i] * per_J;
            check += sigma[i];
          }
          store_field<kSymmetric<D>>(sweep.particles.stress, 6, lanes, sigma);
          scatter_lanes(sweep.volume, 1, lanes, J * gather_lanes(sweep.particles.reference_volume, 1, lanes));
          const Stretch elastic = stretch_of<D>(history.b_e);
          const Pack speed = elastic.largest_squared() * law.template speed_squared<D>(elastic, history);
          check += speed;
          const Mask good = (J > 0.0) & (J < 1e100) & ((check - check) == 0.0);
          if (any(lanes.valid() & ~good)) {
            for (int l = 0; l < lanes.count; ++l) {
              const auto p = static_cast<std::int64_t>(lanes.particle[l]);
              if (!good[l] && (result.bad_particle < 0 || p < result.bad_particle)) result.bad_particle = p;
            }
          }
          fastest = larger(fastest, choose(good & lanes.valid(), speed, Pack{}));
        });
  }
  const double found = largest(fastest);
  if (found > result.largest_speed_squared) result.largest_speed_squared = found;
}

template <class Law>
void enter_deform(scarp::kernels::ParticleKernels& table, scarp::kernels::LawKind kind) {
  auto& entry = table.deform[static_cast<int>(kind)];
  entry[0][0] = deform_particles<2, Shape::linear, Law>;
  entry[0][1] = deform_particles<2, Shape::quadratic_bspline, Law>;
  entry[0][2] = deform_particles<2, Shape::gimp, Law>;
  entry[1][0] = deform_particles<3, Shape::linear, Law>;
  entry[1][1] = deform_particles<3, Shape::quadratic_bspline, Law>;
  entry[1][2] = deform_particles<3, Shape::gimp, Law>;
}

template <int D, Shape S>
void enter_transfers(scarp::kernels::ParticleKernels& table) {
  table.map[D - 2][static_cast<int>(S)] = map_particles<D, S>;
  table.advance[D - 2][static_cast<int>(S)] = advance_particles<D, S>;
}

SCARP_INLINE scarp::kernels::ParticleKernels particle_kernels() {
  using scarp::kernels::LawKind;
  scarp::kernels::ParticleKernels table{};
  table.place[0] = place_particles<2>;
  table.place[1] = place_particles<3>;
  table.add_tile = add_tile;
  table.add_momenta = add_momenta;
  enter_transfers<2, Shape::linear>(table);
  enter_transfers<2, Shape::quadratic_bspline>(table);
  enter_transfers<2, Shape::gimp>(table);
  enter_transfers<3, Shape::linear>(table);
  enter_transfers<3, Shape::quadratic_bspline>(table);
  enter_transfers<3, Shape::gimp>(table);
  enter_deform<NeoHookean>(table, LawKind::neo_hookean);
  enter_deform<Hencky>(table, LawKind::hencky);
  enter_deform<VonMises>(table, LawKind::von_mises);
  enter_deform<DruckerPrager>(table, LawKind::drucker_prager);
  enter_deform<MohrCoulomb>(table, LawKind::mohr_coulomb);
  return table;
}

}  // namespace
}  // namespace SCARP_KERNELS
