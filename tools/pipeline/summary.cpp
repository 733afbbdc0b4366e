// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/summary.hpp"

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
          {"mean_thickness_in_cells", report.mean_thickness_in_cells},
          {"volume_by_material_m3", materials},
          {"closed", report.closed},
          {"self_intersecting", report.self_intersecting}};
}

Json to_json(const HistorySample& sample) {
  return {{"time_s", sample.time},
          {"kinetic_J", sample.kinetic},
          {"strain_J", sample.strain},
          {"plastic_J", sample.plastic},
          {"potential_J", sample.potential},
          {"total_J", sample.total},
          {"momentum_kg_m_s", to_json(sample.momentum)}};
}

Json to_json(const DistanceReport& report) {
  return {{"name", report.name},
          {"method", report.method},
          {"unit", "m"},
          {"points", report.points},
          {"matched", report.matched},
          {"max_distance", report.max_distance},
          {"mean", report.mean},
          {"median", report.median},
          {"standard_deviation", report.standard_deviation},
          {"root_mean_square", report.root_mean_square},
          {"percentile_95", report.percentile_95},
          {"largest", report.largest},
          {"convention",
           "unsigned distance from each simulated free-surface point to the nearest observed point; statistics "
           "over matched points, standard deviation with n-1; null where nothing matched"}};
}

Json read_json(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("pipeline", "cannot read " + path.string(), "no such file or no permission");
  Json content = Json::parse(in, nullptr, false);
  if (content.is_discarded())
    throw Error("pipeline", path.string() + " is not valid JSON; delete it and run the stage again");
  return content;
}

void write_json(const std::filesystem::path& path, const Json& content) { write_whole(path, content.dump(2) + "\n"); }

void record_summary(const Project& project, const std::string& section, const Json& content) {
  const std::filesystem::path path = project.artefacts.summary();
  Json summary = std::filesystem::exists(path) ? read_json(path) : Json::object();
  summary["title"] = project.scenario.title;
  summary["scarp_version"] = SCARP_VERSION;
  summary["scarp_revision"] = SCARP_REVISION;
  summary[section] = content;
  summary["peak_memory_bytes"] = peak_memory_bytes();
  write_json(path, summary);
}

}  // namespace scarp
