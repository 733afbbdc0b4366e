// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace scarp {
namespace {

/// batlow by Fabio Crameri, Scientific colour maps (https://doi.org/10.5281/zenodo.1243862), MIT licence, see
/// THIRD_PARTY.md. Every fifth of the 256 colours, in thousandths; between them a straight line is within 0.4 of
/// an 8-bit step.
constexpr short kBatlow[52][3] = {
    {5, 98, 350},    {23, 129, 355},  {37, 158, 360},  {48, 186, 365},  {55, 211, 369},  {60, 234, 373},
    {65, 255, 376},  {70, 275, 379},  {76, 293, 382},  {83, 311, 384},  {92, 329, 385},  {104, 346, 385},
    {119, 363, 383}, {137, 378, 378}, {159, 393, 371}, {183, 406, 362}, {209, 417, 350}, {237, 428, 336},
    {266, 439, 320}, {296, 448, 304}, {327, 458, 286}, {358, 467, 269}, {390, 477, 252}, {423, 486, 234},
    {456, 496, 218}, {490, 505, 202}, {526, 515, 188}, {563, 524, 177}, {601, 534, 171}, {639, 542, 171},
    {678, 551, 178}, {717, 558, 192}, {754, 565, 212}, {791, 571, 236}, {825, 578, 264}, {859, 584, 296},
    {890, 592, 330}, {918, 601, 369}, {942, 612, 411}, {962, 624, 456}, {976, 638, 502}, {985, 653, 548},
    {990, 667, 593}, {993, 682, 637}, {993, 696, 679}, {993, 711, 721}, {992, 725, 762}, {990, 739, 804},
    {989, 754, 847}, {987, 769, 891}, {984, 785, 936}, {981, 800, 981}};

std::array<Rgb8, 256> batlow_table() {
  std::array<Rgb8, 256> table;
  for (int i = 0; i < 256; ++i) {
    const int node = std::min(i / 5, 50);
    const double t = (i - 5 * node) / 5.0;
    for (int c = 0; c < 3; ++c)
      table[i][c] =
          static_cast<std::uint8_t>(std::lround(0.255 * ((1 - t) * kBatlow[node][c] + t * kBatlow[node + 1][c])));
  }
  return table;
}

std::array<Rgb8, 256> opencv_table(int map) {
  cv::Mat ramp(1, 256, CV_8UC1), colours;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, colours, map);
  std::array<Rgb8, 256> table;
  for (int i = 0; i < 256; ++i) {
    const cv::Vec3b bgr = colours.at<cv::Vec3b>(0, i);
    table[i] = {bgr[2], bgr[1], bgr[0]};
  }
  return table;
}

}  // namespace

std::array<Rgb8, 256> colour_table(ColourMap map) {
  switch (map) {
    case ColourMap::viridis:
      return opencv_table(cv::COLORMAP_VIRIDIS);
    case ColourMap::cividis:
      return opencv_table(cv::COLORMAP_CIVIDIS);
    case ColourMap::turbo:
      return opencv_table(cv::COLORMAP_TURBO);
    case ColourMap::magma:
      return opencv_table(cv::COLORMAP_MAGMA);
    case ColourMap::batlow:
      break;
  }
  return batlow_table();
}

Rgb class_colour(int index) {
  // Muted, distinct in hue and in lightness, so that neighbours also differ in a grey print.
  static constexpr Rgb palette[] = {{214, 170, 108}, {72, 120, 168}, {122, 158, 96},  {176, 82, 66},
                                    {150, 138, 178}, {86, 92, 100},  {232, 208, 120}, {66, 148, 148},
                                    {196, 128, 156}, {128, 96, 68},  {168, 190, 204}, {96, 104, 52}};
  constexpr int count = static_cast<int>(std::size(palette));
  return palette[((index % count) + count) % count];
}

Rgb ColourScale::operator()(double value) const {
  if (!std::isfinite(value)) return kNoValue;
  if (threshold && value < *threshold) return kGround;
  double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  if (bands == 1) t = 0.5;
  // A hair's width up, so that a value on an edge belongs to the band above it whatever the rounding.
  if (bands > 1) t = std::min(std::floor(t * bands + 1e-9), bands - 1.0) / (bands - 1);
  const Rgb8& colour = table[static_cast<std::size_t>(std::lround(t * 255))];
  const float mixed = t < fade ? static_cast<float>(t / fade) : 1;
  Rgb result;
  for (int c = 0; c < 3; ++c) result[c] = kGround[c] + mixed * (static_cast<float>(colour[c]) - kGround[c]);
  return result;
}

}  // namespace scarp
