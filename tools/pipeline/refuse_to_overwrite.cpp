// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/refuse_to_overwrite.hpp"

#include <fstream>
#include <string>
#include <vector>

#include "solver/model/error.hpp"
#include "tools/pipeline/read_inputs.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;

bool is_resolved_scenario(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.rfind("# Resolved scenario", 0) == 0;
}

}  // namespace

void refuse_to_overwrite(const fs::path& input, const fs::path& artefact) {
  std::error_code missing;
  if (fs::equivalent(input, artefact, missing))
    throw Error("pipeline", "the result " + artefact.string() + " would overwrite the input " + input.string(), "",
                "another output folder (-o) or name");
}

void refuse_to_overwrite_inputs(const Project& project) {
  const fs::path scenario = project.artefacts.scenario();
  if (fs::is_regular_file(scenario) && !is_resolved_scenario(scenario))
    throw Error("pipeline",
                "the resolved scenario would overwrite " + scenario.string() + ", which scarp did not write", "",
                "another output folder (-o)");
  std::vector<fs::path> artefacts{project.artefacts.model()};
  for (const ScanOptions& scan : project.scenario.scans) artefacts.push_back(project.artefacts.cloud(scan.name));
  for (const ProbeOptions& probe : project.scenario.probes) artefacts.push_back(project.artefacts.probe(probe.name));
  for (const CompareOptions& comparison : project.scenario.compare)
    for (const char* extension : {".csv", ".las"})
      artefacts.push_back(project.artefacts.compared(comparison.name, extension));
  for (const fs::path& input : input_files(project.scenario))
    for (const fs::path& artefact : artefacts) refuse_to_overwrite(input, artefact);
}

}  // namespace scarp
