// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "ingest/write_las.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {

using Json = nlohmann::ordered_json;

void ingest_stage(Project& project) {
  const Stopwatch watch;
  project.reporter->begin("ingest");
  Json scans = Json::array();
  const SiteFrame site = for_each_cleaned_scan(project, [&](const ScanOptions& scan, IngestResult result) {
    scans.push_back(to_json(result.report));
    write_las(project.artefacts.cloud(scan.name), result.cloud);
    project.reporter->note(scan.name + ": " + std::to_string(result.report.points_read) + " points read, " +
                           std::to_string(result.report.points_kept) + " kept");
  });
  Json report{{"origin_m", to_json(site.origin)}, {"crs", site.crs}, {"scans", scans}};
  write_json(project.artefacts.ingest_report(), report);
  report["wall_s"] = watch.wall();
  record_summary(project, "ingest", report);
  record_made_from(project, Maker::ingest);
  project.reporter->end();
}

}  // namespace scarp
