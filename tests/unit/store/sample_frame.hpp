// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solver/model/frame.hpp"

namespace scarp::test {

/// A frame with a field of every type and width, on a UTM origin.
inline Frame sample_frame(std::size_t count, double time = 0.1) {
  Frame frame;
  frame.time = time;
  frame.step = 7;
  frame.site.origin = {512345, 5412345, 400};
  frame.site.crs = "PROJCS[\"ETRS89 / UTM zone 32N\",UNIT[\"metre\",1]] \xc3\xa9";
  std::vector<float> displacement, stress, strain;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> body;
  std::vector<std::uint8_t> colour;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    frame.positions.push_back({std::sin(x), 0.1 * x + time, 1 / (x + 3)});
    for (int a = 0; a < 3; ++a) displacement.push_back(static_cast<float>(std::cos(x + a)));
    for (int a = 0; a < 6; ++a) stress.push_back(static_cast<float>(1e5 * x - a));
    for (int a = 0; a < 3; ++a) colour.push_back(static_cast<std::uint8_t>(i + static_cast<std::size_t>(a)));
    strain.push_back(static_cast<float>(x / 7));
    id.push_back((std::int64_t{1} << 40) + static_cast<std::int64_t>(i));
    body.push_back(-static_cast<std::int32_t>(i % 3));
  }
  frame.fields = {
      {"velocity", "m/s", 3, displacement}, {"stress", "Pa", 6, stress}, {"id", "1", 1, id}, {"body", "1", 1, body},
      {"colour", "1", 3, colour},           {"damage", "1", 1, strain}};
  return frame;
}

}  // namespace scarp::test
