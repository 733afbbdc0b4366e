// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/material_points.hpp"

#include <algorithm>
#include <map>

#include "tools/compare/frame_values.hpp"

namespace scarp {
namespace {

/// Volumes per metre of thickness.
bool in_plane_strain(const Frame& frame) { return find_field(frame, "volume")->unit == "m3/m"; }

const std::vector<float>& volumes_of(const Frame& frame) {
  const auto* volume = values_of<float>(frame, "volume", "float32, m3");
  if (!volume || volume->size() != frame.positions.size())
    throw Error("compare", "the frame does not say how large its particles are", volume ? "a vector field" : "no field",
                "a float field \"volume\" with one value per particle");
  for (std::size_t i = 0; i < volume->size(); ++i)
    if (!((*volume)[i] > 0) || !std::isfinite((*volume)[i]))
      throw Error("compare", "volume of particle " + std::to_string(i), shortest((*volume)[i]), "above 0 m3");
  return *volume;
}

Mat3 gradient_at(const std::vector<float>& values, std::size_t i) {
  Mat3 F;
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(9 * i), 9, F.begin());
  return F;
}

/// A copy at `z` of particle `p`, whose volume is `volume` there.
void add(MaterialPoints& points, const Frame& frame, std::size_t p, double z, double volume,
         const std::vector<std::uint8_t>& surface, const std::vector<float>* gradient) {
  const Vec3& x = frame.positions[p];
  points.positions.push_back({x[0], x[1], x[2] + z});
  points.volume.push_back(volume);
  points.marked.push_back(surface[p] == 1);
  points.particle.push_back(p);
  points.own.push_back(z == 0);
  if (gradient) points.gradient.push_back(gradient_at(*gradient, p));
}

}  // namespace

MaterialPoints material_points(const Frame& frame) {
  MaterialPoints points;
  const std::vector<float>& volume = volumes_of(frame);
  const auto* surface = values_of<std::uint8_t>(frame, "surface", "uint8, 1 on the free surface");
  if (!surface || surface->size() != frame.positions.size())
    throw Error("compare", "the frame does not say which particles form the free surface",
                surface ? "a vector field" : "no field", "a uint8 field \"surface\" with one value per particle");
  const auto* gradient = values_of<float>(frame, "deformation_gradient", "float32");
  if (gradient && gradient->size() != 9 * frame.positions.size()) gradient = nullptr;
  points.plane_strain = in_plane_strain(frame);
  if (points.plane_strain) points.up = {0, 1, 0};
  const double widest = std::sqrt(*std::max_element(volume.begin(), volume.end()));
  for (std::size_t p = 0; p < frame.positions.size(); ++p) {
    if (!points.plane_strain) {
      add(points, frame, p, 0, volume[p], *surface, gradient);
      continue;
    }
    const double step = std::sqrt(double(volume[p]));
    const int copies = static_cast<int>(std::ceil((2 * kSurfaceReach + 1) * widest / step));
    for (int k = -copies; k <= copies; ++k) add(points, frame, p, k * step, volume[p] * step, *surface, gradient);
  }
  return points;
}

double spacing_of(const Frame& frame) {
  if (!find_field(frame, "volume")) return 0;
  const std::vector<float>& volume = volumes_of(frame);
  const auto* body = values_of<std::int32_t>(frame, "body", "int32");
  const bool by_body = body && body->size() == frame.positions.size();
  std::map<std::int32_t, std::vector<float>> of_body;
  for (std::size_t p = 0; p < volume.size(); ++p) of_body[by_body ? (*body)[p] : 0].push_back(volume[p]);
  const double dimension = in_plane_strain(frame) ? 2 : 3;
  double widest = 0;
  for (auto& [index, volumes] : of_body) {
    const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
    std::nth_element(volumes.begin(), middle, volumes.end());
    widest = std::max(widest, std::pow(double(*middle), 1 / dimension));
  }
  return widest;
}

}  // namespace scarp
