// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "solver/core/linear_cell.hpp"
#include "solver/core/triangle_tree.hpp"

namespace scarp {
namespace {

/// A particle next to the true boundary has its centre inside by less than half the diagonal of its share of a cell,
/// and one that sees the outside past a corner by a layer more.
constexpr double kDeepest = 1.5;

/// A surface point of a smeared body lies at most this far from its particle, in spacings: half of one for a face along
/// the lattice, less for others; the next layer is 0.35 further at least.
constexpr double kFarthest = 0.75;

struct Spline {
  double value, slope;
};

Spline quadratic(double r) {
  const double a = std::abs(r);
  if (a >= 1.5) return {0, 0};
  if (a <= 0.5) return {0.75 - r * r, -2 * r};
  return {0.5 * (1.5 - a) * (1.5 - a), r > 0 ? a - 1.5 : 1.5 - a};
}

/// The body's particles, smeared over `width`.
class Smeared {
 public:
  Smeared(const std::vector<Vec3>& points, const std::vector<double>& volumes, double width, int dimension)
      : points_(points), volumes_(volumes), width_(width), dimension_(dimension) {
    cells_.build(points, 1.5 * width, dimension);
  }

  double value(const Vec3& x) const {
    double sum = 0;
    cells_.each_near(x, [&](std::uint32_t q) {
      double product = volumes_[q];
      for (int a = 0; a < dimension_; ++a) product *= quadratic((x[a] - points_[q][a]) / width_).value;
      sum += product;
    });
    return sum / std::pow(width_, dimension_);
  }

  /// Times the width.
  Vec3 gradient(const Vec3& x) const {
    Vec3 sum{0, 0, 0};
    cells_.each_near(x, [&](std::uint32_t q) {
      Spline s[3];
      for (int a = 0; a < dimension_; ++a) s[a] = quadratic((x[a] - points_[q][a]) / width_);
      for (int a = 0; a < dimension_; ++a) {
        double product = volumes_[q] * s[a].slope;
        for (int b = 0; b < dimension_; ++b)
          if (b != a) product *= s[b].value;
        sum[a] += product;
      }
    });
    return (1 / std::pow(width_, dimension_)) * sum;
  }

  std::size_t neighbours(const Vec3& x, double radius) const {
    std::size_t count = 0;
    cells_.each_near(x, [&](std::uint32_t q) { count += norm(points_[q] - x) < radius; });
    return count;
  }

 private:
  const std::vector<Vec3>& points_;
  const std::vector<double>& volumes_;
  double width_;
  int dimension_;
  CellList cells_;
};

/// How far along N from X the smeared body has thinned out to a half, m; above kFarthest spacings where it has not.
double distance_to_surface(const Smeared& body, const Vec3& X, const Vec3& N, double spacing) {
  if (body.value(X) <= 0.5) return 0;
  double inside = 0, outside = 0;
  do {
    inside = outside;
    outside += 0.15 * spacing;
    if (inside > kFarthest * spacing) return outside;
  } while (body.value(X + outside * N) > 0.5);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (body.value(X + middle * N) > 0.5 ? inside : outside) = middle;
  }
  return inside;
}

/// Nearest point of the body's true boundary, if that is known and near, and not at the rim of an open one.
std::optional<std::pair<Vec3, Vec3>> point_of_boundary(const TriangleTree& boundary, const Vec3& X, double farthest,
                                                       int dimension) {
  const auto closest = boundary.closest(X, farthest);
  if (!closest || boundary.on_border(*closest)) return std::nullopt;
  Vec3 Y = closest->point, N = boundary.normal(*closest);
  if (dimension == 2) Y[2] = N[2] = 0;
  const double length = norm(N);
  if (!(length > 0)) return std::nullopt;
  return std::pair(Y, (1 / length) * N);
}

void find_points(ContactSurface& surface, const Particles& particles, const Body& body, int dimension) {
  const auto first = static_cast<std::ptrdiff_t>(body.begin), last = static_cast<std::ptrdiff_t>(body.end);
  const std::vector<Vec3> points(particles.reference_position.begin() + first,
                                 particles.reference_position.begin() + last);
  const std::vector<double> volumes(particles.reference_volume.begin() + first,
                                    particles.reference_volume.begin() + last);
  const double s = surface.spacing;
  const Smeared sharp(points, volumes, s, dimension), smooth(points, volumes, 2 * s, dimension);
  // Inside a lattice a point has itself and its neighbours across faces and edges within 1.45 spacings.
  const std::size_t surrounded = dimension == 2 ? 9 : 19;
  std::optional<TriangleTree> boundary;
  if (!body.boundary.triangles.empty()) boundary.emplace(body.boundary);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sharp.neighbours(points[i], 1.45 * s) >= surrounded) continue;
    const Vec3 g = smooth.gradient(points[i]);
    if (norm(g) < 0.02) continue;  // in the middle of a sheet: nothing is outward
    Vec3 N = (-1 / norm(g)) * g, Y;
    const auto known = boundary ? point_of_boundary(*boundary, points[i], kDeepest * s, dimension) : std::nullopt;
    if (known) {
      std::tie(Y, N) = *known;
    } else {
      const double distance = distance_to_surface(sharp, points[i], N, s);
      if (distance > kFarthest * s) continue;
      Y = points[i] + distance * N;
    }
    surface.particle.push_back(static_cast<std::uint32_t>(body.begin + i));
    surface.Y.push_back(Y);
    surface.N.push_back(N);
  }
}

/// A point's area is one over the density of points around it.
void find_areas(ContactSurface& surface, int dimension) {
  const double reach = 2.5 * surface.spacing;
  const double whole = dimension == 2 ? 16 * reach / 15 : std::numbers::pi * reach * reach / 3;
  CellList cells;
  cells.build(surface.Y, reach, dimension);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    double density = 0;
    cells.each_near(surface.Y[i], [&](std::uint32_t j) {
      const Vec3 d = (1 / reach) * (surface.Y[j] - surface.Y[i]);
      const double near = 1 - dot(d, d);
      if (near > 0 && dot(surface.N[i], surface.N[j]) > 0) density += near * near;
    });
    surface.area.push_back(whole / density);
  }
}

template <int D>
void find_weights(ContactSurface& surface, const Model& model, const TotalBody& body) {
  using Cell = LinearCell<D>;
  const ReferenceGrid& grid = body.grid;
  surface.cell_edge = grid.cell;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::size_t p = surface.particle[i];
    const auto cell = static_cast<std::uint32_t>(std::upper_bound(grid.cell_begin.begin(), grid.cell_begin.end(), p) -
                                                 grid.cell_begin.begin() - 1);
    const Vec3 X = model.particles.reference_position[p], xi = grid.place(cell, p - body.begin, X),
               place = xi + (1 / grid.cell) * (surface.Y[i] - X);
    surface.cell.push_back(cell);
    surface.xi.push_back(xi);
    for (int k = 0; k < Cell::N; ++k) {
      double value = 1;
      for (int a = 0; a < D; ++a) value *= k >> a & 1 ? place[a] : 1 - place[a];
      surface.nodes.push_back(grid.cell_nodes[cell * Cell::N + k]);
      surface.weights.push_back(value);
    }
  }
}

/// Row sums of phi M^-1 phi^T over the points: no set of forces accelerates a point by more than its row times the
/// largest of them.
void find_mobility(ContactSurface& surface, const ReferenceGrid& grid) {
  std::vector<double> at_node(grid.nodes.size(), 0);
  for (std::size_t k = 0; k < surface.nodes.size(); ++k) at_node[surface.nodes[k]] += std::abs(surface.weights[k]);
  const auto corners = static_cast<std::size_t>(surface.corners);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    double row = 0;
    for (std::size_t k = i * corners; k < (i + 1) * corners; ++k)
      row += std::abs(surface.weights[k]) * at_node[surface.nodes[k]] / grid.node_mass[surface.nodes[k]];
    surface.mobility.push_back(row);
  }
}

}  // namespace

double mean_spacing(const Model& model, const Body& body) {
  double volume = 0;
  for (std::size_t p = body.begin; p < body.end; ++p) volume += model.particles.reference_volume[p];
  return std::pow(volume / static_cast<double>(body.end - body.begin), 1.0 / model.domain.dimension);
}

ContactSurface find_contact_surface(const Model& model, const Body& body, const TotalBody& total) {
  const int dimension = model.domain.dimension;
  ContactSurface surface;
  surface.corners = total.grid.corners();
  surface.spacing = mean_spacing(model, body);
  find_points(surface, model.particles, body, dimension);
  find_areas(surface, dimension);
  dimension == 2 ? find_weights<2>(surface, model, total) : find_weights<3>(surface, model, total);
  find_mobility(surface, total.grid);
  surface.distinct = surface.nodes;
  std::sort(surface.distinct.begin(), surface.distinct.end());
  surface.distinct.erase(std::unique(surface.distinct.begin(), surface.distinct.end()), surface.distinct.end());
  return surface;
}

}  // namespace scarp
