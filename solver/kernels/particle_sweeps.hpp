// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps over the particles of updated-Lagrangian bodies, see particles.hpp.
#pragma once

#include "solver/kernels/neighbours.hpp"
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

/// Whether particles give to nodes by lanes that are nodes.
template <int D, Shape S>
constexpr bool kByCorners = D == 3 && S == Shape::linear&& kLanes <= 8;

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
    load_neighbours<D, 3>(sweep.xi, lanes, xi);
    if constexpr (S == Shape::gimp) half = load_neighbours(sweep.half_edge, lanes);
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

/// The particle that comes this many after the m-th member: what a sweep asks memory for. The rows of a block are short
/// runs of particles, too short for the processor to foresee.
SCARP_INLINE std::size_t particle_ahead(const CellRange& range, std::uint32_t m) {
  const std::uint32_t last = range.cell_begin[range.end] - 1;
  return range.members[m + kAhead < last ? m + kAhead : last];
}

/// f(lanes) for the packs of a cell; ask(p) for what f will need of the particles from p on some packs later.
template <class Ask, class F>
SCARP_INLINE void each_pack(const CellRange& range, std::uint32_t c, Ask&& ask, F&& f) {
  for (std::uint32_t m = range.cell_begin[c], end = range.cell_begin[c + 1]; m < end; m += kLanes) {
    ask(particle_ahead(range, m));
    f(Lanes(range.members + m, static_cast<int>(end - m)));
  }
}

SCARP_INLINE void ask_for_mapped(const ParticleSweep& sweep, std::size_t p) {
  ask_for_field<3>(sweep.xi, p);
  ask_for_field<3>(sweep.particles.velocity, p);
  ask_for_field<6>(sweep.particles.stress, p);
  ask_for_field<1>(sweep.particles.mass, p);
  ask_for_field<1>(sweep.volume, p);
}

/// V sigma of the lanes, and nothing of those that do not count.
template <int D>
SCARP_INLINE void load_stress(const ParticleSweep& sweep, const Lanes& lanes, Pack (&s)[kSymmetric<D>]) {
  load_neighbours<kSymmetric<D>, 6>(sweep.particles.stress, lanes, s);
  const Pack V = choose(lanes.valid(), load_neighbours(sweep.volume, lanes), Pack{});
#pragma GCC unroll 6
  for (int i = 0; i < kSymmetric<D>; ++i) s[i] *= V;
}

/// What a cell's particles give to its eight corners, by lanes that are corners: nothing is summed over lanes,
/// particles may be any number, and their fields are broadcast from where they stand. Linear functions in space.
struct Corners {
  static constexpr int packs = 8 / kLanes;

  /// phi of corner k is a product of three factors, start + turn xi of the bit of the axis in k.
  alignas(64) static constexpr double start[3][8] = {
      {1, 0, 1, 0, 1, 0, 1, 0}, {1, 1, 0, 0, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 0, 0, 0}};
  alignas(64) static constexpr double turn[3][8] = {
      {-1, 1, -1, 1, -1, 1, -1, 1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}};

  static SCARP_INLINE Pack factor(const double* xi, int axis, int pack) {
    return load(start[axis] + pack * kLanes) + load(turn[axis] + pack * kLanes) * xi[axis];
  }

  /// Adds `count` sums per corner, the others of a tile's `stride` numbers are zero, to the corners' places in a tile.
  template <int count, int stride>
  static SCARP_INLINE void give(double* window, const Pack (&sums)[count][packs]) {
    constexpr int edge = kTileEdge<3, Shape::linear>;
#pragma GCC unroll 4
    for (int pack = 0; pack < packs; ++pack)
#pragma GCC unroll 4
      for (int first = 0; first < stride; first += kLanes) {
        Pack rows[kLanes];
#pragma GCC unroll 8
        for (int l = 0; l < kLanes; ++l) rows[l] = first + l < count ? sums[first + l][pack] : Pack{};
        transpose(rows);
#pragma GCC unroll 8
        for (int l = 0; l < kLanes; ++l) {
          const int k = pack * kLanes + l;
          double* const at = window + (((k >> 2) * edge + (k >> 1 & 1)) * edge + (k & 1)) * stride + first;
          if constexpr (stride >= kLanes) {
            add(at, rows[l]);
          } else if (l % 2 == 0) {  // of half a pack: with its neighbour along x, which stands beside it
#if SCARP_LANES == 8
            add(at, __builtin_shuffle(rows[l], rows[l + 1], Mask{0, 1, 2, 3, 8, 9, 10, 11}));
#endif
          }
        }
      }
  }
};

SCARP_INLINE void map_to_corners(const ParticleSweep& sweep, const CellRange& range, std::uint32_t c) {
  constexpr int packs = Corners::packs;
  Pack sums[7][packs] = {};  // mass, momentum, force
  for (std::uint32_t m = range.cell_begin[c], end = range.cell_begin[c + 1]; m < end; ++m) {
    const std::size_t p = range.members[m];
    if ((m - range.cell_begin[c]) % kLanes == 0) ask_for_mapped(sweep, particle_ahead(range, m));
    const double *xi = sweep.xi + 3 * p, *v = sweep.particles.velocity + 3 * p, *s = sweep.particles.stress + 6 * p;
    const double mass = sweep.particles.mass[p], per_V = -sweep.volume[p] * sweep.per_cell;
#pragma GCC unroll 4
    for (int b = 0; b < packs; ++b) {
      const Pack x = Corners::factor(xi, 0, b), y = Corners::factor(xi, 1, b), z = Corners::factor(xi, 2, b);
      const Pack yz = y * z, m_phi = mass * (x * yz), Vx = per_V * x;
      const Pack gx = load(Corners::turn[0] + b * kLanes) * (per_V * yz);
      const Pack gy = load(Corners::turn[1] + b * kLanes) * (Vx * z);
      const Pack gz = load(Corners::turn[2] + b * kLanes) * (Vx * y);
      sums[0][b] += m_phi;
#pragma GCC unroll 3
      for (int a = 0; a < 3; ++a) sums[1 + a][b] += v[a] * m_phi;
      sums[4][b] += s[0] * gx + s[3] * gy + s[5] * gz;
      sums[5][b] += s[3] * gx + s[1] * gy + s[4] * gz;
      sums[6][b] += s[5] * gx + s[4] * gy + s[2] * gz;
    }
  }
  Corners::give<7, 8>(range.tile + static_cast<std::size_t>(range.first_in_tile[c]) * 8, sums);
}

SCARP_INLINE void momenta_to_corners(const ParticleSweep& sweep, const CellRange& range, std::uint32_t c) {
  constexpr int packs = Corners::packs;
  Pack sums[3][packs] = {};
  for (std::uint32_t m = range.cell_begin[c], end = range.cell_begin[c + 1]; m < end; ++m) {
    const std::size_t p = range.members[m];
    const double *xi = sweep.xi + 3 * p, *v = sweep.particles.velocity + 3 * p;
    const double mass = sweep.particles.mass[p];
#pragma GCC unroll 4
    for (int b = 0; b < packs; ++b) {
      const Pack m_phi = (mass * Corners::factor(xi, 0, b)) * (Corners::factor(xi, 1, b) * Corners::factor(xi, 2, b));
#pragma GCC unroll 3
      for (int a = 0; a < 3; ++a) sums[a][b] += v[a] * m_phi;
    }
  }
  Corners::give<3, 4>(range.tile + static_cast<std::size_t>(range.first_in_tile[c]) * 4, sums);
}

template <int D, Shape S>
void map_particles(const ParticleSweep& sweep, const CellRange& range) {
  for (std::uint32_t c = range.begin; c < range.end; ++c) {
    if constexpr (kByCorners<D, S>) {
      map_to_corners(sweep, range, c);
      continue;
    }
    double* const window = range.tile + static_cast<std::size_t>(range.first_in_tile[c]) * 8;
    each_pack(
        range, c, [&](std::size_t p) __attribute__((always_inline)) { ask_for_mapped(sweep, p); },
        [&](const Lanes& lanes) __attribute__((always_inline)) {
          const Weights<D, S> weights(sweep, range, c, lanes);
          const Pack mass = choose(lanes.valid(), load_neighbours(sweep.particles.mass, lanes), Pack{});
          Pack v[D], s[kSymmetric<D>];
          load_neighbours<D, 3>(sweep.particles.velocity, lanes, v);
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
        range, c, [&](std::size_t p) __attribute__((always_inline)) { ask_for_moved(sweep.particles, sweep.xi, p); },
        [&](const Lanes& lanes) __attribute__((always_inline)) {
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
          load_neighbours<D, 3>(sweep.particles.velocity, lanes, v);
          load_neighbours<D, 3>(sweep.particles.position, lanes, x);
#pragma GCC unroll 3
          for (int a = 0; a < D; ++a) {
            v[a] = sweep.kept * v[a] - sweep.less * held[a] + carried[a];
            x[a] += sweep.dt * carried[a];
            speed += v[a] * v[a];
          }
          fastest = larger(fastest, speed);
          store_neighbours<D, 3>(sweep.particles.velocity, lanes, v);
          store_neighbours<D, 3>(sweep.particles.position, lanes, x);
          if constexpr (kByCorners<D, S>) return;
          const Pack mass = choose(lanes.valid(), load_neighbours(sweep.particles.mass, lanes), Pack{});
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
    if constexpr (kByCorners<D, S>) momenta_to_corners(sweep, range, c);
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
    load_neighbours<9, 9>(base, lanes, old);
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
    store_neighbours<9, 9>(base, lanes, d.F);
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
    load_neighbours<kSymmetric<D>, 6>(sweep.particles.elastic_left_cauchy_green, lanes, b.a);
    return {push_forward<D>(f, b), load_neighbours(sweep.particles.plastic_strain, lanes),
            load_neighbours(sweep.particles.plastic_work, lanes)};
  }
}

template <int D, class Law>
SCARP_INLINE void store_history(const ParticleSweep& sweep, const Lanes& lanes, const CurrentHistory<D>& history) {
  if constexpr (Law::template fields < D >> 0) {
    store_neighbours<kSymmetric<D>, 6>(sweep.particles.elastic_left_cauchy_green, lanes, history.b_e.a);
    store_neighbours(sweep.particles.plastic_strain, lanes, history.strain);
    store_neighbours(sweep.particles.plastic_work, lanes, history.work);
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
        range, c,
        [&](std::size_t p) __attribute__((always_inline)) {
          ask_for_deformed<(Law::template fields<D> > 0)>(sweep.particles, sweep.xi, p);
          ask_for_field<1>(sweep.volume, p);
        },
        [&](const Lanes& lanes) __attribute__((always_inline)) {
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
          store_neighbours<kSymmetric<D>, 6>(sweep.particles.stress, lanes, sigma);
          store_neighbours(sweep.volume, lanes, J * load_neighbours(sweep.particles.reference_volume, lanes));
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
