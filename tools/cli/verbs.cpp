// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/verbs.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "tools/cli/compare_arguments.hpp"
#include "tools/cli/terminal.hpp"
#include "tools/pipeline/bench.hpp"
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
  std::string instruction_set;
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
  verb.add_option("--instruction-set", options.instruction_set,
                  "of the kernels, one of those that `scarp info --cpu` lists; default: the widest")
      ->envname("SCARP_INSTRUCTION_SET");
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
  Project project = open_project(options.scenario, options.overrides, output, options.threads, reporter);
  if (!options.instruction_set.empty()) project.kernels = &kernels::kernels_named(options.instruction_set);
  return project;
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
  CompareOptions options;
  HeightUnit height_unit = HeightUnit::metre;
};

std::map<std::string, HeightUnit> height_units() {
  std::map<std::string, HeightUnit> names;
  for (const auto& [name, unit] : enum_names<HeightUnit>::value) names.emplace(name, unit);
  return names;
}

ExitCode compare_two(const CompareArguments& arguments, const CommonOptions& options) {
  DirectComparison request{arguments.files[0], arguments.files[1],
                           options.output.empty() ? fs::path("compare") : fs::path(options.output), arguments.options,
                           arguments.height_unit};
  std::string& name = request.options.name;
  if (name.empty()) name = request.simulated.stem().string() + "_" + request.observed.stem().string();
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos)
    throw Error("compare", "--name cannot name a file", name, "no slashes, not starting with a dot");
  const CompareMethod method = request.options.method;
  const bool needs_distance =
      method == CompareMethod::c2c || method == CompareMethod::m3c2 || method == CompareMethod::c2m;
  if (needs_distance && !(request.options.max_distance > 0))
    throw Error("compare", "--max-distance is needed to compare two files", shortest(request.options.max_distance),
                "above 0 m");
  Outcome outcome;
  const ComparisonReport report = compare_files(request, options.threads, outcome);
  for (const std::string& warning : report.warnings) std::fprintf(stderr, "scarp: warning: %s\n", warning.c_str());
  if (!options.quiet) std::printf("%s\n", in_one_line(report).c_str());
  return conclude(outcome);
}

void add_compare(CLI::App& app, CommonOptions& options, CompareArguments& arguments, ExitCode& result) {
  CLI::App* verb = app.add_subcommand(
      "compare", "hold simulated clouds against observed ones: SCENARIO.toml, or SIMULATED OBSERVED");
  verb->add_option("FILES", arguments.files, "SCENARIO.toml, or a simulated and an observed cloud or frame")
      ->required()
      ->expected(1, 2);
  add_compare_arguments(*verb, arguments.options);
  verb->add_option("--height-unit", arguments.height_unit, "of the heights in both files (m, ft, us-ft)")
      ->transform(CLI::CheckedTransformer(height_units()));
  add_common(*verb, options, true);
  verb->callback([&] {
    if (arguments.files.size() == 2) {
      result = compare_two(arguments, options);
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

struct BenchArguments {
  BenchOptions options;
  std::vector<std::string> sets;
  std::string json;
};

void print(const BenchReport& report) {
  for (const auto& [name, peak] : report.peak_gflops)
    std::printf("multiply-add peak of %s: %.1f Gflop/s on one thread\n", name.c_str(), peak);
  std::printf("memory, read and written in place: %.1f GB/s on one thread\n", report.stream_gb_per_s);
  std::printf("textbook, processor ns per particle-step: TL %.1f, TL plane strain %.1f, UL %.1f\n\n",
              report.textbook_total_ns, report.textbook_total_2d_ns, report.textbook_updated_ns);
  std::printf("%-40s %-10s %7s %9s %9s %9s %6s %7s\n", "case", "kernels", "threads", "cpu ns", "wall ns", "textbook/",
              "peak", "stream");
  const auto share = [](double s) { return s > 0 ? std::to_string(static_cast<int>(100 * s + 0.5)) + " %" : ""; };
  for (const BenchRow& row : report.rows)
    std::printf("%-40s %-10s %7d %9.2f %9.2f %9.1f %6s %7s\n", row.name.c_str(), row.kernels.c_str(), row.threads,
                row.processor_ns, row.wall_ns, row.ratio, share(row.share_of_peak).c_str(),
                share(row.share_of_stream).c_str());
  if (report.contact.empty()) return;
  std::printf("\n%-47s %-10s %7s %9s %9s %9s\n", "two slabs, a twentieth of their particles touch", "kernels",
              "threads", "cpu ns", "without", "ratio");
  for (const ContactCost& cost : report.contact)
    std::printf("%-47s %-10s %7d %9.2f %9.2f %9.2f\n", cost.name.c_str(), cost.kernels.c_str(), cost.threads,
                cost.with_ns, cost.without_ns, cost.with_ns / cost.without_ns);
}

void add_bench(CLI::App& app, BenchArguments& arguments) {
  CLI::App* verb = app.add_subcommand("bench", "time the solver's steps against the method as a textbook writes it");
  BenchOptions& options = arguments.options;
  verb->add_option("--particles", options.particles, "about how many")->check(CLI::Range(1'000, 100'000'000));
  verb->add_option("--steps", options.steps, "timed per case; the fastest counts")->check(CLI::Range(1, 1'000'000));
  verb->add_option("--threads", options.threads, "numbers of threads, each of which is timed")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024));
  verb->add_option("--instruction-set", arguments.sets, "one or more of `scarp info --cpu`; default: the widest")
      ->delimiter(',')
      ->envname("SCARP_INSTRUCTION_SET");
  verb->add_option("--case", options.only, "only cases whose name holds this text");
  verb->add_option("--json", arguments.json, "also write the figures to this file");
  verb->callback([&arguments] {
    if (!arguments.sets.empty()) arguments.options.kernels.clear();
    for (const std::string& name : arguments.sets) arguments.options.kernels.push_back(&kernels::kernels_named(name));
    const BenchReport report = bench(arguments.options);
    print(report);
    if (!arguments.json.empty()) write_whole(arguments.json, bench_json(report));
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
  BenchArguments benchmark;
  add_bench(app, benchmark);

  std::vector<std::string> files;
  CLI::App* info = app.add_subcommand("info", "say what a cloud, raster, mesh, model or frame file holds");
  bool cpu = false;
  info->add_option("FILE", files, "files");
  info->add_flag("--cpu", cpu, "say which instruction sets the solver's kernels can use here, the one used first");
  info->callback([&files, &cpu] {
    if (files.empty() && !cpu) throw Error("usage", "info needs a FILE or --cpu", "", "see 'scarp info --help'");
    for (const kernels::Kernels& kernels : kernels::available_kernels())
      if (cpu) std::printf("%s: %d doubles per operation\n", kernels.name, kernels.lanes);
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
