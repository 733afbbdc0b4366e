// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps of a step over segments and over nodes, see nodal.hpp.
#pragma once

#include "solver/kernels/cell_particle_sweeps.hpp"
#include "solver/kernels/cell_sweeps.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/kernels/packed_laws.hpp"
#include "solver/kernels/particle_sweeps.hpp"

namespace SCARP_KERNELS {
namespace {

using scarp::kernels::CellKind;
using scarp::kernels::EnergyResult;
using scarp::kernels::ForceResult;
using scarp::kernels::ForceSweep;
using scarp::kernels::kSegment;
using scarp::kernels::MomentumSweep;
using scarp::kernels::NodeArrays;
using scarp::kernels::PointState;
using scarp::kernels::Segment;
using scarp::kernels::StressResult;
using scarp::kernels::StressSweep;
using scarp::kernels::VelocitySweep;

/// factor U at the corners.
template <int D>
SCARP_INLINE void gather_displacement(const StressSweep& sweep, const Segment& segment, int lane, double factor,
                                      Pack (&u)[D][kCorners<D>]) {
  for (int c = 0; c < D; ++c) {
    gather<D>(sweep.nodes.U[c], segment, lane, u[c]);
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k) u[c][k] *= factor;
  }
}

/// Asks for the line that a sweep will read four segments later. Points and histories are more streams than the
/// processor foresees, and waiting for them took as long as the work.
SCARP_INLINE void ask_ahead(const double* p, std::size_t per_segment) { __builtin_prefetch(p + 4 * per_segment, 0, 3); }
/// The lines of one place of a segment, once for all its packs.
template <int lines>
SCARP_INLINE void ask_for_place(const double* place, int lane, int places) {
  if (lane != 0) return;
#pragma GCC unroll 8
  for (int line = 0; line < lines; ++line)
    ask_ahead(place + line * kSegment, static_cast<std::size_t>(places) * (lines * kSegment));
}

template <int D, class Law>
SCARP_INLINE double* history_of(const StressSweep& sweep, const Segment& segment, int place, int lane) {
  return sweep.history + segment.history + place * (Law::template fields<D> * kSegment) + lane;
}

/// Zero displacement in lanes without a cell, see cut_deformation.
template <int D>
SCARP_INLINE void keep_where(Mask here, Pack (&u)[D][kCorners<D>]) {
#pragma GCC unroll 3
  for (int c = 0; c < D; ++c)
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k) u[c][k] = choose(here, u[c][k], Pack{});
}

/// F of a point of regular cells.
template <int D>
SCARP_INLINE void regular_deformation(const Pack (&g)[D][D][kHalf<D>], int point, Deformation<D>& d) {
#pragma GCC unroll 3
  for (int c = 0; c < D; ++c)
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis)
      d.F[3 * c + axis] = g[c][axis][across<D>(axis, point)] + (c == axis ? 1.0 : 0.0);
  d.complete();
}

/// The same of cut cells, from U / cell and the point in monomials. F = I where there is no point, V0 = 0: some nodes
/// around an empty place move and some do not, so that it would be crushed, and no number times 0 is 0 then.
template <int D>
SCARP_INLINE void cut_deformation(const Pack (&a)[D][kCorners<D>], const Pack (&m)[kCorners<D>], Pack V0,
                                  Deformation<D>& d) {
#pragma GCC unroll 3
  for (int c = 0; c < D; ++c)
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis)
      d.F[3 * c + axis] = choose(V0 > 0.0, derivative<D>(a[c], m, axis), Pack{}) + (c == axis ? 1.0 : 0.0);
  d.complete();
}

/// What a pack of cells adds up to.
template <int D>
struct CellSums {
  Pack corner[D][kCorners<D>];
  Pack stiffness{};    ///< sum of w c^2
  Pack mean_stress{};  ///< sum of w s, with averages
  Pack weight{};       ///< sum of the points' weights w
  Mask bad{};
};

/// F-bar of a point whose cell has the mean volume ratio J_cell (solver/core/averaged_stress.hpp).
template <int D>
SCARP_INLINE Deformation<D> averaged(const Deformation<D>& d, Pack J_cell, Pack& scale) {
  scale = D == 2 ? square_root(J_cell * d.per_J) : cube_root(J_cell * d.per_J);
  Deformation<D> bar;
  for_entries<D>([&](int i) { bar.F[i] = scale * d.F[i]; });
  bar.complete();
  return bar;
}

/// Points of a cell that go through the law together.
template <int D, class Law>
struct Batch {
  Deformation<D> d[Law::together];  ///< F, with averages F-bar
  Pack scale[Law::together];        ///< with averages, of F to F-bar
  Pack weight[Law::together];       ///< 0 where there is no point
  double* memory[Law::together];
  Points<D, typename Law::template Remembered<D>, Law::together> points;
};

template <int D, class Law, bool average>
SCARP_INLINE void begin_point(Batch<D, Law>& batch, int i, const Deformation<D>& d, Pack J_cell, Pack weight,
                              double* memory, CellSums<D>& sums) {
  sums.bad |= ~(d.J > 0.0) & (weight > 0.0);
  if constexpr (average)
    batch.d[i] = averaged<D>(d, J_cell, batch.scale[i]);
  else
    batch.d[i] = d;
  batch.weight[i] = weight;
  batch.memory[i] = memory;
  if constexpr (Law::together == 1) return;
  batch.points.history[i].begin(batch.d[i], memory);
  batch.points.J[i] = batch.d[i].J;
  batch.points.A[i] = less_unit<D>(batch.points.history[i].elastic());
}

/// What is summed over the cell with grad0 phi. Without averages P; with them
///   J_c (sigma - s I) F^-T = scale (P-bar - s J_c F-bar^-T), and s cof F of the cell's mean s, which comes later.
template <int D, class Law, bool average>
SCARP_INLINE void end_point(const StressSweep& sweep, const Law& law, const Batch<D, Law>& batch, int i, Pack J_cell,
                            Pack (&P)[9], CellSums<D>& sums) {
  const Deformation<D>& d = batch.d[i];
  if constexpr (Law::together == 1)
    law.template stress<D>(d, P);
  else
    first_piola<D>(batch.points.tau[i], d, P);
  Pack stretched = all(1.0);
  if constexpr (average) {
    Pack work{};
    for_entries<D>([&](int k) { work += P[k] * d.F[k]; });
    const Pack scale = batch.scale[i], mean = work * (1.0 / D) * d.per_J, factor = mean * J_cell * d.per_J;
    for_entries<D>([&](int k) { P[k] = scale * (P[k] - factor * d.cofactor[k]); });
    sums.mean_stress += batch.weight[i] * mean;
    stretched = larger(all(1.0), scale * scale);
  }
  if (sweep.find_speed)
    sums.stiffness += batch.weight[i] * stretched *
                      law.template speed_squared<D>(stretch_of<D>(d), ReferenceHistory<D>{&d, batch.memory[i]});
}

template <int D, class Law, bool average>
SCARP_INLINE void begin_regular_point(Batch<D, Law>& batch, int i, const StressSweep& sweep, const Segment& segment,
                                      int lane, int point, Pack J_cell, Pack here, const Pack (&g)[D][D][kHalf<D>],
                                      CellSums<D>& sums) {
  Deformation<D> d;
  regular_deformation<D>(g, point, d);
  begin_point<D, Law, average>(batch, i, d, J_cell, here, history_of<D, Law>(sweep, segment, point, lane), sums);
}

template <int D, class Law, bool average>
SCARP_INLINE void end_regular_point(const StressSweep& sweep, const Law& law, const Batch<D, Law>& batch, int i,
                                    const Segment& segment, int lane, int point, Pack J_cell, Pack (&h)[D][D][kHalf<D>],
                                    CellSums<D>& sums) {
  Pack P[9];
  ask_for_place<Law::template fields<D>>(batch.memory[i], lane, segment.places);
  end_point<D, Law, average>(sweep, law, batch, i, J_cell, P, sums);
#pragma GCC unroll 3
  for (int c = 0; c < D; ++c)
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis) h[c][axis][across<D>(axis, point)] += P[3 * c + axis];
}

/// Mean of det F over the points of regular cells.
template <int D>
SCARP_INLINE Pack regular_mean_volume(const Pack (&g)[D][D][kHalf<D>]) {
  Pack J{};
#pragma GCC unroll 1
  for (int point = 0; point < kCorners<D>; ++point) {
    Deformation<D> d;
    regular_deformation<D>(g, point, d);
    J += d.J;
  }
  return J * (1.0 / kCorners<D>);
}

template <int D, class Law, bool average>
SCARP_INLINE void regular_cells(const StressSweep& sweep, const Law& law, const Segment& segment, int lane,
                                CellSums<D>& sums) {
  Pack u[D][kCorners<D>], g[D][D][kHalf<D>], h[D][D][kHalf<D>] = {};
  gather_displacement<D>(sweep, segment, lane, kRegularFactor<D> * sweep.per_cell, u);
  const double* points = sweep.points + segment.points + lane;
  const Pack V0 = load(points + kSegment), here = choose(V0 > 0.0, all(1.0 / kCorners<D>), Pack{});
  keep_where<D>(V0 > 0.0, u);
  for (int c = 0; c < D; ++c) regular_gradient<D>(u[c], g[c]);
  const Pack J_cell = average ? regular_mean_volume<D>(g) : Pack{};
  Batch<D, Law> batch;
  if constexpr (Law::together == 1 && !average) {
#pragma GCC unroll 8
    for (int point = 0; point < kCorners<D>; ++point) {
      begin_regular_point<D, Law, average>(batch, 0, sweep, segment, lane, point, J_cell, here, g, sums);
      end_regular_point<D, Law, average>(sweep, law, batch, 0, segment, lane, point, J_cell, h, sums);
    }
  } else if constexpr (Law::together == 1) {
#pragma GCC unroll 1
    for (int point = 0; point < kCorners<D>; ++point) {
      begin_regular_point<D, Law, average>(batch, 0, sweep, segment, lane, point, J_cell, here, g, sums);
      end_regular_point<D, Law, average>(sweep, law, batch, 0, segment, lane, point, J_cell, h, sums);
    }
  } else {
    static_assert(Law::together >= kCorners<D>);
    batch.points.count = kCorners<D>;
    batch.points.flow_count = 0;
#pragma GCC unroll 1
    for (int point = 0; point < kCorners<D>; ++point)
      begin_regular_point<D, Law, average>(batch, point, sweep, segment, lane, point, J_cell, here, g, sums);
    law.stresses(batch.points);
#pragma GCC unroll 1
    for (int point = 0; point < kCorners<D>; ++point)
      end_regular_point<D, Law, average>(sweep, law, batch, point, segment, lane, point, J_cell, h, sums);
  }
  if constexpr (average) {
#pragma GCC unroll 1
    for (int point = 0; point < kCorners<D>; ++point) {
      Deformation<D> d;
      regular_deformation<D>(g, point, d);
#pragma GCC unroll 3
      for (int c = 0; c < D; ++c)
#pragma GCC unroll 3
        for (int axis = 0; axis < D; ++axis)
          h[c][axis][across<D>(axis, point)] += sums.mean_stress * d.cofactor[3 * c + axis];
    }
  }
  const Pack factor = V0 * (-kRegularFactor<D> * sweep.per_cell);
  for (int c = 0; c < D; ++c) {
    regular_divergence<D>(h[c], sums.corner[c]);
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k) sums.corner[c][k] *= factor;
  }
  sums.weight = all(1.0);
}

/// Mean of det F over the points of cut cells, weighted by V0.
template <int D>
SCARP_INLINE Pack cut_mean_volume(const StressSweep& sweep, const Segment& segment, int lane,
                                  const Pack (&a)[D][kCorners<D>], Pack& volume) {
  Pack J{};
  volume = Pack{};
#pragma GCC unroll 1
  for (int place = 0; place < segment.places; ++place) {
    const double* point = sweep.points + segment.points + place * ((D + 2) * kSegment) + lane;
    Pack m[kCorners<D>];
    monomials<D>(point, m);
    Deformation<D> d;
    const Pack V0 = load(point + D * kSegment);
    cut_deformation<D>(a, m, V0, d);
    J += V0 * d.J;
    volume += V0;
  }
  volume = choose(volume > 0.0, volume, all(1.0));
  return choose(J != 0.0, J / volume, all(1.0));
}

template <int D, class Law, bool average>
SCARP_INLINE void cut_cells(const StressSweep& sweep, const Law& law, const Segment& segment, int lane,
                            CellSums<D>& sums) {
  Pack a[D][kCorners<D>];
  gather_displacement<D>(sweep, segment, lane, sweep.per_cell, a);
  for (int c = 0; c < D; ++c) {
    to_monomials<D>(a[c]);
    for (int k = 0; k < kCorners<D>; ++k) sums.corner[c][k] = Pack{};
  }
  Pack J_cell{}, volume = all(1.0);
  if constexpr (average) J_cell = cut_mean_volume<D>(sweep, segment, lane, a, volume);
  Batch<D, Law> batch;
  const auto add = [&](const Pack(&m)[kCorners<D>], Pack V0, const Pack(&P)[9]) __attribute__((always_inline)) {
    const Pack factor = -V0 * sweep.per_cell;
#pragma GCC unroll 3
    for (int c = 0; c < D; ++c)
#pragma GCC unroll 3
      for (int axis = 0; axis < D; ++axis) add_derivative<D>(sums.corner[c], m, axis, factor * P[3 * c + axis]);
  };
#pragma GCC unroll 1
  for (int first = 0; first < segment.places; first += Law::together) {
    const int count = segment.places - first < Law::together ? segment.places - first : Law::together;
#pragma GCC unroll 1
    for (int i = 0; i < count; ++i) {
      const double* point = sweep.points + segment.points + (first + i) * ((D + 2) * kSegment) + lane;
      Pack m[kCorners<D>];
      monomials<D>(point, m);
      const Pack V0 = load(point + D * kSegment);
      Deformation<D> d;
      cut_deformation<D>(a, m, V0, d);
      double* const history = history_of<D, Law>(sweep, segment, first + i, lane);
      ask_for_place<D + 2>(point, lane, segment.places);
      ask_for_place<Law::template fields<D>>(history, lane, segment.places);
      // Averages go by volume, the stiffness of a cell by mass: the two differ in their unit alone where a segment is
      // of one law, as all are.
      begin_point<D, Law, average>(batch, i, d, J_cell, V0, history, sums);
      sums.weight += V0;
    }
    if constexpr (Law::together > 1) {
      batch.points.count = count;
      batch.points.flow_count = 0;
      law.stresses(batch.points);
    }
#pragma GCC unroll 1
    for (int i = 0; i < count; ++i) {
      Pack m[kCorners<D>], P[9];
      monomials<D>(sweep.points + segment.points + (first + i) * ((D + 2) * kSegment) + lane, m);
      end_point<D, Law, average>(sweep, law, batch, i, J_cell, P, sums);
      add(m, batch.weight[i], P);
    }
  }
  if constexpr (average) {
    const Pack mean = sums.mean_stress / volume;
#pragma GCC unroll 1
    for (int place = 0; place < segment.places; ++place) {
      const double* point = sweep.points + segment.points + place * ((D + 2) * kSegment) + lane;
      Pack m[kCorners<D>], P[9];
      monomials<D>(point, m);
      const Pack V0 = load(point + D * kSegment);
      Deformation<D> d;
      cut_deformation<D>(a, m, V0, d);
      for_entries<D>([&](int i) { P[i] = mean * d.cofactor[i]; });
      add(m, V0, P);
    }
  }
  for (int c = 0; c < D; ++c) to_corners<D>(sums.corner[c]);
  sums.weight = choose(sums.weight > 0.0, sums.weight, all(1.0));
}

/// Lanes in which some sum is not finite.
template <int D>
SCARP_INLINE Mask not_finite(const CellSums<D>& sums) {
  Pack t = sums.stiffness;
  for (int c = 0; c < D; ++c)
    for (int k = 0; k < kCorners<D>; ++k) t += magnitude(sums.corner[c][k]);
  return ~((t - t) == 0.0);
}

template <int D, class Law, bool average>
void stress_sweep(const StressSweep& sweep, const Segment* begin, const Segment* end, StressResult& result) {
  RowSums<D> rows(sweep.nodes.sum);
  Pack fastest{}, where{};
  for (const Segment* segment = begin; segment != end; ++segment) {
    const Law law(sweep.laws[segment->law].value);
    rows.begin(*segment);
    for (int lane = 0; lane < kSegment; lane += kLanes) {
      CellSums<D> sums;
      if (segment->kind == CellKind::regular)
        regular_cells<D, Law, average>(sweep, law, *segment, lane, sums);
      else
        cut_cells<D, Law, average>(sweep, law, *segment, lane, sums);
      for (int c = 0; c < D; ++c) rows.give(c, lane, sums.corner[c]);
      if (sweep.find_speed) {
        const Pack speed = sums.stiffness / sums.weight;
        where = choose(speed > fastest, all(static_cast<double>(segment - begin)), where);
        fastest = larger(fastest, speed);
      }
      if (any(sums.bad | not_finite(sums)) && result.bad_segment < 0) result.bad_segment = segment - begin;
    }
  }
  rows.flush();
  const double found = largest(fastest);
  if (!(found > result.largest_speed_squared)) return;
  result.largest_speed_squared = found;
  result.fastest_segment = static_cast<std::int64_t>(-largest(choose(fastest == found, -where, all(-1e18))));
}

template <int D, class Law, bool average>
void energy_sweep(const StressSweep& sweep, const Segment* begin, const Segment* end, EnergyResult& result) {
  Pack strain{}, plastic{};
  for (const Segment* segment = begin; segment != end; ++segment) {
    const Law law(sweep.laws[segment->law].value);
    for (int lane = 0; lane < kSegment; lane += kLanes) {
      Pack u[D][kCorners<D>], g[D][D][kHalf<D>];
      const bool regular = segment->kind == CellKind::regular;
      gather_displacement<D>(sweep, *segment, lane, (regular ? kRegularFactor<D> : 1.0) * sweep.per_cell, u);
      const double* points = sweep.points + segment->points + lane;
      if (regular) keep_where<D>(load(points + kSegment) > 0.0, u);
      for (int c = 0; c < D; ++c)
        if (regular)
          regular_gradient<D>(u[c], g[c]);
        else
          to_monomials<D>(u[c]);
      Pack J_cell{}, volume;
      if constexpr (average)
        J_cell = regular ? regular_mean_volume<D>(g) : cut_mean_volume<D>(sweep, *segment, lane, u, volume);
#pragma GCC unroll 1
      for (int place = 0; place < segment->places; ++place) {
        Deformation<D> d;
        Pack V0;
        if (regular) {
          V0 = load(points + kSegment);
          regular_deformation<D>(g, place, d);
        } else {
          const double* point = points + place * ((D + 2) * kSegment);
          Pack m[kCorners<D>];
          monomials<D>(point, m);
          V0 = load(point + D * kSegment);
          cut_deformation<D>(u, m, V0, d);
        }
        double* history = history_of<D, Law>(sweep, *segment, place, lane);
        if constexpr (average) {
          Pack scale;
          d = averaged<D>(d, J_cell, scale);
        }
        strain += V0 * law.template energy<D>(d, history);
        plastic += V0 * Law::template plastic_work<D>(history);
      }
    }
  }
  result.strain += sum(strain);
  result.plastic += sum(plastic);
}

/// V0 of a place; 0 where there is no point.
template <int D>
SCARP_INLINE Pack volume_of(const StressSweep& sweep, const Segment& segment, int place, int lane) {
  const double* points = sweep.points + segment.points + lane;
  return load(segment.kind == CellKind::cut ? points + (place * (D + 2) + D) * kSegment : points + kSegment);
}

/// In monomials: the places of points, which regular cells do not keep.
template <int D>
SCARP_INLINE void place_of(const StressSweep& sweep, const Segment& segment, int place, int lane,
                           Pack (&m)[kCorners<D>]) {
  if (segment.kind == CellKind::cut)
    return monomials<D>(sweep.points + segment.points + place * ((D + 2) * kSegment) + lane, m);
#pragma GCC unroll 8
  for (int k = 0; k < kCorners<D>; ++k) {
    double product = 1;
    for (int axis = 0; axis < D; ++axis)
      if (k >> axis & 1) product *= place >> axis & 1 ? 0.75 : 0.25;
    m[k] = all(product);
  }
}

/// b_e before the law sees it, which may take rounding for flow, and the stress.
template <int D, class Law>
SCARP_INLINE void tell_stress(const Law& law, const Deformation<D>& d, double* history, int lane, PointState& out) {
  CurrentHistory<D> now{left_product<D>(d.F), Pack{}, Pack{}};
  if constexpr (Law::template fields < D >> 0) {
    const ReferenceHistory<D> memory{&d, history};
    now = {memory.elastic(), memory.plastic_strain(), Pack{}};
  }
  const CurrentHistory<D> told = now;
  const Symmetric<D> tau = kirchhoff<D>(law, now, d.J);
  for (int i = 0; i < 6; ++i) {
    const bool there = i < Symmetric<D>::n;
    store(out.stress[i] + lane, there ? tau.a[i] * d.per_J : Pack{});
    store(out.b_e[i] + lane, Law::template fields<D> == 0 ? all(i < 3 ? 1 : 0) : there ? told.b_e.a[i] : Pack{});
  }
}

template <int D, class Law, bool average>
void state_sweep(const StressSweep& sweep, const Segment& segment, PointState* places) {
  const Law law(sweep.laws[segment.law].value);
  for (int lane = 0; lane < kSegment; lane += kLanes) {
    Pack U[D][kCorners<D>], W[D][kCorners<D>], A[D][kCorners<D>];
    gather_displacement<D>(sweep, segment, lane, sweep.per_cell, U);
    for (int c = 0; c < D; ++c) {
      gather<D>(sweep.nodes.W[c], segment, lane, W[c]);
      gather<D>(sweep.nodes.A[c], segment, lane, A[c]);
      to_monomials<D>(U[c]);
      to_monomials<D>(W[c]);
      to_monomials<D>(A[c]);
    }
    const auto deformation = [&](int place, Deformation<D>& d) {
      Pack m[kCorners<D>];
      place_of<D>(sweep, segment, place, lane, m);
      cut_deformation<D>(U, m, volume_of<D>(sweep, segment, place, lane), d);
    };
    Pack J_cell{}, volume{};
    if constexpr (average) {
      for (int place = 0; place < segment.places; ++place) {
        Deformation<D> d;
        deformation(place, d);
        const Pack V0 = volume_of<D>(sweep, segment, place, lane);
        J_cell += V0 * d.J;
        volume += V0;
      }
      J_cell = choose(volume > 0.0, J_cell / choose(volume > 0.0, volume, all(1.0)), all(1.0));
    }
    for (int place = 0; place < segment.places; ++place) {
      PointState& out = places[place];
      Pack m[kCorners<D>];
      place_of<D>(sweep, segment, place, lane, m);
      Deformation<D> d;
      deformation(place, d);
      if constexpr (average) {
        Pack scale;
        d = averaged<D>(d, J_cell, scale);
      }
      for (int c = 0; c < 3; ++c) {
        store(out.displacement[c] + lane, c < D ? value<D>(W[c < D ? c : 0], m) : Pack{});
        store(out.velocity[c] + lane, c < D ? value<D>(A[c < D ? c : 0], m) : Pack{});
        for (int axis = 0; axis < 3; ++axis)
          store(out.F[3 * c + axis] + lane, c < D && axis < D ? d.F[3 * c + axis] : all(c == axis ? 1 : 0));
      }
      tell_stress<D>(law, d, history_of<D, Law>(sweep, segment, place, lane), lane, out);
    }
  }
}

/// sum_J M_IJ a_J of cut cells, in place. One component at a time: all that it needs stays in registers.
/// @param ask  whether to ask for points ahead
template <int D>
SCARP_INLINE void cut_momentum(const double* points, int places, bool ask, Pack (&a)[kCorners<D>]) {
  Pack sums[kCorners<D>] = {};
  to_monomials<D>(a);
#pragma GCC unroll 2
  for (int place = 0; place < places; ++place) {
    const double* point = points + place * ((D + 2) * kSegment);
    if (ask) ask_for_place<D + 2>(point, 0, places);
    Pack m[kCorners<D>];
    monomials<D>(point, m);
    const Pack w = load(point + (D + 1) * kSegment) * value<D>(a, m);
    sums[0] += w;
#pragma GCC unroll 8
    for (int k = 1; k < kCorners<D>; ++k) sums[k] += w * m[k];
  }
  to_corners<D>(sums);
#pragma GCC unroll 8
  for (int k = 0; k < kCorners<D>; ++k) a[k] = sums[k];
}

template <int D>
void momentum_sweep(const MomentumSweep& sweep, const Segment* begin, const Segment* end) {
  RowSums<D> rows(sweep.nodes.sum);
  for (const Segment* segment = begin; segment != end; ++segment) {
    rows.begin(*segment);
    for (int lane = 0; lane < kSegment; lane += kLanes) {
      const double* points = sweep.points + segment->points + lane;
      Pack a[D][kCorners<D>];
      for (int c = 0; c < D; ++c) gather<D>(sweep.nodes.A[c], *segment, lane, a[c]);
      if (segment->kind == CellKind::regular) {
        const Pack mass = kRegularMass<D> * load(points);
        for (int c = 0; c < D; ++c) {
          regular_mass<D>(a[c]);
          for (int k = 0; k < kCorners<D>; ++k) a[c][k] *= mass;
        }
      } else {
        for (int c = 0; c < D; ++c) cut_momentum<D>(points, segment->places, lane == 0 && c == 0, a[c]);
      }
      for (int c = 0; c < D; ++c) rows.give(c, lane, a[c]);
    }
  }
  rows.flush();
}

void force_sweep(const ForceSweep& sweep, std::size_t begin, std::size_t end, ForceResult& result) {
  Pack damped{}, momentum[3] = {};
  for (std::size_t i = begin; i < end; i += kLanes) {
    const Pack per_mass = load(sweep.nodes.per_mass + i);
    const Mask here = per_mass > 0.0;
    const Pack mass = 1.0 / choose(here, per_mass, all(1.0));
    for (int c = 0; c < 3; ++c) {
      const Pack v = load(sweep.nodes.v[c] + i), f = load(sweep.nodes.sum[c] + i), A = load(sweep.nodes.A[c] + i);
      const Pack change = sweep.dt * (f * per_mass + sweep.gravity[c]);
      Pack next = v + change;
      if (sweep.damping > 0) {
        const Pack slowed = next - with_sign(choose(v == 0.0, Pack{}, sweep.damping * magnitude(change)), v);
        damped += choose(here, 0.5 * mass * (next - slowed) * (v + slowed), Pack{});
        next = slowed;
      }
      momentum[c] += choose(here, 0.5 * mass * (v + next), Pack{});
      store(sweep.nodes.A[c] + i, choose(here, sweep.alpha * A + next - sweep.alpha * v, A));
      add(sweep.nodes.W[c] + i, choose(here, sweep.dt * next, Pack{}));
      store(sweep.nodes.sum[c] + i, Pack{});
    }
  }
  result.damped += sum(damped);
  for (int c = 0; c < 3; ++c) result.momentum[c] += sum(momentum[c]);
}

void velocity_sweep(const VelocitySweep& sweep, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; i += kLanes) {
    const Pack per_mass = load(sweep.nodes.per_mass + i);
    for (int c = 0; c < 3; ++c) {
      Pack p = load(sweep.nodes.sum[c] + i);
      if (sweep.start_share != 0) p += sweep.start_share * load(sweep.nodes.P0[c] + i);
      const Pack v = p * per_mass;
      store(sweep.nodes.v[c] + i, v);
      add(sweep.nodes.U[c] + i, sweep.dt * v);
      store(sweep.nodes.sum[c] + i, Pack{});
    }
  }
}

/// Adds copies to the rows that they belong to; they are zero then.
void add_copies(double* row, double* copy, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    add(row + i, load(copy + i));
    store(copy + i, Pack{});
  }
}

void log_of(const double* x, double* result, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLanes) store(result + i, natural_log(load(x + i)));
}

void exp_of(const double* x, double* result, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLanes) store(result + i, exponential(load(x + i)));
}

void inverse_root_of(const double* x, double* result, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLanes) store(result + i, inverse_root(load(x + i)));
}

/// f of kSegment tensors, [entry][lane].
template <int D, class F>
SCARP_INLINE void tensors_of(const double* A, double* result, F&& f) {
  for (int lane = 0; lane < kSegment; lane += kLanes) {
    Symmetric<D> s;
    for (int i = 0; i < Symmetric<D>::n; ++i) s.a[i] = load(A + i * kSegment + lane);
    s = f(s);
    for (int i = 0; i < Symmetric<D>::n; ++i) store(result + i * kSegment + lane, s.a[i]);
  }
}
template <int D>
void half_log_of(const double* A, double* result) {
  tensors_of<D>(A, result, [](const Symmetric<D>& s) { return half_log<D>(s); });
}
template <int D>
void exp_twice_of(const double* e, double* result) {
  tensors_of<D>(e, result, [](const Symmetric<D>& s) { return exp_twice<D>(s); });
}
double multiply_add(std::int64_t rounds) {
  Pack a[12];
  for (int k = 0; k < 12; ++k) a[k] = all(1 + k);
  Pack factor = all(0.999), term = all(1e-3);
  for (std::int64_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (int k = 0; k < 12; ++k) a[k] = a[k] * factor + term;
#if defined(__x86_64__)
    // Keeps the compiler from taking several rounds together.
    asm volatile("" : "+v"(factor), "+v"(term));
#endif
  }
  Pack s{};
  for (int k = 0; k < 12; ++k) s += a[k];
  return sum(s);
}

template <class Law>
void enter(scarp::kernels::Kernels& kernels, scarp::kernels::LawKind kind) {
  const int k = static_cast<int>(kind);
  kernels.stress[k][0][0] = stress_sweep<2, Law, false>;
  kernels.stress[k][0][1] = stress_sweep<2, Law, true>;
  kernels.stress[k][1][0] = stress_sweep<3, Law, false>;
  kernels.stress[k][1][1] = stress_sweep<3, Law, true>;
  kernels.states[k][0][0] = state_sweep<2, Law, false>;
  kernels.states[k][0][1] = state_sweep<2, Law, true>;
  kernels.states[k][1][0] = state_sweep<3, Law, false>;
  kernels.states[k][1][1] = state_sweep<3, Law, true>;
  kernels.energy[k][0][0] = energy_sweep<2, Law, false>;
  kernels.energy[k][0][1] = energy_sweep<2, Law, true>;
  kernels.energy[k][1][0] = energy_sweep<3, Law, false>;
  kernels.energy[k][1][1] = energy_sweep<3, Law, true>;
}

}  // namespace

scarp::kernels::Kernels kernels(const char* name) {
  using scarp::kernels::LawKind;
  scarp::kernels::Kernels table{};
  table.name = name;
  table.lanes = kLanes;
  enter<NeoHookean>(table, LawKind::neo_hookean);
  enter<Hencky>(table, LawKind::hencky);
  enter<VonMises>(table, LawKind::von_mises);
  enter<DruckerPrager>(table, LawKind::drucker_prager);
  enter<MohrCoulomb>(table, LawKind::mohr_coulomb);
  table.momentum[0] = momentum_sweep<2>;
  table.momentum[1] = momentum_sweep<3>;
  table.forces = force_sweep;
  table.velocities = velocity_sweep;
  table.add_copies = add_copies;
  table.particles = particle_kernels();
  table.cells = cell_kernels();
  table.natural_log = log_of;
  table.exponential = exp_of;
  table.inverse_root = inverse_root_of;
  table.half_log[0] = half_log_of<2>;
  table.half_log[1] = half_log_of<3>;
  table.exp_twice[0] = exp_twice_of<2>;
  table.exp_twice[1] = exp_twice_of<3>;
  table.multiply_add = multiply_add;
  return table;
}

}  // namespace SCARP_KERNELS
