// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/write_las.hpp"
#include "ingest/write_raster.hpp"
#include "solver/model/error.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/synth/synth.hpp"

namespace scarp {

std::vector<std::filesystem::path> synth_scans(Project& project) {
  std::vector<std::filesystem::path> files;
  project.reporter->begin("synth");
  for (const ScanOptions& scan : project.scenario.scans) {
    if (!scan.synthetic) continue;
    const SyntheticResult result = synthesize(*scan.synthetic, project.threads);
    const std::filesystem::path folder = project.artefacts.root;
    files.push_back(folder / (scan.name + ".las"));
    write_las(files.back(), result.cloud);
    files.push_back(folder / (scan.name + "_truth.asc"));
    write_raster(files.back(), result.truth);
  }
  project.reporter->end();
  if (files.empty())
    throw Error("synth", "the scenario has no synthetic scan", "", "a [[scans]] entry with a table 'synthetic'");
  return files;
}

}  // namespace scarp
