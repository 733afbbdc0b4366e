// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/verbs.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "solver/model/error.hpp"
#include "tools/cli/terminal.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/scenario/describe_scenario.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;

/// What every verb that works on a scenario accepts.
struct CommonOptions {
  std::string scenario;
  std::string output;
  std::vector<std::string> overrides;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool quiet = false;
  std::string progress = "auto";

  ProgressStyle style() const {
    return progress == "json"   ? ProgressStyle::json
           : progress == "none" ? ProgressStyle::none
                                : ProgressStyle::automatic;
  }
};

void add_common(CLI::App& verb, CommonOptions& options, bool writes) {
  if (writes)
    verb.add_option("-o,--output", options.output,
                    "output folder; default: out/NAME, NAME being the scenario's folder or file");
  verb.add_option("--set", options.overrides, "key.path=value: overrides a key of the scenario; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--threads", options.threads, "number of threads; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--quiet", options.quiet, "print nothing but errors");
  verb.add_option("--progress", options.progress, "a bar or lines, JSON lines, or nothing")
      ->check(CLI::IsMember({"auto", "json", "none"}));
}

/// out/hillside for datasets/hillside/scenario.toml, out/slope for slope.toml.
fs::path default_output(const fs::path& scenario) {
  const fs::path absolute = fs::absolute(scenario).lexically_normal();
  return fs::path("out") /
         (absolute.filename() == "scenario.toml" ? absolute.parent_path().filename() : absolute.stem());
}

Project open(const CommonOptions& options, Reporter& reporter) {
  const fs::path output = options.output.empty() ? default_output(options.scenario) : fs::path(options.output);
  return open_project(options.scenario, options.overrides, output, options.threads, reporter);
}

ExitCode conclude(const Outcome& outcome) {
  if (outcome.simulation_failed) {
    const Failure& failure = outcome.failure;
    std::fprintf(stderr, "scarp: error: the simulation failed at step %lld, t = %.9g s",
                 static_cast<long long>(failure.step), failure.time);
    if (failure.particle >= 0)
      std::fprintf(stderr, ", particle %lld at (%.6g, %.6g, %.6g)", static_cast<long long>(failure.particle),
                   outcome.failure_site[0], outcome.failure_site[1], outcome.failure_site[2]);
    std::fprintf(stderr, ": %s\n", failure.what.c_str());
    return ExitCode::simulation_failed;
  }
  for (const std::string& excess : outcome.exceeded)
    std::fprintf(stderr, "scarp: error: outside tolerance: %s\n", excess.c_str());
  return outcome.exceeded.empty() ? ExitCode::done : ExitCode::outside_tolerance;
}

using Stage = std::function<void(Project&, Outcome&)>;

/// A verb that runs stages of a scenario.
void add_stage(CLI::App& app, const char* name, const char* what, CommonOptions& options, ExitCode& result,
               Stage stage) {
  CLI::App* verb = app.add_subcommand(name, what);
  verb->add_option("SCENARIO", options.scenario, "scenario file (TOML)")->required();
  add_common(*verb, options, true);
  verb->callback([&options, &result, stage = std::move(stage)] {
    Terminal terminal(options.style(), options.quiet);
    Project project = open(options, terminal);
    Outcome outcome;
    stage(project, outcome);
    if (!options.quiet) std::printf("%s\n", project.artefacts.root.string().c_str());
    result = conclude(outcome);
  });
}

Stage alone(void (*stage)(Project&)) {
  return [stage](Project& project, Outcome&) {
    record_scenario(project);
    stage(project);
  };
}

Stage alone(void (*stage)(Project&, Outcome&)) {
  return [stage](Project& project, Outcome& outcome) {
    record_scenario(project);
    stage(project, outcome);
  };
}

void add_check(CLI::App& app, CommonOptions& options) {
  CLI::App* verb = app.add_subcommand("check", "validate, count particles, estimate memory and steps; writes nothing");
  verb->add_option("SCENARIO", options.scenario, "scenario file (TOML)")->required();
  add_common(*verb, options, false);
  verb->callback([&options] {
    Terminal terminal(ProgressStyle::none, true);
    Project project = open(options, terminal);
    for (const std::string& fact : check_project(project)) std::printf("%s\n", fact.c_str());
  });
}

struct CompareArguments {
  std::vector<std::string> files;
  std::string method = "c2c";
  std::string name;
  double max_distance = 0;
};

DistanceReport compare_two(const CompareArguments& arguments, const CommonOptions& options) {
  DirectComparison request{arguments.files[0], arguments.files[1],
                           options.output.empty() ? fs::path("compare") : fs::path(options.output), arguments.name,
                           arguments.max_distance};
  if (request.name.empty()) request.name = request.simulated.stem().string() + "_" + request.observed.stem().string();
  if (request.name.empty() || request.name[0] == '.' || request.name.find('/') != std::string::npos)
    throw Error("compare", "--name cannot name a file", request.name, "no slashes, not starting with a dot");
  if (!(request.max_distance > 0))
    throw Error("compare", "--max-distance is needed to compare two files", shortest(request.max_distance),
                "above 0 m");
  return compare_files(request, options.threads);
}

void add_compare(CLI::App& app, CommonOptions& options, CompareArguments& arguments, ExitCode& result) {
  CLI::App* verb = app.add_subcommand(
      "compare", "hold simulated clouds against observed ones: SCENARIO.toml, or SIMULATED OBSERVED");
  verb->add_option("FILES", arguments.files, "SCENARIO.toml, or a simulated and an observed cloud or frame")
      ->required()
      ->expected(1, 2);
  verb->add_option("--method", arguments.method, "c2c: distance to the nearest point")->check(CLI::IsMember({"c2c"}));
  verb->add_option("--max-distance", arguments.max_distance, "beyond it a point has no counterpart, m");
  verb->add_option("--name", arguments.name, "stem of the result files");
  add_common(*verb, options, true);
  verb->callback([&] {
    if (arguments.files.size() == 2) {
      const DistanceReport report = compare_two(arguments, options);
      if (!options.quiet && report.matched == 0)
        std::printf("none of %zu points has a counterpart within %.6g m\n", report.points, report.max_distance);
      else if (!options.quiet)
        std::printf("%zu of %zu points matched; mean %.6g m, median %.6g m, 95 %% below %.6g m, largest %.6g m\n",
                    report.matched, report.points, report.mean, report.median, report.percentile_95, report.largest);
      return;
    }
    options.scenario = arguments.files[0];
    Terminal terminal(options.style(), options.quiet);
    Project project = open(options, terminal);
    Outcome outcome;
    record_scenario(project);
    compare_stage(project, outcome);
    result = conclude(outcome);
  });
}

void add_synth(CLI::App& app, CommonOptions& options) {
  CLI::App* verb = app.add_subcommand("synth", "write the scenario's synthetic scans and their exact ground");
  verb->add_option("SCENARIO", options.scenario, "scenario file with [scans.synthetic] tables")->required();
  add_common(*verb, options, true);
  verb->callback([&options] {
    Terminal terminal(options.style(), options.quiet);
    Project project = open(options, terminal);
    for (const fs::path& file : synth_scans(project)) std::printf("%s\n", file.string().c_str());
  });
}

}  // namespace

ExitCode run_command_line(int argc, char** argv) {
  CLI::App app{"From scans of slopes and structures to material-point simulations, pictures and comparisons.", "scarp"};
  app.set_version_flag("--version", "scarp " SCARP_VERSION);
  app.require_subcommand(1);
  CommonOptions options;
  CompareArguments comparison;
  ExitCode result = ExitCode::done;

  add_stage(app, "run", "do all that the scenario asks for", options, result,
            [](Project& project, Outcome& outcome) { outcome = run_project(project); });
  add_stage(app, "ingest", "read and clean the scans", options, result, alone(ingest_stage));
  add_stage(app, "discretize", "fill the bodies with material points", options, result, alone(discretize_stage));
  add_stage(app, "solve", "simulate", options, result, alone(solve_stage));
  add_stage(app, "render", "draw the frames", options, result, alone(render_stage));
  add_compare(app, options, comparison, result);
  add_check(app, options);
  add_synth(app, options);

  std::vector<std::string> files;
  CLI::App* info = app.add_subcommand("info", "say what a cloud, raster, mesh, model or frame file holds");
  info->add_option("FILE", files, "files")->required();
  info->callback([&files] {
    for (const std::string& file : files) std::printf("%s", file_info(file).c_str());
  });
  std::string key;
  CLI::App* describe = app.add_subcommand("describe", "the reference of every scenario key");
  describe->add_option("KEY", key, "a key or the start of one, such as bodies or solver.courant");
  describe->callback([&key] { std::printf("%s", describe_keys(key).c_str()); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    app.exit(wanted);
  } catch (const CLI::ParseError& mistake) {
    throw Error("usage", std::string(mistake.what()) + " (see 'scarp --help')");
  }
  return result;
}

}  // namespace scarp
