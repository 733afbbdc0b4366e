// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells the particles of updated-Lagrangian bodies lie in, and the way from the tiles of blocks of cells to the
// nodes, see particles.hpp.
#pragma once

#include "solver/kernels/neighbours.hpp"
#include "solver/kernels/particles.hpp"

namespace SCARP_KERNELS {
namespace {

using scarp::kernels::PlaceResult;
using scarp::kernels::PlaceSweep;

/// Of whole numbers and others below 2^51 in magnitude.
SCARP_INLINE Pack round_down(Pack a) {
  constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: what is added to it is rounded
  const Pack near = (a + magic) - magic;
  return near - choose(near > a, all(1), Pack{});
}

template <int D>
void place_particles(const PlaceSweep& sweep, const std::uint32_t* particles, std::size_t begin, std::size_t end,
                     PlaceResult& result) {
  constexpr double edge = scarp::kernels::block_edge(D);
  for (std::size_t j = begin; j < end; j += kLanes) {
    const Lanes lanes(particles + j, static_cast<int>(end - j < kLanes ? end - j : kLanes));
    Pack x[D], key = all(sweep.field), inside{};
    load_neighbours<D, 3>(sweep.position, lanes, x);
    const Pack half = sweep.half_edge ? load_neighbours(sweep.half_edge, lanes) : Pack{};
    const Pack slack = half + sweep.slack, beyond = half - sweep.inside;
    Mask within = ~Mask{};
#pragma GCC unroll 3
    for (int a = D - 1; a >= 0; --a) {
      const double count = sweep.cell_count[a];
      const Pack s = (x[a] - sweep.origin[a]) * sweep.per_cell;
      within &= (s >= -slack) & (s <= count + slack);
      const Pack c = smaller(larger(round_down(s), Pack{}), all(count - 1));
      x[a] = smaller(larger(s - c, -beyond), 1.0 + beyond);
      const Pack block = round_down(c * (1 / edge));
      inside = inside * edge + (c - block * edge);
      key = key * static_cast<double>(sweep.block_count[a]) + block;
    }
    store_neighbours<D, 3>(sweep.xi, lanes, x);
    key = key * 64.0 + inside;
    const Mask found = bits(choose(within, key, Pack{}) + 4503599627370496.0);  // 2^52: the low bits are the number
    for (int l = 0; l < lanes.count; ++l) {
      const auto now = static_cast<std::uint32_t>(found[l]);
      result.changed |= now != sweep.keys[j + l];
      sweep.keys[j + l] = now;
    }
    if (any(lanes.valid() & ~within))
      for (int l = lanes.count; l-- > 0;)
        if (!within[l] && j + l < result.outside) result.outside = j + l;
  }
}

void add_tile(const double* tile, const std::uint32_t* nodes, std::size_t count, double* sums) {
  for (std::size_t t = 0; t < count; ++t) {
    if (nodes[t] == scarp::kernels::kNoNode) continue;
    double* const sum = sums + static_cast<std::size_t>(nodes[t]) * 8;
#pragma GCC unroll 4
    for (int i = 0; i < 8; i += kLanes) add(sum + i, load(tile + t * 8 + i));
  }
}

void add_momenta(const double* tile, const std::uint32_t* nodes, std::size_t count, double* sums) {
  for (std::size_t t = 0; t < count; ++t) {
    if (nodes[t] == scarp::kernels::kNoNode) continue;
    double* const sum = sums + static_cast<std::size_t>(nodes[t]) * 8 + 1;
    using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
    *reinterpret_cast<Four*>(sum) += *reinterpret_cast<const Four*>(tile + t * 4);
  }
}

}  // namespace
}  // namespace SCARP_KERNELS
