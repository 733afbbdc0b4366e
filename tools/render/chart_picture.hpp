// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts of a comparison: how often which difference occurs, and two surfaces along a line.
#pragma once

#include <string>
#include <vector>

#include "solver/model/image.hpp"

namespace scarp {

struct HistogramChart {
  std::vector<double> values;     ///< m; NaN is left out
  double level_of_detection = 0;  ///< m; 0: none is drawn
  std::string title, label, remarks;
};
/// Shares of the values in bins of equal width, with 0, mean and median marked; the two per cent farthest from 0 are
/// beyond the ends and counted there. Both sides of 0 are as long; there is one only where no value is below. @throws
/// Error ("render") without values
Picture draw_histogram(const HistogramChart& chart);

struct SectionChart {
  std::vector<double> s;                    ///< m
  std::vector<double> simulated, observed;  ///< heights of the site, m; NaN where there is none
  std::string title;
  std::string simulated_name = "simulated", observed_name = "observed";
};
/// Heights along a line; how much they are exaggerated stands in the picture. @throws Error ("render") without heights
Picture draw_section(const SectionChart& chart);

}  // namespace scarp
