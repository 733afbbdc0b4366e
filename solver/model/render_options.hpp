// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

enum class View { oblique, top, front, side };
template <>
struct enum_names<View> {
  static constexpr std::array<std::pair<std::string_view, View>, 4> value{
      {{"oblique", View::oblique}, {"top", View::top}, {"front", View::front}, {"side", View::side}}};
};

enum class ColourMap { batlow, viridis, cividis, turbo, magma };
template <>
struct enum_names<ColourMap> {
  static constexpr std::array<std::pair<std::string_view, ColourMap>, 5> value{{{"batlow", ColourMap::batlow},
                                                                                {"viridis", ColourMap::viridis},
                                                                                {"cividis", ColourMap::cividis},
                                                                                {"turbo", ColourMap::turbo},
                                                                                {"magma", ColourMap::magma}}};
};

struct ColourOptions {
  std::string field = "displacement";
  ColourMap map = ColourMap::batlow;
  std::optional<Vec2> range;
  std::optional<double> threshold;
  int bands = 0;

  template <class V>
  void describe(V&& v) {
    v("field", field,
      Spec{.text = "a field of the frames: of a vector its length, of \"stress\" the von Mises stress, of "
                   "\"displacement.z\" or \"stress.xy\" one component; \"colour\" for the scan's own, \"material\" or "
                   "\"body\" for classes"});
    v("map", map, Spec{.text = "colour map"});
    v("range", range,
      Spec{.text = "values at the two ends of the colour bar, in the field's SI unit; default: the range of all "
                   "frames, rounded "
                   "outwards; without a few stray particles if these would stretch it threefold"});
    v("threshold", threshold,
      Spec{.text =
               "values below it show the grey ground, in the field's SI unit; default: 2 % of a range that starts at "
               "0, else none"});
    v("bands", bands, Spec{.text = "number of discrete bands; 0 means continuous", .at_least = 0, .at_most = 64});
  }
};

struct CameraOptions {
  View view = View::oblique;
  double azimuth = 215;
  double elevation = 30;
  double zoom = 1;

  template <class V>
  void describe(V&& v) {
    v("view", view,
      Spec{.text = "oblique from azimuth and elevation, from above, from -y, or from +x; plane strain is seen from the "
                   "front"});
    v("azimuth", azimuth,
      Spec{.text = "compass direction from the scene to the camera, clockwise from +y (north)",
           .unit = "deg",
           .at_least = -360,
           .at_most = 360});
    v("elevation", elevation,
      Spec{.text = "angle of the camera above the horizon", .unit = "deg", .at_least = -90, .at_most = 90});
    v("zoom", zoom, Spec{.text = "magnification; 1 fits everything that any frame shows", .above = 0, .at_most = 1000});
  }
};

struct RenderOptions {
  std::string name;
  ColourOptions colour;
  CameraOptions camera;
  int width = 1280;
  int height = 720;
  bool video = true;
  double frames_per_second = 10;
  double exaggeration = 1;
  double contours = 0;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "stem of the picture files", .required = true});
    v("colour", colour, Spec{.text = "what the points are coloured by"});
    v("camera", camera, Spec{.text = "where the picture is taken from (orthographic, so that the scale bar holds)"});
    v("width", width, Spec{.text = "width of a picture in pixels (even)", .at_least = 160, .at_most = 7680});
    v("height", height, Spec{.text = "height of a picture in pixels (even)", .at_least = 120, .at_most = 4320});
    v("video", video, Spec{.text = "also make a video of all frames"});
    v("frames_per_second", frames_per_second,
      Spec{.text = "speed of the video", .unit = "1/s", .above = 0, .at_most = 120});
    v("exaggeration", exaggeration,
      Spec{.text = "factor on displacements in the picture; stated in it when it is not 1", .above = 0});
    v("contours", contours,
      Spec{.text = "vertical distance of the elevation contours drawn on the ground; 0 means none",
           .unit = "m",
           .at_least = 0});
  }
};

}  // namespace scarp
