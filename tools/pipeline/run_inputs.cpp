// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/run_inputs.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "ingest/correct_record.hpp"
#include "ingest/read_record.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/summary.hpp"
#include "tools/scenario/formula.hpp"
#include "tools/scenario/resolve.hpp"

namespace scarp {
namespace {

GroundMotion read_shaking(const ShakingOptions& options, int dimension) {
  AccelerationRecord record = read_record(options.file.path, options.unit);
  for (double& a : record.acceleration) a *= options.scale;
  correct(record, options.baseline, options.high_pass);
  GroundMotion motion(record, options.start);
  motion.direction = (1 / norm(options.direction)) * options.direction;
  motion.base = options.base;
  motion.side = static_cast<int>(options.face.value_or(dimension == 2 ? FaceName::y_min : FaceName::z_min));
  motion.share = options.record == RecordPlace::outcrop ? 0.5 : 1;
  return motion;
}

WaterTable read_water(const Project& project, const WaterTableOptions& local, const SiteFrame& site) {
  WaterTable water;
  const std::optional<Vec3>& gravity = project.scenario.solver.gravity;
  water.unit_weight = local.density * (gravity ? norm(*gravity) : 9.81);
  water.line = local.line;
  if (local.elevation) water.line = {{0, *local.elevation}};
  if (local.surface) water.surface = local_surface(local.surface->path, site);
  return water;
}

}  // namespace

void add_run_inputs(const Project& project, Model& model) {
  Scenario local = project.scenario;
  localize_scenario(local, model.site.origin);
  model.loads = local.loads;
  model.contact = local.contact;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    model.bodies[b].rigid = local.bodies[b].rigid.value_or(RigidOptions{});
  if (!local.solver.body_force.empty())
    model.body_force = compile_field("solver.body_force", local.solver.body_force, model.site.origin);
  model.water.reset();
  if (local.water_table) model.water = read_water(project, *local.water_table, model.site);
  model.shaking.clear();
  for (const ShakingOptions& options : local.shaking)
    model.shaking.push_back(read_shaking(options, local.domain.dimension));
}

std::vector<ProbeOptions> local_probes(const Project& project, const Vec3& origin) {
  Scenario local;
  local.probes = project.scenario.probes;
  localize_scenario(local, origin);
  return local.probes;
}

std::vector<std::string> describe_shaking(const Project& project, const Model& model) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < model.shaking.size(); ++i) {
    const RecordReport r = report_of(model.shaking[i]);
    char text[256];
    std::snprintf(text, sizeof text, ": %.4g s, peaks %.3g m/s2, %.3g m/s, %.3g m; ends with %.2g m/s and %.2g m",
                  r.duration, r.peak_acceleration, r.peak_velocity, r.peak_displacement, r.end_velocity,
                  r.end_displacement);
    sentences.push_back("shaking " + std::filesystem::path(project.scenario.shaking[i].file.path).filename().string() +
                        text);
  }
  return sentences;
}

void record_shaking(const Project& project, const Model& model) {
  if (model.shaking.empty()) return;
  nlohmann::ordered_json reports = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < model.shaking.size(); ++i) {
    const GroundMotion& motion = model.shaking[i];
    std::string rows = "time,acceleration,velocity,displacement\n";
    for (double t : motion.times())
      rows += shortest(t) + "," + shortest(motion.acceleration(t)) + "," + shortest(motion.velocity(t)) + "," +
              shortest(motion.displacement(t)) + "\n";
    write_whole(project.artefacts.shaking(i), rows);
    const RecordReport r = report_of(motion);
    reports.push_back({{"file", project.scenario.shaking[i].file.path},
                       {"duration_s", r.duration},
                       {"peak_acceleration_m_s2", r.peak_acceleration},
                       {"peak_velocity_m_s", r.peak_velocity},
                       {"peak_displacement_m", r.peak_displacement},
                       {"end_velocity_m_s", r.end_velocity},
                       {"end_displacement_m", r.end_displacement}});
  }
  record_summary(project, "shaking", reports);
  for (std::size_t i = model.shaking.size(); std::filesystem::remove(project.artefacts.shaking(i)); ++i) {
  }  // an earlier run's
}

}  // namespace scarp
