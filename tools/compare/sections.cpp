// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/sections.hpp"

#include <cmath>

#include "solver/model/error.hpp"
#include "tools/compare/per_point_csv.hpp"

namespace scarp {

Section cut_section(const Heightfield& simulated, const Heightfield& observed, const PlanPath& path, double step) {
  if (!(step > 0) || path.length() / step > 1e6)
    throw Error("compare", "step along a section", shortest(step), "above 0 m, at most a million of them");
  Section section;
  section.site = observed.site;
  for (double s = 0;; s += step) {
    const bool last = s >= path.length() * (1 - 1e-12);
    section.s.push_back(last ? path.length() : s);
    const Vec2 p = section.at.emplace_back(path.at(section.s.back()));
    section.simulated.push_back(height_at(simulated, p[0], p[1]));
    section.observed.push_back(height_at(observed, p[0], p[1]));
    if (last) return section;
  }
}

std::string section_csv(const Section& section) {
  std::string text = "s,x,y,simulated,observed,difference\n";
  const Vec3& origin = section.site.origin;
  for (std::size_t i = 0; i < section.s.size(); ++i) {
    const double row[] = {section.s[i],
                          section.at[i][0] + origin[0],
                          section.at[i][1] + origin[1],
                          section.simulated[i] + origin[2],
                          section.observed[i] + origin[2],
                          section.observed[i] - section.simulated[i]};
    for (int k = 0; k < 6; ++k) {
      if (k > 0) text += ',';
      append_number(text, row[k]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace scarp
