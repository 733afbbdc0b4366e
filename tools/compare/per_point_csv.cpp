// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/per_point_csv.hpp"

#include <charconv>
#include <cmath>

namespace scarp {
namespace {

std::string quoted_if_needed(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

void append_number(std::string& text, double value) {
  if (std::isnan(value)) {  // a NaN's sign would be written
    text += "nan";
    return;
  }
  char buffer[64];
  const double size = std::abs(value);
  // 500000, not 5e+05: a coordinate should look like one.
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e16);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr);
}

std::string per_point_csv(const PointCloud& cloud) {
  std::string text = "x,y,z";
  for (const PointScalar& scalar : cloud.scalars) text += "," + quoted_if_needed(scalar.name);
  if (!cloud.normals.empty()) text += ",nx,ny,nz";
  text += '\n';
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 site = cloud.positions[i] + cloud.site.origin;
    for (int a = 0; a < 3; ++a) {
      if (a > 0) text += ',';
      append_number(text, site[a]);
    }
    for (const PointScalar& scalar : cloud.scalars) {
      text += ',';
      append_number(text, scalar.values[i]);
    }
    if (!cloud.normals.empty())
      for (double c : cloud.normals[i]) {
        text += ',';
        append_number(text, c);
      }
    text += '\n';
  }
  return text;
}

}  // namespace scarp
