// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "solver/model/frame.hpp"
#include "solver/model/image.hpp"
#include "solver/model/render_options.hpp"

namespace scarp {

/// What a picture says beside the frame's own data.
struct RenderContext {
  std::string title;
  int dimension = 3;                           ///< 2: plane strain, x right, y up
  double spacing = 0;                          ///< reference distance of neighbouring particles, m
  std::vector<std::string> materials, bodies;  ///< names for the legend, by index
};

/// What all frames have in common: camera, limits and range are taken from it, so that pictures can be compared.
struct Scene {
  Box3 bounds;                     ///< of the positions as drawn (displacements exaggerated), m, local
  Box3 view;                       ///< the same in view coordinates: right, up, towards the camera, m
  double low = 0, high = 0;        ///< smallest and largest finite value of the colour field, SI; 0, 0 if there is none
  bool any = false;                ///< some particle has a finite value
  bool missing = false;            ///< some particle has none
  std::set<std::int32_t> classes;  ///< indices met, when coloured by class
  std::vector<std::uint64_t> histogram;  ///< of the values, by the upper half of their float's bits
  double first_time = 0, last_time = 0;  ///< s
  double shortest_interval = 0;          ///< between frames, s; 0 with one frame
  std::size_t frames = 0;
};

/// Takes one frame into account. To be called for every frame that will be drawn with these options, before the first
/// is drawn.
/// @throws Error ("render") if the frame lacks the colour field (it names those there are), lacks displacements that
/// are to be exaggerated, or has a position that is not finite.
void extend_scene(Scene& scene, const Frame& frame, const RenderOptions& options);

/// The picture of one frame: orthographic, fitted to the scene, of options.width x options.height pixels. In 3D a lit
/// surface with scale bar and axes (E, N, z where the site has a coordinate reference system; y is north); in plane
/// strain flat colours in an axis box in metres of the site. With title, time, and a colour bar or legend. The same
/// bits for any number of threads.
/// @throws Error ("render") as extend_scene; for a spacing that is not above 0, a range that is empty, sizes out of
/// [16, 16384]; if the font DejaVu Sans is not installed.
Picture render(const Frame& frame, const Scene& scene, const RenderOptions& options, const RenderContext& context,
               int threads);

}  // namespace scarp
