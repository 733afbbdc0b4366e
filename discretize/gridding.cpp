// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/gridding.hpp"

#include <cstdio>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// Slack of comparisons between given coordinates and lattice lines, in cells. Far below the distance of a
/// sub-cell's centre to its cell's face, so that no point is gained or lost by it.
constexpr double kSlack = 1e-6;
constexpr char kAxes[] = "xyz";

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

bool whole(double cells) { return std::abs(cells - std::round(cells)) <= kSlack * std::max(1.0, cells); }

void check_cell(const std::string& what, double cell) {
  if (!(cell > 0 && std::isfinite(cell))) throw Error("discretize", what, shortest(cell) + " m", "above 0 m");
}

void check_inside(const DomainOptions& options, const Extent& body, int axis, double site_origin) {
  const double slack = kSlack * options.cell;
  const auto refuse = [&](const char* side, double value, const char* bound, double limit) {
    throw Error("discretize", "body '" + body.body + "': reaches outside the domain, its " + side + " " + kAxes[axis],
                shortest(value + site_origin) + " m", std::string(bound) + " " + shortest(limit + site_origin) + " m");
  };
  if (options.min && body.bounds.min[axis] < (*options.min)[axis] - slack)
    refuse("lowest", body.bounds.min[axis], "at least", (*options.min)[axis]);
  if (options.max && body.bounds.max[axis] > (*options.max)[axis] + slack)
    refuse("highest", body.bounds.max[axis], "at most", (*options.max)[axis]);
}

void check_extent(const Domain& domain, int axis) {
  const double extent = domain.max[axis] - domain.min[axis];
  const std::string name = std::string("domain: extent along ") + kAxes[axis];
  if (!(extent > 0)) throw Error("discretize", name, shortest(extent) + " m", "above 0 m");
  const double cells = extent / domain.cell;
  if (!whole(cells))
    throw Error("discretize", name, shortest(cells) + " cells of " + shortest(domain.cell) + " m", "whole cells");
  if (cells > std::numeric_limits<std::int32_t>::max() - 1)
    throw Error("discretize", name, shortest(cells) + " cells of " + shortest(domain.cell) + " m", "below 2^31 cells");
}

int points_per_direction(const BodyOptions& options, int dimension) {
  const int wanted = options.points_per_cell == 0 ? (dimension == 2 ? 4 : 8) : options.points_per_cell;
  for (int n = 1; n <= 31; ++n)
    if ((dimension == 2 ? n * n : n * n * n) == wanted) return n;
  throw Error("discretize", "body '" + options.name + "': points_per_cell", std::to_string(wanted),
              dimension == 2 ? "1, 4, 9, 16, 25, ... (a square)" : "1, 8, 27, 64, ... (a cube)");
}

/// A held face acts on the body only where the body has nodes.
void check_held_faces(const Domain& domain, const std::string& body, double cell) {
  for (int axis = 0; axis < domain.dimension; ++axis) {
    const double cells = (domain.max[axis] - domain.min[axis]) / cell;
    if (domain.faces[2 * axis + 1] != Condition::free && !whole(cells))
      throw Error("discretize",
                  "body '" + body + "': the held upper " + kAxes[axis] + " face of the domain misses its nodes",
                  shortest(cells) + " of its cells of " + shortest(cell) + " m from face to face", "whole cells");
  }
}

}  // namespace

Domain lay_domain(const DomainOptions& options, const std::vector<Extent>& bodies, const Vec3& site_origin) {
  check_cell("domain.cell", options.cell);
  Domain domain{options.dimension, options.cell, {}, {}, {}};
  const BoundaryOptions& b = options.boundary;
  domain.faces = {b.x_min, b.x_max, b.y_min, b.y_max, b.z_min, b.z_max};
  Box3 all;
  for (const Extent& body : bodies) {
    all.extend(body.bounds.min);
    all.extend(body.bounds.max);
  }
  for (int axis = 0; axis < options.dimension; ++axis) {
    for (const Extent& body : bodies) check_inside(options, body, axis, site_origin[axis]);
    const double h = options.cell;
    domain.min[axis] = options.min ? (*options.min)[axis] : std::floor(all.min[axis] / h + kSlack) * h;
    domain.max[axis] =
        options.max ? (*options.max)[axis]
                    : domain.min[axis] + std::max(1.0, std::ceil((all.max[axis] - domain.min[axis]) / h - kSlack)) * h;
    check_extent(domain, axis);
  }
  if (options.dimension == 2) domain.faces[4] = domain.faces[5] = Condition::free;
  return domain;
}

SubLattice lay_lattice(const Domain& domain, const BodyOptions& options, const Extent& extent) {
  const double h = options.cell.value_or(domain.cell);
  SubLattice grid;
  check_cell("body '" + options.name + "': cell", h);
  grid.per_cell = points_per_direction(options, domain.dimension);
  grid.lattice.cell = h;
  check_held_faces(domain, options.name, h);
  double columns = 1;
  for (int axis = 0; axis < domain.dimension; ++axis) {
    const double skipped = std::floor((extent.bounds.min[axis] - domain.min[axis]) / h + kSlack);
    grid.lattice.origin[axis] = domain.min[axis] + skipped * h;
    const double cells = std::max(1.0, std::ceil((extent.bounds.max[axis] - grid.lattice.origin[axis]) / h - kSlack));
    if (axis + 1 < domain.dimension) columns *= cells * grid.per_cell;
    if (!(cells * grid.per_cell < std::numeric_limits<std::int32_t>::max())) columns = INFINITY;
    if (std::isfinite(columns)) grid.lattice.cells[axis] = static_cast<std::int32_t>(cells);
  }
  const double points = extent.volume / std::pow(h / grid.per_cell, domain.dimension);
  if (!(columns <= kMostColumns) || !(points <= kMostParticles))
    throw Error("discretize", "body '" + options.name + "': too many material points",
                "about " + three_digits(points) + " with cells of " + shortest(h) + " m and " +
                    std::to_string(grid.per_cell) + " points along each edge",
                "at most 2e9 points in 1e9 columns: use larger cells");
  const auto axis = [&](int a) {
    return Axis::centres(grid.lattice.origin[a], h, grid.lattice.cells[a], grid.per_cell);
  };
  grid.x = axis(0);
  grid.y = domain.dimension == 2 ? Axis::flat() : axis(1);
  grid.up = domain.dimension == 2 ? axis(1) : axis(2);
  return grid;
}

}  // namespace scarp
