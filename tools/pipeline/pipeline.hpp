// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The only code that wires stages: artefact in, pure stage, artefact out. `run` is the stages one after the
// other, each through its artefacts, so that a stage that is run alone gives the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/kernels/choose_kernels.hpp"
#include "solver/model/comparison_report.hpp"
#include "solver/model/reports.hpp"
#include "solver/model/scenario.hpp"
#include "tools/pipeline/artefacts.hpp"
#include "tools/pipeline/reporter.hpp"

namespace scarp {

/// A scenario about to be worked on.
struct Project {
  Scenario scenario;  ///< resolved, in the site's coordinates
  Artefacts artefacts;
  int threads = 1;
  const kernels::Kernels* kernels = &kernels::best_kernels();
  Reporter* reporter = nullptr;  ///< never null when a stage runs
};

/// What the whole amounts to, for the exit code.
struct Outcome {
  bool simulation_failed = false;
  Failure failure;
  Vec3 failure_site{0, 0, 0};         ///< where it failed, site coordinates
  std::vector<std::string> exceeded;  ///< comparisons outside their tolerance, one sentence each
};

/// Reads, overrides and resolves a scenario. @throws Error
Project open_project(const std::filesystem::path& scenario_file, const std::vector<std::string>& overrides,
                     const std::filesystem::path& output, int threads, Reporter& reporter);

/// Every stage reads the artefacts before it and throws an Error naming the verb that makes one that is missing.
void ingest_stage(Project& project);
void discretize_stage(Project& project);
void solve_stage(Project& project, Outcome& outcome);
void render_stage(Project& project);
void compare_stage(Project& project, Outcome& outcome);
Outcome run_project(Project& project);

/// Writes the resolved scenario with the provenance of its inputs; every verb that writes artefacts starts with it.
void record_scenario(const Project& project);

/// What `scarp check` says, one line per fact; writes nothing.
std::vector<std::string> check_project(Project& project);

/// What files hold, for `scarp info`; one text per file.
std::string file_info(const std::filesystem::path& file);

/// Whether a file is a triangle mesh: OBJ, STL, or PLY with faces.
bool holds_mesh(const std::filesystem::path& file);

/// Makes each synthetic scan of the scenario: NAME.las and NAME_truth.asc in the output folder. Returns the files.
std::vector<std::filesystem::path> synth_scans(Project& project);

/// Two files directly; writes OUTPUT/NAME.json and, with the method's results, .csv, .las and rasters. Returns the
/// report.
struct DirectComparison {
  std::filesystem::path simulated, observed, output;
  CompareOptions options;                      ///< name and max_distance are required
  HeightUnit height_unit = HeightUnit::metre;  ///< of both files
};
/// @param outcome takes what exceeds the tolerances
ComparisonReport compare_files(const DirectComparison& request, int threads, Outcome& outcome);

/// What a comparison found, in one line for a person.
std::string in_one_line(const ComparisonReport& report);

}  // namespace scarp
