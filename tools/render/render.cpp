// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/render.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/render/overlay.hpp"
#include "tools/render/shade.hpp"
#include "tools/render/splat.hpp"

namespace scarp {
namespace {

/// Where a particle is drawn: moved on by (exaggeration - 1) times its displacement.
class DrawnPosition {
 public:
  DrawnPosition(const Frame& frame, double exaggeration) : frame_(frame), more_(exaggeration - 1) {
    if (more_ != 0)
      displacement_ = displacements(frame, "an exaggeration of " + shortest(exaggeration) + " needs the field").data();
  }

  Vec3 operator()(std::size_t i) const {
    const Vec3& p = frame_.positions[i];
    if (!displacement_) return p;
    const float* u = displacement_ + 3 * i;
    return {p[0] + more_ * u[0], p[1] + more_ * u[1], p[2] + more_ * u[2]};
  }

 private:
  const Frame& frame_;
  double more_;
  const float* displacement_ = nullptr;
};

void extend_times(Scene& scene, double time) {
  if (scene.frames == 0) scene.first_time = scene.last_time = time;
  const double interval = std::abs(time - scene.last_time);
  if (interval > 0 && (scene.shortest_interval == 0 || interval < scene.shortest_interval))
    scene.shortest_interval = interval;
  scene.first_time = std::min(scene.first_time, time);
  scene.last_time = std::max(scene.last_time, time);
  ++scene.frames;
}

void extend_values(Scene& scene, const ColourField& field) {
  scene.classes.insert(field.classes.begin(), field.classes.end());
  for (float v : field.values) {
    if (!std::isfinite(v)) {
      scene.missing = true;
      continue;
    }
    scene.low = scene.any ? std::min(scene.low, double(v)) : v;
    scene.high = scene.any ? std::max(scene.high, double(v)) : v;
    scene.any = true;
    count_value(scene.histogram, v);
  }
}

void check_request(const RenderOptions& options, const RenderContext& context) {
  for (int size : {options.width, options.height})
    if (size < 16 || size > 16384)
      throw Error("render", "size of a picture", std::to_string(size), "16 to 16384 pixels");
  if (!(context.spacing > 0) || !std::isfinite(context.spacing))
    throw Error("render", "distance of neighbouring particles", shortest(context.spacing), "above 0 m");
}

/// The plot as the camera sees it.
struct Stage {
  Layout layout;
  Camera camera;
  double radius = 0;  ///< of a splat, m
  int guard = 0;      ///< pixels drawn beyond each side of the plot, so that light does not change where it is cut off
};

Stage set_stage(Canvas& canvas, const Scene& scene, const ColourKey& key, const RenderOptions& options,
                const RenderContext& context) {
  const bool flat = context.dimension == 2;
  Stage stage;
  // A square lattice seen face on shows no hole from 0.71 spacings on.
  stage.radius = (flat ? 0.72 : 0.85) * context.spacing;
  stage.layout = arrange(canvas, options, key, context.dimension);
  const Box3& view = flat ? scene.bounds : scene.view;
  double margin = stage.radius;
  if (flat && !view.empty()) margin += 0.03 * std::max(view.max[0] - view.min[0], view.max[1] - view.min[1]);
  const ViewAxes axes = view_axes(options.camera, context.dimension);
  stage.camera = fit_camera(axes, view, margin, stage.layout.plot, options.camera.zoom);
  if (flat && !view.empty()) {
    const Vec3 size = view.max - view.min;
    tighten(stage.layout, (size[0] + 2 * margin) * stage.camera.scale, (size[1] + 2 * margin) * stage.camera.scale);
    stage.camera = fit_camera(axes, view, margin, stage.layout.plot, options.camera.zoom);
  }
  if (options.camera.zoom > 1)
    stage.guard = std::min(64, static_cast<int>(3 * context.spacing * stage.camera.scale) + 40);
  return stage;
}

std::vector<Splat> project_all(const Frame& frame, const Stage& stage, const RenderOptions& options, int dimension,
                               int threads) {
  const DrawnPosition drawn(frame, options.exaggeration);
  std::vector<Splat> splats(frame.positions.size());
  const PixelRect& plot = stage.layout.plot;
  parallel_for(splats.size(), threads, [&](std::size_t i) {
    const Vec3 p = stage.camera.project(drawn(i));
    splats[i] = {static_cast<float>(p[0] - plot.left + stage.guard), static_cast<float>(p[1] - plot.top + stage.guard),
                 dimension == 2 ? 0.0f : static_cast<float>(p[2])};
  });
  return splats;
}

ContourOptions contours_of(const Stage& stage, const RenderOptions& options, const Vec3& origin, double stroke) {
  // Elevation at a pixel: the world's z is up[2] * up + towards[2] * towards in view coordinates.
  const Camera& c = stage.camera;
  ContourOptions contours;
  contours.interval = options.contours;
  contours.per_row = -c.axes.up[2] / c.scale;
  contours.per_depth = c.axes.towards[2] / c.scale;
  const double row = stage.layout.plot.top - stage.guard + 0.5 - c.y;
  contours.elevation =
      origin[2] + c.axes.up[2] * c.centre[1] + c.axes.towards[2] * c.centre[2] + contours.per_row * row;
  contours.stroke = stroke;
  return contours;
}

/// Colour of a pixel: of a smoothed value the mean over the pixel, so that the edges of bands are smooth.
Rgb colour_at(const Layer& layer, const ColourScale& scale, int x, int y) {
  const std::size_t i = layer.index(x, y);
  if (layer.value.empty()) return layer.colour[i];
  const float own = layer.value[i];
  if (std::isnan(own)) return kNoValue;
  const auto slope = [&](int dx, int dy) {
    if (!layer.seen(x + dx, y + dy) || !layer.seen(x - dx, y - dy)) return 0.0f;
    for (const std::size_t there : {layer.index(x + dx, y + dy), layer.index(x - dx, y - dy)})
      if (!layer.body.empty() && layer.body[there] != layer.body[i]) return 0.0f;
    const float d = layer.value[layer.index(x + dx, y + dy)] - layer.value[layer.index(x - dx, y - dy)];
    return std::isnan(d) ? 0.0f : 0.5f * d;
  };
  const float sx = 0.25f * slope(1, 0), sy = 0.25f * slope(0, 1);
  Rgb sum{0, 0, 0};
  for (float v : {own + sx + sy, own + sx - sy, own - sx + sy, own - sx - sy}) {
    const Rgb colour = scale(v);
    for (int c = 0; c < 3; ++c) sum[c] += 0.25f * colour[c];
  }
  return sum;
}

/// The layer on white paper. Light falls on dark colours as a sheen, else their relief would drown.
void compose(const Layer& layer, const std::vector<float>& brightness, const ColourScale& scale, const PixelRect& plot,
             int guard, Picture& picture, int threads) {
  constexpr float sheen = 24;
  parallel_for(static_cast<std::size_t>(plot.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row) + guard;
    for (int x = guard; x < plot.width + guard; ++x) {
      const std::size_t i = layer.index(x, y);
      if (layer.cover[i] == 0) continue;
      const Rgb colour = colour_at(layer, scale, x, y);
      const float light = brightness.empty() ? 1 : brightness[i], gloss = brightness.empty() ? 0 : sheen * light;
      Rgb8& pixel = picture.at(plot.left + x - guard, plot.top + y - guard);
      for (int c = 0; c < 3; ++c) {
        const float lit = std::min(255.0f, colour[c] * light + gloss * (1 - colour[c] / 255));
        pixel[c] = static_cast<std::uint8_t>(std::lround(255 + layer.cover[i] * (lit - 255)));
      }
    }
  });
}

void draw_particles(const Frame& frame, const ColourField& field, const ColourScale& scale, const Stage& stage,
                    const RenderOptions& options, const RenderContext& context, int threads, Picture& picture) {
  const bool flat = context.dimension == 2;
  const double spacing = context.spacing * stage.camera.scale;
  const std::vector<Splat> splats = project_all(frame, stage, options, context.dimension, threads);
  const PixelRect& plot = stage.layout.plot;
  Layer layer = draw_splats(splats, static_cast<float>(stage.radius * stage.camera.scale), plot.width + 2 * stage.guard,
                            plot.height + 2 * stage.guard, field, scale, !flat, threads);
  smooth_outline(layer, spacing, threads);
  std::vector<float> brightness;
  if (!flat) {
    const double stroke = std::max(1.0, stage.layout.font / 18);
    smooth_surface(layer, spacing, threads);
    brightness = shade(layer, stage.camera.axes, stroke, threads);
    if (options.contours > 0)
      draw_contours(layer, contours_of(stage, options, frame.site.origin, stroke), brightness, threads);
  }
  compose(layer, brightness, scale, plot, stage.guard, picture, threads);
}

std::string remarks_of(const RenderOptions& options, int dimension) {
  std::string text;
  if (options.exaggeration != 1) text = "displacements × " + shortest(options.exaggeration);
  if (options.contours > 0 && dimension != 2)
    text += (text.empty() ? "" : "  ·  ") + ("contours every " + shortest(options.contours) + " m");
  return text;
}

void draw_overlays(Canvas& canvas, const Frame& frame, const Scene& scene, const ColourField& field,
                   const ColourKey& key, const Stage& stage, const RenderOptions& options,
                   const RenderContext& context) {
  draw_header(canvas, stage.layout, context.title, time_text(frame.time, scene), options.width);
  FrameRange range;
  for (float v : field.values) {
    if (!std::isfinite(v)) continue;
    range.low = range.any ? std::min(range.low, double(v)) : v;
    range.high = range.any ? std::max(range.high, double(v)) : v;
    range.any = true;
  }
  draw_colour_key(canvas, stage.layout, key, range);
  if (scene.bounds.empty()) return;
  const std::string remarks = remarks_of(options, context.dimension);
  if (context.dimension == 2) return draw_axes_box(canvas, stage.layout, stage.camera, frame.site.origin, remarks);
  draw_footer(canvas, stage.layout, choose_scale_bar(stage.camera.scale, 0.25 * stage.layout.plot.width), remarks,
              options.height);
  draw_triad(canvas, stage.layout, stage.camera.axes, !frame.site.crs.empty());
}

}  // namespace

void extend_scene(Scene& scene, const Frame& frame, const RenderOptions& options) {
  const ColourField field = evaluate_field(frame, options.colour.field, 1);
  const DrawnPosition drawn(frame, options.exaggeration);
  const ViewAxes axes = view_axes(options.camera, 3);
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    const Vec3 p = drawn(i);
    if (!is_finite(p))
      throw Error("render", "position of particle " + std::to_string(i) + " at t = " + shortest(frame.time) + " s",
                  "not finite", "finite positions");
    scene.bounds.extend(p);
    scene.view.extend(axes(p));
  }
  extend_values(scene, field);
  extend_times(scene, frame.time);
}

Picture render(const Frame& frame, const Scene& scene, const RenderOptions& options, const RenderContext& context,
               int threads) {
  check_request(options, context);
  Picture picture{options.width, options.height, {}};
  picture.pixels.assign(static_cast<std::size_t>(options.width) * options.height, Rgb8{255, 255, 255});
  const ColourField field = evaluate_field(frame, options.colour.field, threads);
  const ColourKey key = make_colour_key(scene, field, options.colour, context);
  Canvas canvas(picture);
  const Stage stage = set_stage(canvas, scene, key, options, context);
  draw_particles(frame, field, key.scale, stage, options, context, threads, picture);
  draw_overlays(canvas, frame, scene, field, key, stage, options, context);
  return picture;
}

}  // namespace scarp
