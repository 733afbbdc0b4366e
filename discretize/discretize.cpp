// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/discretize.hpp"

#include <algorithm>
#include <new>

#include "discretize/assign_material.hpp"
#include "discretize/boundary.hpp"
#include "discretize/gridding.hpp"
#include "discretize/held_nodes.hpp"
#include "discretize/scan_attributes.hpp"
#include "discretize/seed.hpp"
#include "discretize/solid.hpp"
#include "discretize/terrain_boundary.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// One body on its way from a volume to points.
struct Work {
  const BodyOptions& options;
  Solid solid;
  SubLattice grid;
  Columns columns;
  std::vector<OccupiedCell> cells;

  const TerrainSolid* terrain() const { return std::get_if<TerrainSolid>(&solid); }
  Extent extent() const {
    return std::visit([&](const auto& s) { return Extent{options.name, s.bounds, s.volume}; }, solid);
  }
};

std::vector<Work> close_volumes(const DiscretizeInput& input) {
  std::vector<Work> bodies;
  for (const BodyOptions& options : input.scenario.bodies)
    bodies.push_back({options, close_volume(options, input), {}, {}, {}});
  if (bodies.empty()) throw Error("discretize", "bodies", "none", "at least one body");
  return bodies;
}

std::vector<Extent> extents(const std::vector<Work>& bodies) {
  std::vector<Extent> all;
  for (const Work& body : bodies) all.push_back(body.extent());
  return all;
}

void fill_lattice(const Domain& domain, int threads, Work& body) {
  const Extent extent = body.extent();
  body.grid = lay_lattice(domain, body.options, extent);
  body.columns = std::visit([&](const auto& solid) { return fill(solid, body.grid, threads); }, body.solid);
  body.cells = occupied_cells(body.grid, body.columns, threads);
  if (!body.cells.empty()) return;
  const Vec3 size = extent.bounds.max - extent.bounds.min;
  std::string text = shortest(size[0]) + " x " + shortest(size[1]);
  if (!body.grid.flat()) text += " x " + shortest(size[2]);
  throw Error("discretize", "body '" + body.options.name + "' has no material points: its size",
              text + " m with cells of " + shortest(body.grid.lattice.cell) + " m",
              "a size that holds the centre of at least one sub-cell: use smaller cells");
}

/// Room for all points, and each body's range in them.
void allocate(const std::vector<Work>& bodies, Model& model) {
  std::size_t count = 0;
  for (const Work& work : bodies) {
    const std::size_t points = work.columns.points();
    Body body;
    body.name = work.options.name;
    body.formulation = work.options.formulation;
    body.lattice = work.grid.lattice;
    body.begin = count;
    body.end = count += points;
    body.boundary = boundary_of(work.solid, model.domain.dimension, work.grid.lattice.cell / work.grid.per_cell);
    if (const auto* ball = std::get_if<BallSolid>(&work.solid)) body.ball_radius = ball->radius;
    model.bodies.push_back(std::move(body));
  }
  const std::string found = std::to_string(count) + " in cells of " + shortest(model.domain.cell) + " m";
  if (static_cast<double>(count) > kMostParticles)
    throw Error("discretize", "material points of all bodies", found, "at most 2e9: use larger cells");
  try {
    resize_constants(model.particles, count);
  } catch (const std::bad_alloc&) {
    throw Error("discretize", "material points do not fit into memory", found, "fewer points: use larger cells");
  }
}

void set_out(const Work& work, std::size_t index, int threads, Model& model) {
  const Body& body = model.bodies[index];
  seed(work.grid, work.columns, work.cells, body.begin, threads, model.particles);
  std::fill(model.particles.body.begin() + static_cast<std::ptrdiff_t>(body.begin),
            model.particles.body.begin() + static_cast<std::ptrdiff_t>(body.end), static_cast<std::int32_t>(index));
  if (work.options.velocity == Vec3{0, 0, 0}) return;
  std::vector<Vec3>& velocity = model.particles.velocity;
  velocity.resize(model.particles.size(), Vec3{0, 0, 0});
  std::fill(velocity.begin() + static_cast<std::ptrdiff_t>(body.begin),
            velocity.begin() + static_cast<std::ptrdiff_t>(body.end), work.options.velocity);
}

/// Colours and materials, with the scan that the body was made from.
void dress(const Work& work, std::size_t index, const DiscretizeInput& input, Model& model, VolumeReport& report) {
  const Body& body = model.bodies[index];
  const PointCloud* scan = work.terrain() ? &input.scans.at(work.terrain()->scan) : nullptr;
  std::vector<std::uint32_t> scan_points;
  if (scan && (!scan->colour.empty() || needs_scan_points(work.options)))
    scan_points =
        find_scan_points(work.grid, work.columns, *scan, body.begin, body.end, input.threads, model.particles);
  if (scan && !scan->colour.empty()) paint(*scan, scan_points, body.begin, input.threads, model.particles);
  const RuleContext context{input.scenario.domain.dimension, input.surfaces, scan, scan_points};
  assign_materials(work.options, context, index, input.threads, model, report);
}

void measure(const Work& work, VolumeReport& report) {
  report.body = work.options.name;
  report.input_volume = work.extent().volume;
  report.particles = work.columns.points();
  count_cells(work.grid, work.cells, report);
  if (const TerrainSolid* terrain = work.terrain()) {
    report.plan_area = terrain->plan_area;
    report.mean_thickness_in_cells = terrain->volume / (terrain->plan_area * work.grid.lattice.cell);
  }
  if (const auto* mesh = std::get_if<MeshSolid>(&work.solid)) report.self_intersecting = mesh->self_intersecting;
}

void check_velocity(const Scenario& scenario) {
  for (const BodyOptions& body : scenario.bodies) {
    if (!is_finite(body.velocity))
      throw Error("discretize", "body '" + body.name + "': velocity", "a component that is not finite", "finite m/s");
    if (scenario.domain.dimension == 2 && body.velocity[2] != 0)
      throw Error("discretize", "body '" + body.name + "': velocity out of the plane",
                  shortest(body.velocity[2]) + " m/s", "0 in two dimensions");
  }
}

}  // namespace

Model discretize(const DiscretizeInput& input) {
  Model model;
  model.site = input.site;
  for (const auto& [name, law] : input.scenario.materials) model.materials.push_back({name, law});
  check_velocity(input.scenario);

  std::vector<Work> bodies = close_volumes(input);
  model.domain = lay_domain(input.scenario.domain, extents(bodies), input.site.origin);
  for (Work& body : bodies) fill_lattice(model.domain, input.threads, body);
  allocate(bodies, model);

  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Work& work = bodies[b];
    VolumeReport report;
    measure(work, report);
    set_out(work, b, input.threads, model);
    if (auto* terrain = std::get_if<TerrainSolid>(&work.solid)) {
      if (model.bodies[b].formulation == Formulation::rigid)
        model.bodies[b].boundary = terrain_boundary(*terrain, work.options.name);
      else
        model.bodies[b].held = hold_nodes(*terrain, work.grid, work.columns, work.cells, input.threads);
      terrain->tin = terrain->base_tin = {};  // as large as the scans, and of no more use
    }
    dress(work, b, input, model, report);
    model.volumes.push_back(std::move(report));
  }
  return model;
}

}  // namespace scarp
