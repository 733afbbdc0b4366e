// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/bench.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "solver/core/formulations.hpp"
#include "solver/core/make_frame.hpp"
#include "solver/core/reference_grid.hpp"
#include "solver/core/run.hpp"
#include "solver/store/frame_store.hpp"
#include "tests/bench/textbook.hpp"
#include "tools/pipeline/bench_block.hpp"
#include "tools/pipeline/bench_contact.hpp"
#include "tools/pipeline/fastest.hpp"

namespace scarp {
namespace {

constexpr double kFlops = 213;  // of a neo-Hookean point in nodal form: 105 of the cell, 101 of the law, 7 of time

struct Case {
  std::string name;
  int dimension = 3;
  Material law;
  Formulation formulation = Formulation::total_lagrangian;
  ShapeFunction shape = ShapeFunction::linear;
  BackEnd back_end = BackEnd::nodal;
  bool jittered = false;
  double shear = 0;  ///< 1/s, of the velocity at the start: how far a history law is driven
  double flops = 0;  ///< per particle-step
  double bytes = 0;  ///< per particle-step: nodes, and history where there is one
  bool whole_run = false;
};

MohrCoulomb soil(double cohesion) { return {{1900, 20e6, 0.3}, cohesion, 28, 0}; }

std::vector<Case> all_cases() {
  const NeoHookean rubber{{1900, 20e6, 0.3}};
  DruckerPrager cone{{1900, 20e6, 0.3}, 1e3, 28, 0};
  constexpr auto updated = Formulation::updated_lagrangian;
  std::vector<Case> cases;
  cases.push_back({.name = "TL neo-Hookean", .law = rubber, .flops = kFlops, .bytes = 47});
  cases.push_back({.name = "TL neo-Hookean, all features", .law = rubber, .whole_run = true});
  cases.push_back({.name = "TL neo-Hookean, cut cells", .law = rubber, .jittered = true});
  cases.push_back({.name = "TL neo-Hookean, particle state", .law = rubber, .back_end = BackEnd::particle_state});
  cases.push_back({.name = "TL neo-Hookean, plane strain", .dimension = 2, .law = rubber});
  cases.push_back({.name = "TL Hencky", .law = Hencky{{1900, 20e6, 0.3}}});
  cases.push_back({.name = "TL Mohr-Coulomb, elastic", .law = soil(1e9), .shear = 1, .bytes = 47 + 64});
  cases.push_back({.name = "TL Mohr-Coulomb, yielding", .law = soil(1e3), .shear = 10, .bytes = 47 + 128});
  cases.push_back({.name = "TL Drucker-Prager, yielding", .law = cone, .shear = 10, .bytes = 47 + 128});
  cases.push_back(
      {.name = "TL von Mises, yielding", .law = VonMises{{1900, 20e6, 0.3}, 1e3}, .shear = 10, .bytes = 47 + 128});
  cases.push_back({.name = "TL Mohr-Coulomb, yielding, plane strain", .dimension = 2, .law = soil(1e3), .shear = 10});
  cases.push_back({.name = "UL linear", .law = rubber, .formulation = updated});
  cases.push_back({.name = "UL quadratic B-spline",
                   .law = rubber,
                   .formulation = updated,
                   .shape = ShapeFunction::quadratic_bspline});
  return cases;
}

/// A block of whole cells of one metre, 2^dimension points in each, one cell away from the faces of the domain.
Model block(const Case& c, std::int64_t particles) {
  const int per_axis = std::max(
      4,
      static_cast<int>(std::lround(std::pow(static_cast<double>(particles) / (1 << c.dimension), 1.0 / c.dimension))));
  Model model;
  const double end = per_axis + 4;
  model.domain = {c.dimension, 1, {0, 0, 0}, {end, end, c.dimension == 3 ? end : 0}, {}};
  model.materials = {{"material", c.law}};
  const int n = 2 * per_axis, layers = c.dimension == 3 ? n : 1;
  add_block(
      model, "block", c.formulation, {n, n, layers},
      [&](int i, int j, int k) {
        Vec3 X{2.25 + 0.5 * i, 2.25 + 0.5 * j, c.dimension == 3 ? 2.25 + 0.5 * k : 0};
        if (c.jittered)
          for (int a = 0; a < c.dimension; ++a) X[a] += 0.2 * std::sin(12.9898 * i + 78.233 * j + 37.719 * k + 4 * a);
        return X;
      },
      [&](const Vec3& X) {
        return Vec3{c.shear * X[1] + 0.01 * std::sin(X[1]), 0.01 * std::cos(X[0]), 0};
      });
  return model;
}

SolverOptions options_of(const Case& c) {
  SolverOptions options;
  options.shape = c.shape;
  options.back_end = c.back_end;
  options.end_time = 1e9;
  return options;
}

Times time_steps(const Case& c, const BenchOptions& options, const kernels::Kernels& kernels, int threads,
                 std::size_t& particles) {
  Model model = block(c, options.particles);
  particles = model.particles.size();
  Formulations method(model, options_of(c), threads, kernels);
  const auto step = [&] { method.step(method.stable_time_step()); };
  for (int i = 0; i < (c.shear > 0 ? 8 : 2); ++i) step();
  // Four at a time: the wave speed is looked for in one of them.
  const Times four = fastest((options.steps + 3) / 4, [&] {
    for (int i = 0; i < 4; ++i) step();
  });
  return {four.processor / 4, four.wall / 4};
}

/// Writes frames as a run does, over each other, into a file that goes with it.
class FrameKeeper : public FrameSink {
 public:
  ~FrameKeeper() override {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  bool takes_blocks() const override { return true; }
  void frame(const Model& model, const ParticleStates& states, double time, std::int64_t step) override {
    write_frame(path_, states.count, [&](const auto& append) {
      states.each_block(
          [&](const Particles& block) { append(make_frame(model, block, OutputOptions{}.fields, time, step)); });
    });
    at_frames_.push_back({watch_.processor(), watch_.wall()});
  }
  /// Of the run so far, if each stretch between two frames had taken as long as the fastest.
  Times fastest() const {
    Times stretch;
    for (std::size_t i = 1; i < at_frames_.size(); ++i) {
      stretch.processor = std::min(stretch.processor, at_frames_[i].processor - at_frames_[i - 1].processor);
      stretch.wall = std::min(stretch.wall, at_frames_[i].wall - at_frames_[i - 1].wall);
    }
    const auto stretches = static_cast<double>(at_frames_.size() - 1);
    return {at_frames_.front().processor + stretches * stretch.processor,
            at_frames_.front().wall + stretches * stretch.wall};
  }
  void sample(const HistorySample&) override {}
  void progress(double, double, std::int64_t, double) override {}

 private:
  Stopwatch watch_;
  std::vector<Times> at_frames_;
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("scarp_bench_" + std::to_string(getpid()) + ".hdf");
};

/// Per step of a whole run of 800: a fixed base and rollers, adapted steps, energies every 20 and a frame on disk every
/// 200; laying out and the first state included.
Times time_run(const Case& c, const BenchOptions& options, const kernels::Kernels& kernels, int threads,
               std::size_t& particles) {
  Model model = block(c, options.particles);
  particles = model.particles.size();
  model.domain.min = {2, 2, 2};
  model.domain.faces[0] = model.domain.faces[2] = FaceCondition::roller;
  model.domain.faces[4] = FaceCondition::fixed;
  // As models come from discretize: in the order of cells, without a state but for velocities.
  sort_by_cell(model);
  std::vector<Vec3> velocity = std::move(model.particles.velocity);
  drop_state(model.particles);
  model.particles.velocity = std::move(velocity);
  SolverOptions solver = options_of(c);
  {
    Model copy = model;
    solver.end_time = 800 * Formulations(copy, solver, threads, kernels).stable_time_step();
  }
  OutputOptions output;
  output.every = solver.end_time / 4;
  output.history_every = solver.end_time / 40;
  FrameKeeper sink;
  const std::int64_t steps = run(model, solver, output, sink, threads, kernels).steps;
  const Times whole = sink.fastest();
  return {whole.processor / static_cast<double>(steps), whole.wall / static_cast<double>(steps)};
}

double time_textbook(int dimension, bool updated, const BenchOptions& options) {
  const int n = static_cast<int>(
      std::lround(std::pow(static_cast<double>(options.particles) / (1 << dimension), 1.0 / dimension)));
  const NeoHookean rubber{{1900, 20e6, 0.3}};
  textbook::Block block(dimension, n, 2, 1900, rubber.shear_modulus(), rubber.lambda());
  for (textbook::Particle& p : block.particles) p.v[0] = 0.01 * std::sin(p.X[1]);
  const double gravity[3] = {0, dimension == 2 ? -9.81 : 0, dimension == 3 ? -9.81 : 0};
  const double dt = 0.4 / rubber.wave_speed();
  const Times times = fastest(std::min(options.steps, 5),
                              [&] { updated ? block.step_updated(dt, gravity) : block.step_total(dt, gravity); });
  return 1e9 * times.processor / static_cast<double>(block.particles.size());
}

double measure_peak(const kernels::Kernels& kernels) {
  constexpr std::int64_t rounds = 2'000'000;
  double kept = 0;
  const Times times = fastest(5, [&] { kept += kernels.multiply_add(rounds); });
  return std::isfinite(kept) ? 24.0 * kernels.lanes * rounds / times.processor * 1e-9 : 0;
}

double measure_stream() {
  std::vector<double> values(32 * 1024 * 1024, 1.0);
  const Times times = fastest(4, [&] {
    for (double& v : values) v = 0.5 * v + 0.25;
  });
  return 16.0 * static_cast<double>(values.size()) / times.processor * 1e-9;
}

BenchRow row_of(const Case& c, const BenchOptions& options, const BenchReport& report, std::size_t set, int threads) {
  const kernels::Kernels& kernels = *options.kernels[set];
  std::size_t particles = 0;
  const Times times = c.whole_run ? time_run(c, options, kernels, threads, particles)
                                  : time_steps(c, options, kernels, threads, particles);
  BenchRow row{.name = c.name,
               .kernels = kernels.name,
               .threads = threads,
               .particles = static_cast<std::int64_t>(particles),
               .reference = ""};
  row.processor_ns = 1e9 * times.processor / static_cast<double>(particles);
  row.wall_ns = 1e9 * times.wall / static_cast<double>(particles);
  const bool updated = c.formulation == Formulation::updated_lagrangian;
  row.reference = updated ? "textbook UL linear" : c.dimension == 2 ? "textbook TL, plane strain" : "textbook TL";
  row.ratio = (updated            ? report.textbook_updated_ns
               : c.dimension == 2 ? report.textbook_total_2d_ns
                                  : report.textbook_total_ns) /
              row.processor_ns;
  row.share_of_peak = c.flops / row.processor_ns / report.peak_gflops[set].second;
  row.share_of_stream = c.bytes / row.processor_ns / report.stream_gb_per_s;
  return row;
}

}  // namespace

BenchReport bench(const BenchOptions& options) {
  BenchReport report;
  for (const kernels::Kernels* kernels : options.kernels)
    report.peak_gflops.emplace_back(kernels->name, measure_peak(*kernels));
  report.stream_gb_per_s = measure_stream();
  report.textbook_total_ns = time_textbook(3, false, options);
  report.textbook_total_2d_ns = time_textbook(2, false, options);
  report.textbook_updated_ns = time_textbook(3, true, options);
  for (const Case& c : all_cases()) {
    if (c.name.find(options.only) == std::string::npos) continue;
    for (std::size_t set = 0; set < options.kernels.size(); ++set)
      for (int threads : options.threads) {
        const bool has_kernel = c.back_end == BackEnd::nodal && c.formulation == Formulation::total_lagrangian;
        if (set == 0 || has_kernel) report.rows.push_back(row_of(c, options, report, set, threads));
      }
  }
  report.contact = bench_contact(options);
  return report;
}

std::string bench_json(const BenchReport& report) {
  nlohmann::ordered_json json;
  json["stream_gb_per_s"] = report.stream_gb_per_s;
  for (const auto& [name, peak] : report.peak_gflops) json["multiply_add_peak_gflops"][name] = peak;
  json["textbook_ns"] = {{"total_lagrangian", report.textbook_total_ns},
                         {"total_lagrangian_plane_strain", report.textbook_total_2d_ns},
                         {"updated_lagrangian", report.textbook_updated_ns}};
  json["cases"] = nlohmann::ordered_json::array();
  const auto if_counted = [](double share) { return share > 0 ? nlohmann::ordered_json(share) : nullptr; };
  for (const BenchRow& row : report.rows)
    json["cases"].push_back({{"case", row.name},
                             {"kernels", row.kernels},
                             {"threads", row.threads},
                             {"particles", row.particles},
                             {"processor_ns_per_particle_step", row.processor_ns},
                             {"wall_ns_per_particle_step", row.wall_ns},
                             {"times_faster_than", row.reference},
                             {"ratio", row.ratio},
                             {"share_of_multiply_add_peak", if_counted(row.share_of_peak)},
                             {"share_of_stream", if_counted(row.share_of_stream)}});
  json["contact"] = nlohmann::ordered_json::array();
  for (const ContactCost& cost : report.contact)
    json["contact"].push_back({{"case", cost.name},
                               {"kernels", cost.kernels},
                               {"threads", cost.threads},
                               {"particles", cost.particles},
                               {"processor_ns_per_particle_step", cost.with_ns},
                               {"without_contact_ns", cost.without_ns},
                               {"ratio", cost.with_ns / cost.without_ns}});
  return json.dump(2) + "\n";
}

}  // namespace scarp
