// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/read_artefacts.hpp"

#include <nlohmann/json.hpp>

#include "ingest/localize.hpp"
#include "ingest/read_las.hpp"
#include "solver/model/error.hpp"
#include "solver/store/frame_store.hpp"
#include "solver/store/model_store.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {
namespace {

void require(const std::filesystem::path& artefact, const std::string& verb) {
  if (!std::filesystem::exists(artefact))
    throw Error("pipeline", artefact.string() + " does not exist; run 'scarp " + verb + "' (or 'scarp run') first");
}

}  // namespace

SiteFrame read_site(const Project& project) {
  if (project.scenario.scans.empty()) return {};
  const std::filesystem::path path = project.artefacts.ingest_report();
  require(path, "ingest");
  const nlohmann::ordered_json report = read_json(path);
  try {
    const auto& origin = report.at("origin_m");
    return {{origin.at(0), origin.at(1), origin.at(2)}, report.at("crs")};
  } catch (const nlohmann::json::exception& damage) {
    throw Error("pipeline", path.string() + " is not what 'scarp ingest' writes", damage.what());
  }
}

PointCloud read_cleaned_scan(const Project& project, const std::string& scan, const SiteFrame& site) {
  const std::filesystem::path path = project.artefacts.cloud(scan);
  require(path, "ingest");
  PointCloud cloud = read_las(path);
  localize(cloud, site.origin);
  return cloud;
}

Model read_discretized(const Project& project) {
  require(project.artefacts.model(), "discretize");
  return read_model(project.artefacts.model());
}

std::vector<std::pair<std::filesystem::path, double>> read_frame_list(const Project& project) {
  require(project.artefacts.series(), "solve");
  std::vector<std::pair<std::filesystem::path, double>> frames;
  for (const auto& [name, time] : read_series(project.artefacts.series()))
    frames.emplace_back(project.artefacts.root / name, time);
  if (frames.empty())
    throw Error("pipeline", project.artefacts.series().string() + " lists no frames; run 'scarp solve' first");
  return frames;
}

}  // namespace scarp
