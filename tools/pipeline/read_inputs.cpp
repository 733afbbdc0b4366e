// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/read_inputs.hpp"

#include <algorithm>

#include "discretize/discretize.hpp"
#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "ingest/read_mesh.hpp"
#include "ingest/read_raster.hpp"
#include "solver/model/error.hpp"
#include "tools/scenario/formula.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/synth/synth.hpp"

namespace scarp {
namespace {

std::string source_of(const ScanOptions& scan) { return scan.file ? scan.file->path : "synthetic scan " + scan.name; }

PointCloud raw_scan(const ScanOptions& scan, int threads) {
  if (scan.synthetic) return synthesize(*scan.synthetic, threads).cloud;
  PointCloud cloud = read_cloud(scan.file->path);
  if (cloud.empty()) throw Error("ingest", scan.file->path + " holds no points", "0 points", "at least 1");
  if (scan.shift != Vec3{0, 0, 0})
    for (Vec3& position : cloud.positions) position = position + scan.shift;
  require_projected_metres(cloud, scan.file->path);
  return cloud;
}

TriangleMesh local_mesh(const std::string& path, const SiteFrame& site) {
  TriangleMesh mesh = read_mesh(path);
  for (Vec3& vertex : mesh.vertices) vertex = vertex - site.origin;
  mesh.site = site;
  return mesh;
}

template <class Alternative, class Variant, class F>
void if_is(const Variant& variant, F&& f) {
  if (const auto* alternative = std::get_if<Alternative>(&variant)) f(*alternative);
}

}  // namespace

Heightfield local_surface(const std::string& path, const SiteFrame& site) {
  Heightfield field = read_raster(path);
  require_same_crs({"the scans", path}, {site.crs, field.site.crs});
  field.x0 -= site.origin[0];
  field.y0 -= site.origin[1];
  for (double& z : field.z) z -= site.origin[2];
  field.site = site;
  return field;
}

SiteFrame for_each_cleaned_scan(const Project& project,
                                const std::function<void(const ScanOptions&, IngestResult)>& use) {
  SiteFrame site;
  Scenario local = project.scenario;
  for (std::size_t i = 0; i < project.scenario.scans.size(); ++i) {
    PointCloud raw = raw_scan(project.scenario.scans[i], project.threads);
    if (i == 0) {
      site.origin = project_origin(site_bounds(raw, local.scans[i].height_unit));
      localize_scenario(local, site.origin);
    }
    IngestResult result = ingest(std::move(raw), local.scans[i], site.origin, project.threads);
    if (i == 0) site.crs = result.cloud.site.crs;
    require_same_crs({source_of(local.scans[0]), source_of(local.scans[i])}, {site.crs, result.cloud.site.crs});
    use(local.scans[i], std::move(result));
    project.reporter->progress(static_cast<double>(i + 1) / static_cast<double>(project.scenario.scans.size()));
  }
  return site;
}

namespace {

void add_velocity_fields(Model& model, const Scenario& scenario) {
  Particles& particles = model.particles;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyOptions& options = scenario.bodies[b];
    if (options.velocity_field.empty()) continue;
    const Field field =
        compile_field("bodies." + options.name + ".velocity_field", options.velocity_field, model.site.origin);
    particles.velocity.resize(particles.size(), Vec3{0, 0, 0});
    for (std::size_t p = model.bodies[b].begin; p < model.bodies[b].end; ++p)
      particles.velocity[p] = particles.velocity[p] + field(particles.reference_position[p], 0);
  }
}

}  // namespace

Model build_model(const Project& project, const std::map<std::string, PointCloud>& scans, const SiteFrame& site) {
  Scenario local = project.scenario;
  localize_scenario(local, site.origin);
  std::map<std::string, TriangleMesh> meshes;
  std::map<std::string, Heightfield> surfaces;
  for (const BodyOptions& body : local.bodies) {
    if_is<MeshVolume>(body.volume, [&](const MeshVolume& volume) {
      meshes.try_emplace(volume.mesh.path, local_mesh(volume.mesh.path, site));
    });
    for (const MaterialRule& rule : body.materials)
      if_is<BelowRule>(rule, [&](const BelowRule& below) {
        surfaces.try_emplace(below.below.path, local_surface(below.below.path, site));
      });
  }
  Model model = discretize(DiscretizeInput{local, scans, meshes, surfaces, site, project.threads});
  add_velocity_fields(model, local);
  return model;
}

std::vector<std::string> scans_of_bodies(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const BodyOptions& body : scenario.bodies)
    if_is<ScanVolume>(body.volume, [&](const ScanVolume& volume) {
      for (const std::string& name : {volume.scan, volume.base_scan.value_or(volume.scan)})
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    });
  return names;
}

std::vector<std::filesystem::path> input_files(const Scenario& scenario) {
  std::vector<std::filesystem::path> files;
  for (const ScanOptions& scan : scenario.scans)
    if (scan.file) files.emplace_back(scan.file->path);
  for (const BodyOptions& body : scenario.bodies) {
    if_is<MeshVolume>(body.volume, [&](const MeshVolume& volume) { files.emplace_back(volume.mesh.path); });
    for (const MaterialRule& rule : body.materials)
      if_is<BelowRule>(rule, [&](const BelowRule& below) { files.emplace_back(below.below.path); });
  }
  for (const CompareOptions& comparison : scenario.compare)
    for (const auto& file : {comparison.m3c2.core_points, comparison.dod.stable.mask, comparison.displacement.targets})
      if (file) files.emplace_back(file->path);
  if (scenario.water_table && scenario.water_table->surface) files.emplace_back(scenario.water_table->surface->path);
  for (const ShakingOptions& shaking : scenario.shaking) files.emplace_back(shaking.file.path);
  return files;
}

}  // namespace scarp
