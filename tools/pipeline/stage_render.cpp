// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/store/frame_store.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"
#include "tools/render/render.hpp"
#include "tools/render/write_picture.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;
using FrameList = std::vector<std::pair<std::filesystem::path, double>>;

RenderContext context_of(const Project& project, const Model& model) {
  RenderContext context;
  context.title = project.scenario.title;
  context.dimension = project.scenario.domain.dimension;
  // The widest spacing of any body: finer ones are then drawn without holes as well.
  for (const Body& body : model.bodies) {
    context.bodies.push_back(body.name);
    if (body.begin == body.end) continue;
    const double volume = model.particles.reference_volume[body.begin];
    context.spacing = std::max(context.spacing, context.dimension == 2 ? std::sqrt(volume) : std::cbrt(volume));
  }
  for (const NamedMaterial& material : model.materials) context.materials.push_back(material.name);
  return context;
}

Json draw(const Project& project, const RenderOptions& options, const FrameList& frames, const RenderContext& context) {
  Scene scene;
  for (const auto& [path, time] : frames) extend_scene(scene, read_frame(path), options);
  std::vector<std::filesystem::path> pictures;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    pictures.push_back(project.artefacts.image(options.name, static_cast<std::int64_t>(i)));
    write_png(pictures.back(), render(read_frame(frames[i].first), scene, options, context, project.threads));
    project.reporter->progress(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
  }
  Json report{{"name", options.name}, {"field", options.colour.field}, {"pictures", pictures.size()}};
  if (options.video) {
    const VideoReport video =
        write_video(project.artefacts.images() / options.name, pictures, options.frames_per_second);
    report["video"] = video.file.filename().string();
    report["codec"] = video.codec;
    if (!video.reason_for_fallback.empty()) {
      report["reason_for_fallback"] = video.reason_for_fallback;
      project.reporter->note("video of " + options.name + ": " + video.reason_for_fallback);
    }
  }
  return report;
}

void clear_pictures(const Project& project, const std::string& name) {
  if (!std::filesystem::exists(project.artefacts.images())) return;
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(project.artefacts.images())) {
    const std::string stem = entry.path().stem().string();
    if (stem == name || (stem.size() == name.size() + 7 && stem.rfind(name + "_", 0) == 0))
      stale.push_back(entry.path());
  }
  for (const auto& path : stale) std::filesystem::remove(path);
}

}  // namespace

void render_stage(Project& project) {
  if (project.scenario.render.empty()) return;
  const Stopwatch watch;
  project.reporter->begin("render");
  warn_unless_made_from(project, Maker::solver);
  const RenderContext context = context_of(project, read_discretized(project));
  const auto frames = read_frame_list(project);
  Json reports = Json::array();
  for (const RenderOptions& options : project.scenario.render) {
    clear_pictures(project, options.name);
    reports.push_back(draw(project, options, frames, context));
  }
  record_summary(project, "render", {{"renders", reports}, {"wall_s", watch.wall()}});
  project.reporter->note(std::to_string(frames.size()) + " pictures of each of " +
                         std::to_string(project.scenario.render.size()) + " views");
  project.reporter->end();
}

}  // namespace scarp
