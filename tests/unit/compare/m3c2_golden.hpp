// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two synthetic clouds and what py4dgeo's core makes of them at four points, computed with it in double precision.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp::test {

inline double golden_surface(double x, double y) {
  return 0.30 * x + 0.15 * std::sin(0.9 * x) * std::cos(0.7 * y) + 0.02 * std::sin(57 * x + 31 * y);
}

/// 100 x 100 points, jittered; a hump is added to the second cloud.
inline std::vector<Vec3> golden_cloud(double spacing, double hump) {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const double x = spacing * i + 0.013 * std::sin(12.9898 * i + 78.233 * j);
      const double y = spacing * j + 0.013 * std::cos(39.3468 * i + 11.135 * j);
      const double rise = hump * std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / 4);
      points.push_back({x, y, golden_surface(x, y) + rise});
    }
  return points;
}

inline std::vector<Vec3> golden_cores() {
  std::vector<Vec3> cores;
  for (const auto& [x, y] : {std::pair(5.0, 5.0), {2.5, 7.25}, {8.05, 1.3}, {0.02, 0.03}})
    cores.push_back({x, y, golden_surface(x, y)});
  return cores;
}

struct GoldenRow {
  Vec3 normal;
  double distance, lod, spread1, n1, spread2, n2;      ///< mean
  double median_distance, median_lod, range1, range2;  ///< median
  double vertical_distance, vertical_lod, vertical_n1, vertical_n2;
};

inline constexpr std::array<GoldenRow, 4> kGolden{{{{-0.303431821299, 0.028479697214, 0.952427444307},
                                                    0.228240788619,
                                                    0.005561023647,
                                                    0.014470217634,
                                                    63,
                                                    0.015062144469,
                                                    48,
                                                    0.224369783102,
                                                    0.010176516871,
                                                    0.029676059612,
                                                    0.024959847807,
                                                    0.240673993460,
                                                    0.027565692742,
                                                    65,
                                                    52},
                                                   {{-0.264871025014, -0.061169509071, 0.962341743492},
                                                    0.013109668345,
                                                    0.005486566468,
                                                    0.014106540659,
                                                    61,
                                                    0.015421815691,
                                                    52,
                                                    0.009096280593,
                                                    0.010084679446,
                                                    0.024749378051,
                                                    0.029231250562,
                                                    0.010970283220,
                                                    0.025243531737,
                                                    61,
                                                    53},
                                                   {{-0.320592469411, 0.053574508295, 0.945700925567},
                                                    -0.006741871457,
                                                    0.005310933609,
                                                    0.014049261161,
                                                    60,
                                                    0.014234749187,
                                                    50,
                                                    -0.016449868549,
                                                    0.010047341842,
                                                    0.026045937971,
                                                    0.027359969442,
                                                    -0.001601755685,
                                                    0.029644993497,
                                                    63,
                                                    54},
                                                   {{-0.379528817276, 0.001731367311, 0.925178295911},
                                                    0.005162166817,
                                                    0.007744527300,
                                                    0.012959422223,
                                                    22,
                                                    0.012312443480,
                                                    19,
                                                    0.013580749391,
                                                    0.013198754095,
                                                    0.020894846431,
                                                    0.022012366546,
                                                    0.009263906993,
                                                    0.038768486164,
                                                    22,
                                                    21}}};

}  // namespace scarp::test
