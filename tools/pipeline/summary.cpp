// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/summary.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "tools/pipeline/stopwatch.hpp"

namespace scarp {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& vector) { return Json{vector[0], vector[1], vector[2]}; }

Json to_json(const IngestReport& report) {
  Json steps = Json::array();
  for (const CleanReport& step : report.steps)
    steps.push_back({{"filter", step.filter}, {"before", step.before}, {"after", step.after}});
  return {{"scan", report.scan},
          {"points_read", report.points_read},
          {"points_kept", report.points_kept},
          {"not_finite", report.not_finite},
          {"steps", steps},
          {"local_min_m", to_json(report.bounds.min)},
          {"local_max_m", to_json(report.bounds.max)}};
}

Json to_json(const VolumeReport& report) {
  Json materials = Json::object();
  for (const auto& [name, volume] : report.volume_by_material) materials[name] = volume;
  return {{"body", report.body},
          {"input_volume_m3", report.input_volume},
          {"particle_volume_m3", report.particle_volume},
          {"difference_percent", 100 * report.relative_difference()},
          {"particles", report.particles},
          {"cells", report.cells},
          {"full_cells", report.full_cells},
          {"isolated_particles", report.isolated_particles},
          {"points_beside_rule_surface", report.points_beside_rule_surface},
          {"mean_thickness_in_cells", report.mean_thickness_in_cells},
          {"volume_by_material_m3", materials},
          {"closed", report.closed},
          {"self_intersecting", report.self_intersecting}};
}

std::vector<std::string> warnings(const VolumeReport& report) {
  std::vector<std::string> sentences;
  if (std::abs(report.relative_difference()) > 0.01)
    sentences.push_back(report.body +
                        ": the particles' volume differs by more than 1 % from the input's; use smaller " + "cells");
  if (report.mean_thickness_in_cells > 0 && report.mean_thickness_in_cells < 3)
    sentences.push_back(report.body + " is on average only " + shortest(report.mean_thickness_in_cells) +
                        " cells thick; bending and failure need at least 3");
  if (report.isolated_particles > 0)
    sentences.push_back(report.body + ": " + std::to_string(report.isolated_particles) +
                        " particles are alone in their cell, with no neighbour");
  if (report.points_beside_rule_surface > 0)
    sentences.push_back(report.body + ": " + std::to_string(report.points_beside_rule_surface) +
                        " particles lie where the raster of a 'below' rule has no value, so that it left them alone");
  if (report.self_intersecting)
    sentences.push_back("the mesh of " + report.body + " intersects itself; its volume is not to be trusted");
  return sentences;
}

Json to_json(const HistorySample& sample) {
  return {{"time_s", sample.time},
          {"kinetic_J", sample.kinetic},
          {"strain_J", sample.strain},
          {"plastic_J", sample.plastic},
          {"potential_J", sample.potential},
          {"total_J", sample.total},
          {"momentum_kg_m_s", to_json(sample.momentum)},
          {"contact_J", sample.contact},
          {"friction_J", sample.friction},
          {"damping_J", sample.damping},
          {"external_J", sample.external},
          {"angular_momentum_kg_m2_s", to_json(sample.angular_momentum)}};
}

Json read_json(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("pipeline", "cannot read " + path.string(), "no such file or no permission");
  if (std::filesystem::is_directory(path)) throw Error("pipeline", path.string() + " is a folder, not a file");
  Json content = Json::parse(in, nullptr, false);
  if (content.is_discarded())
    throw Error("pipeline", path.string() + " is not valid JSON; delete it and run the stage again");
  return content;
}

void write_json(const std::filesystem::path& path, const Json& content) {
  // Texts from scans (the name of a reference system) may hold bytes that are not UTF-8, which JSON cannot.
  write_whole(path, content.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json read_summary(const Project& project) {
  const std::filesystem::path path = project.artefacts.summary();
  if (!std::filesystem::exists(path)) return Json::object();
  Json summary = read_json(path);
  if (!summary.is_object()) throw Error("pipeline", path.string() + " is not a summary; delete it");
  return summary;
}

void record_summary(const Project& project, const std::string& section, const Json& content) {
  Json summary = read_summary(project);
  summary["title"] = project.scenario.title;
  summary["scarp_version"] = SCARP_VERSION;
  summary["scarp_revision"] = SCARP_REVISION;
  summary[section] = content;
  summary["peak_memory_bytes"] = peak_memory_bytes();
  write_json(project.artefacts.summary(), summary);
}

}  // namespace scarp
