// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals and gaps of fields that meet, see grid_contact.hpp.
#include <algorithm>
#include <bit>
#include <cmath>

#include "solver/core/grid_contact.hpp"
#include "solver/core/updated_window.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

constexpr std::uint32_t kNone = UpdatedGrid::kNone;
constexpr std::size_t kPlacesPerTask = 32;

/// Gaps up to this, in cells, are none for adhesion: particles are no balls when they stretch.
constexpr double kTouching = 0.05;

/// Directions with gaps this near to each other, in cells, are taken together: a pair that jumped between them would
/// be shaken. An edge on a plane is tilted by more.
constexpr double kAlike = 0.05;

/// Between unit vectors that are one but for rounding.
constexpr double kSame = 1e-12;

/// Smaller than this, a gradient has no direction: per cell, of a fraction.
constexpr double kFlat = 1e-6;

/// f(particle) over those of a cell of a block.
template <class F>
void each_member(const UpdatedGrid& grid, std::uint32_t block, int inside, F&& f) {
  const std::size_t k = static_cast<std::size_t>(block) * UpdatedGrid::kBlockCells + inside;
  const std::uint32_t begin = inside == 0 ? grid.cell_begin[grid.block_begin[block]] : grid.counts[k - 1];
  for (std::uint32_t m = begin; m < grid.counts[k]; ++m) f(grid.members[m]);
}

/// Quadratic B-splines of the cells before, at and behind a place in a cell. Volume beyond a wall is that before it, in
/// a mirror: a wall is no surface of the body.
void smooth_weights(double xi, std::int32_t cell, std::int32_t cells, double (&w)[3]) {
  const double s = std::clamp(xi, 0.0, 1.0);
  w[0] = 0.5 * (1 - s) * (1 - s);
  w[1] = 0.75 - (s - 0.5) * (s - 0.5);
  w[2] = 0.5 * s * s;
  if (cell == 0) w[1] += w[0];
  if (cell + 1 == cells) w[1] += w[2];
}

/// Of one axis: the cells of a difference and a mean about a place that is a node of the lattice or the middle of a
/// cell. That of a middle is the mean of those of both nodes of the cell.
struct Stencil {
  std::int32_t first = 0;
  int count = 1;
  double difference[3] = {0, 0, 0}, mean[3] = {1, 0, 0};

  Stencil() = default;
  explicit Stencil(double place) {
    const auto low = static_cast<std::int32_t>(std::floor(place));
    first = low - 1;
    if (place == low) {
      count = 2;
      difference[0] = 1, difference[1] = -1;
      mean[0] = mean[1] = 0.5;
    } else {
      count = 3;
      difference[0] = 0.5, difference[2] = -0.5;
      mean[0] = mean[2] = 0.25, mean[1] = 0.5;
    }
  }
};

/// Where the function of a node stands, m.
Vec3 place_of(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& at) {
  Vec3 x = grid.origin;
  with_shape(grid, [&]<int D, class S>() {
    for (int a = 0; a < D; ++a) x[a] += grid.cell * S::place(at[a], grid.cell_count[a]);
  });
  return x;
}

/// Directions that may be the normal of a pair, and how the pair stands to each other along them.
class Directions {
 public:
  /// One that is the same but for rounding is one: on flat faces all three are.
  void add(const Vec3& g) {
    const double length = norm(g);
    if (!(length > kFlat)) return;
    const Vec3 n = (1 / length) * g;
    for (int k = 0; k < count_; ++k)
      if (norm(n - n_[k]) < kSame) return;
    const double least = std::min({std::abs(n[0] + n[1] + n[2]), std::abs(n[0] + n[1] - n[2]),
                                   std::abs(n[0] - n[1] + n[2]), std::abs(n[0] - n[1] - n[2])});
    spread_[count_] = std::sqrt(3 - least * least);
    n_[count_++] = n;
  }

  /// Of a cell whose middle is at `x`: whether balls in it, no larger than `radius`, may count and change something.
  bool may_count(const Vec3& x, double half_cell, double beside, double radius, bool is_b) const {
    const double square = dot(x, x);
    for (int k = 0; k < count_; ++k) {
      const double along = dot(x, n_[k]), side = beside + half_cell * spread_[k];
      if (square - along * along > side * side) continue;
      const double far = radius + half_cell * (std::abs(n_[k][0]) + std::abs(n_[k][1]) + std::abs(n_[k][2]));
      if (is_b ? along - far < bottom_[k] : along + far > top_[k]) return true;
    }
    return false;
  }
  /// Axes on which to go through cells from above, so that those that count come first.
  std::array<bool, 3> from_above(bool is_b) const {
    std::array<bool, 3> above{};
    for (int a = 0; a < 3; ++a) above[a] = count_ > 0 && (n_[0][a] > 0) != is_b;
    return above;
  }

  /// A ball at `x` from the node. Only those count whose middle is within `beside` of the line through the node.
  void look(const Vec3& x, double radius, double beside, bool is_b) {
    for (int k = 0; k < count_; ++k) {
      const double along = dot(x, n_[k]);
      if (dot(x, x) - along * along > beside * beside) continue;
      if (is_b)
        bottom_[k] = std::min(bottom_[k], along - radius);
      else
        top_[k] = std::max(top_[k], along + radius);
    }
  }

  /// The direction of the widest gap, or the mean of several that are within `alike` of it. None where they do not face
  /// each other: along one of them there is nothing on one side, and no gap is wider.
  void choose(double alike, Vec3& n, double& gap) const {
    double widest = -INFINITY;
    for (int k = 0; k < count_; ++k) widest = std::max(widest, bottom_[k] - top_[k]);
    if (!(widest < INFINITY)) return;
    double sum = 0, gaps = 0;
    Vec3 mean{0, 0, 0};
    for (int k = 0; k < count_; ++k) {
      const double own = bottom_[k] - top_[k], near = std::max(0.0, 1 - (widest - own) / alike);
      sum += near * near;
      gaps += near * near * own;
      mean = mean + near * near * n_[k];
    }
    const double length = norm(mean);
    if (!(length > 0)) return;
    n = (1 / length) * mean;
    gap = gaps / sum;
  }

 private:
  int count_ = 0;
  Vec3 n_[3];
  double spread_[3];  ///< of a cube of edge 2, across n
  double top_[3] = {-INFINITY, -INFINITY, -INFINITY}, bottom_[3] = {INFINITY, INFINITY, INFINITY};
};

}  // namespace

void GridContact::look(const Particles& particles, const UpdatedGrid& grid, int threads) {
  follow(grid);
  smooth_volumes(particles, grid, threads);
  const std::size_t tasks = (places_.size() + kPlacesPerTask - 1) / kPlacesPerTask;
  parallel_for(tasks, threads, [&](std::size_t t) {
    for (std::size_t i = t * kPlacesPerTask; i < std::min(places_.size(), (t + 1) * kPlacesPerTask); ++i) {
      find_outward(grid, places_[i]);
      for (std::uint32_t k = places_[i].pair_begin; k < places_[i].pair_end; ++k)
        find_gap(particles, grid, places_[i], pairs_[k]);
    }
  });
}

void GridContact::smooth_volumes(const Particles& particles, const UpdatedGrid& grid, int threads) {
  const int D = grid.dimension, e = grid.block_edge, edge = e + 2;
  const std::size_t tile = static_cast<std::size_t>(edge) * edge * (D == 2 ? 1 : edge);
  const double per_cell = 1 / std::pow(grid.cell, D);
  volume_tiles_.assign(wanted_blocks_.size() * tile, 0);
  largest_in_block_.assign(wanted_blocks_.size(), 0);
  parallel_for(wanted_blocks_.size(), threads, [&](std::size_t i) {
    const std::uint32_t block = wanted_blocks_[i];
    double* const sums = &volume_tiles_[i * tile];
    for (std::uint64_t left = wanted_[block]; left != 0; left &= left - 1) {
      const int inside = std::countr_zero(left);
      const std::array<int, 3> local{inside % e, inside / e % e, inside / (e * e)};
      each_member(grid, block, inside, [&](std::uint32_t p) {
        const double V = grid.kernels ? grid.volume[p]
                                      : determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
        radius_[p] = 0.5 * fit_[p] * (D == 2 ? std::sqrt(V) : std::cbrt(V));
        largest_in_block_[i] = std::max(largest_in_block_[i], radius_[p]);
        double w[3][3] = {{}, {}, {0, 1, 0}};
        for (int a = 0; a < D; ++a)
          smooth_weights(grid.xi[p][a], grid.blocks[block][a] * e + local[a], grid.cell_count[a], w[a]);
        for (int k = D == 2 ? 1 : 0; k < (D == 2 ? 2 : 3); ++k)
          for (int j = 0; j < 3; ++j) {
            double* const row = sums + ((D == 2 ? 0 : local[2] + k) * edge + local[1] + j) * edge + local[0];
            for (int l = 0; l < 3; ++l) row[l] += V * per_cell * w[0][l] * w[1][j] * w[2][k];
          }
      });
    }
  });
  largest_radius_ = 0;
  for (const double radius : largest_in_block_) largest_radius_ = std::max(largest_radius_, radius);
}

/// What the blocks of a field give to a cell. Beyond a wall, the cell before it.
double GridContact::volume_fraction(const UpdatedGrid& grid, std::uint32_t field,
                                    std::array<std::int32_t, 3> cell) const {
  const int D = grid.dimension, e = grid.block_edge, edge = e + 2;
  std::array<std::array<std::int32_t, 2>, 3> blocks{};
  for (int a = 0; a < D; ++a) {
    cell[a] = std::clamp(cell[a], 0, grid.cell_count[a] - 1);
    blocks[a] = {std::max(0, (cell[a] - 1) / e), std::min(grid.block_count[a] - 1, (cell[a] + 1) / e)};
  }
  double sum = 0;
  for (std::int32_t z = blocks[2][0]; z <= blocks[2][1]; ++z)
    for (std::int32_t y = blocks[1][0]; y <= blocks[1][1]; ++y)
      for (std::int32_t x = blocks[0][0]; x <= blocks[0][1]; ++x) {
        const std::uint32_t block = grid.block_of_lattice[grid.lattice_block(field, {x, y, z})];
        if (block == kNone || tile_of_block_[block] == kNone) continue;
        const std::size_t tile = static_cast<std::size_t>(edge) * edge * (D == 2 ? 1 : edge);
        const int i = cell[0] - x * e + 1, j = cell[1] - y * e + 1, k = D == 2 ? 0 : cell[2] - z * e + 1;
        sum += volume_tiles_[tile_of_block_[block] * tile + (static_cast<std::size_t>(k) * edge + j) * edge + i];
      }
  return sum;
}

void GridContact::find_outward(const UpdatedGrid& grid, const Place& place) {
  Stencil s[3];
  with_shape(grid, [&]<int D, class S>() {
    for (int a = 0; a < D; ++a) s[a] = Stencil(S::place(place.at[a], grid.cell_count[a]));
  });
  for (std::uint32_t n = place.node_begin; n < place.node_end; ++n) {
    Vec3 g{0, 0, 0};
    for (int k = 0; k < s[2].count; ++k)
      for (int j = 0; j < s[1].count; ++j)
        for (int i = 0; i < s[0].count; ++i) {
          const double f =
              volume_fraction(grid, place_nodes_[n].field, {s[0].first + i, s[1].first + j, s[2].first + k});
          g[0] += f * s[0].difference[i] * s[1].mean[j] * s[2].mean[k];
          g[1] += f * s[0].mean[i] * s[1].difference[j] * s[2].mean[k];
          g[2] += f * s[0].mean[i] * s[1].mean[j] * s[2].difference[k];
        }
    place_nodes_[n].outward = g;
  }
}

void GridContact::find_gap(const Particles& particles, const UpdatedGrid& grid, const Place& place, Pair& pair) const {
  const Vec3 &ga = place_nodes_[pair.a].outward, &gb = place_nodes_[pair.b].outward;
  Directions directions;
  for (const Vec3& g : {ga - gb, ga, -1.0 * gb}) directions.add(g);
  const Vec3 centre = place_of(grid, place.at);
  for (const std::uint32_t side : {pair.a, pair.b}) {
    const bool is_b = side == pair.b;
    const double half = 0.5 * grid.cell;
    const auto may_count = [&](const std::array<std::int32_t, 3>& cell) {
      Vec3 middle{0, 0, 0};
      for (int a = 0; a < grid.dimension; ++a) middle[a] = grid.origin[a] + (cell[a] + 0.5) * grid.cell - centre[a];
      return directions.may_count(middle, half, half + largest_radius_, largest_radius_, is_b);
    };
    each_in_reach(grid, place, place_nodes_[side].field, directions.from_above(is_b), may_count,
                  [&](std::uint32_t p, const auto&) {
                    directions.look(particles.position[p] - centre, radius_[p], half + radius_[p], is_b);
                  });
  }
  pair.n = {0, 0, 0};
  directions.choose(kAlike * grid.cell, pair.n, pair.gap);
  pair.pull = 0;
  if (pair.n == Vec3{0, 0, 0} || !(pair.law.adhesion > 0 && pair.gap < kTouching * grid.cell)) return;
  const double a = area_along(grid, place, place_nodes_[pair.a].field, pair.n);
  const double b = area_along(grid, place, place_nodes_[pair.b].field, -1.0 * pair.n);
  pair.pull = pair.law.adhesion * std::max(0.0, std::min(a, b));
}

/// Integral of phi_I n over the field's surface, along n: by Gauss's theorem sum V_p grad phi_Ip. The places' areas add
/// up to the whole.
double GridContact::area_along(const UpdatedGrid& grid, const Place& place, std::uint32_t field, const Vec3& n) const {
  double area = 0;
  with_shape(grid, [&]<int D, class S>() {
    const auto all = [](const std::array<std::int32_t, 3>&) { return true; };
    each_in_reach(grid, place, field, {}, all, [&](std::uint32_t p, const std::array<std::int32_t, 3>& cell) {
      double N[3][S::width] = {}, dN[3][S::width] = {};
      const double half = S::has_size ? grid.half_edge[p] : 0;
      for (int a = 0; a < D; ++a) S::weigh(grid.xi[p][a], cell[a], grid.cell_count[a], half, N[a], dN[a]);
      const auto at = [&](int a) { return place.at[a] - cell[a]; };
      double along = 0;
      for (int a = 0; a < D; ++a) {
        double part = n[a] / grid.cell;
        for (int b = 0; b < D; ++b) part *= b == a ? dN[b][at(b)] : N[b][at(b)];
        along += part;
      }
      area += along * (D == 2 ? 4 * radius_[p] * radius_[p] : 8 * radius_[p] * radius_[p] * radius_[p]);
    });
  });
  return area;
}

/// f(particle, its cell) over those of a field that give the place's node something, in cells that matter.
/// @param from_above  axes that are gone down
template <class Matters, class F>
void GridContact::each_in_reach(const UpdatedGrid& grid, const Place& place, std::uint32_t field,
                                const std::array<bool, 3>& from_above, Matters&& matters, F&& f) const {
  const int e = grid.block_edge;
  std::array<std::array<std::int32_t, 2>, 3> range{};
  for (int a = 0; a < grid.dimension; ++a)
    range[a] = {std::max(0, place.at[a] - grid.width + 1), std::min(grid.cell_count[a] - 1, place.at[a])};
  const auto at = [&](int a, std::int32_t i) { return from_above[a] ? range[a][0] + range[a][1] - i : i; };
  for (std::int32_t k = range[2][0]; k <= range[2][1]; ++k)
    for (std::int32_t j = range[1][0]; j <= range[1][1]; ++j)
      for (std::int32_t i = range[0][0]; i <= range[0][1]; ++i) {
        const std::int32_t x = at(0, i), y = at(1, j), z = at(2, k);
        const std::uint32_t block = grid.block_of_lattice[grid.lattice_block(field, {x / e, y / e, z / e})];
        if (block == kNone) continue;
        const std::array<std::int32_t, 3> cell{x, y, z};
        if (!matters(cell)) continue;
        each_member(grid, block, (z % e * e + y % e) * e + x % e, [&](std::uint32_t p) {
          if (!grid.half_edge.empty()) {
            for (int a = 0; a < grid.dimension; ++a)
              if (std::abs(cell[a] + grid.xi[p][a] - (place.at[a] - 1)) >= 1 + grid.half_edge[p]) return;
          }
          f(p, cell);
        });
      }
}

}  // namespace scarp
