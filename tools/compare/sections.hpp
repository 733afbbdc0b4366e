// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/compare/plan_path.hpp"

namespace scarp {

/// Two surfaces cut along a path. Heights are local, m; NaN where a surface has no data.
struct Section {
  std::vector<double> s;  ///< along the path, m
  std::vector<Vec2> at;   ///< in plan, local
  std::vector<double> simulated, observed;
  SiteFrame site;
};

/// Bilinear heights of both every `step` metres and at the end. @throws Error for a step that is not above 0, or more
/// than a million steps.
Section cut_section(const Heightfield& simulated, const Heightfield& observed, const PlanPath& path, double step);

/// "s,x,y,simulated,observed,difference": site coordinates, every digit, "nan" for no data; difference = observed -
/// simulated.
std::string section_csv(const Section& section);

}  // namespace scarp
