// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/point_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

enum Role { x, y, z, nx, ny, nz, red, green, blue, intensity, classification, returned, returns, gps_time, kRoles };

struct RoleName {
  Role role;
  std::string_view name;
};

/// The format's own names, then those that count only in their absence.
constexpr RoleName kNames[] = {{x, "x"},
                               {y, "y"},
                               {z, "z"},
                               {nx, "nx"},
                               {ny, "ny"},
                               {nz, "nz"},
                               {nx, "normalx"},
                               {ny, "normaly"},
                               {nz, "normalz"},
                               {red, "red"},
                               {green, "green"},
                               {blue, "blue"},
                               {intensity, "intensity"},
                               {classification, "classification"},
                               {returned, "returnnumber"},
                               {returns, "numberofreturns"},
                               {gps_time, "gpstime"}};
constexpr RoleName kOtherNames[] = {{x, "easting"},
                                    {x, "east"},
                                    {x, "e"},
                                    {y, "northing"},
                                    {y, "north"},
                                    {y, "n"},
                                    {z, "elevation"},
                                    {z, "elev"},
                                    {z, "height"},
                                    {z, "altitude"},
                                    {z, "alt"},
                                    {red, "r"},
                                    {green, "g"},
                                    {blue, "b"},
                                    {red, "diffusered"},
                                    {green, "diffusegreen"},
                                    {blue, "diffuseblue"},
                                    {classification, "class"},
                                    {classification, "label"}};

std::string_view without_prefix(std::string_view name) {
  return lower_case(name.substr(0, 7)) == "scalar_" ? name.substr(7) : name;
}

std::string canonical(std::string_view name) {
  std::string text = lower_case(without_prefix(name));
  if (const std::size_t bracket = text.find_first_of("[("); bracket != 0 && bracket != std::string::npos)
    text.resize(bracket);
  std::erase_if(text, [](char c) { return c == '_' || c == '-' || c == ' '; });
  return text;
}

/// The column of each role, or -1. The first column of a name wins, except that no second x, y or z is borne.
std::array<int, kRoles> find_roles(const std::vector<TableColumn>& columns, const SourceLocation& header) {
  std::array<int, kRoles> found;
  found.fill(-1);
  const auto assign = [&](const auto& names, bool only_missing) {
    const std::array<int, kRoles> before = found;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string name = canonical(columns[c].name);
      const auto* entry = std::find_if(std::begin(names), std::end(names), [&](auto& n) { return n.name == name; });
      if (entry == std::end(names) || (only_missing && before[entry->role] >= 0)) continue;
      int& column = found[entry->role];
      if (column >= 0 && entry->role <= z)
        throw Error("ingest", "two columns hold the same coordinate",
                    shown(columns[column].name) + " and " + shown(columns[c].name), "one column for each", header);
      if (column < 0) column = static_cast<int>(c);
    }
  };
  assign(kNames, false);
  assign(kOtherNames, true);
  return found;
}

std::string list_names(const std::vector<TableColumn>& columns) {
  std::string text;
  for (std::size_t c = 0; c < columns.size() && c < 12; ++c) text += (c ? " " : "") + shown(columns[c].name);
  return columns.size() > 12 ? text + " …" : text;
}

/// All of `values` as T, or nothing if one has a fraction, is NaN or does not fit.
template <class T>
std::optional<std::vector<T>> as_integers(const std::vector<double>& values) {
  std::vector<T> integers;
  integers.reserve(values.size());
  for (double value : values) {
    if (!(value >= 0 && value <= std::numeric_limits<T>::max() && value == std::floor(value))) return {};
    integers.push_back(static_cast<T>(value));
  }
  return integers;
}

/// What to multiply the channels by for 0..65535; 0 if they fit no scale.
double colour_factor(const std::array<const std::vector<double>*, 3>& channels, ColourScale scale) {
  double most = 0;
  bool integers = true;
  for (const auto* channel : channels)
    for (double value : *channel) {
      if (!(value >= 0 && value <= 65535)) return 0;
      most = std::max(most, value);
      integers = integers && value == std::floor(value);
    }
  if (scale == ColourScale::byte) return 257;
  if (scale == ColourScale::word) return 1;
  if (most <= 1 && (scale == ColourScale::real || !integers)) return 65535;
  if (!integers) return 0;
  return most <= 255 ? 257 : 1;
}

/// Moves a column into an attribute if all its values fit there.
template <class T>
bool take_integers(std::vector<double>& values, std::vector<T>& attribute) {
  auto integers = as_integers<T>(values);
  if (!integers) return false;
  attribute = std::move(*integers);
  values = {};
  return true;
}

/// "distance [m]" -> {"distance", "m"}.
PointScalar named_scalar(std::string_view name, std::vector<double>&& values) {
  name = without_prefix(name);
  const std::size_t bracket = name.rfind('[');
  if (!name.ends_with(']') || bracket == 0 || bracket == std::string_view::npos)
    return {std::string(name), {}, std::move(values)};
  return {std::string(trimmed(name.substr(0, bracket))),
          std::string(trimmed(name.substr(bracket + 1, name.size() - bracket - 2))), std::move(values)};
}

bool whole(const std::array<int, 3>& columns) {
  return std::all_of(columns.begin(), columns.end(), [](int c) { return c >= 0; });
}

}  // namespace

PointTable::PointTable(std::vector<TableColumn> columns, const SourceLocation& header)
    : columns_(std::move(columns)), values_(columns_.size()) {
  std::vector<std::string_view> names;
  for (const TableColumn& column : columns_) names.push_back(column.name);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
    throw Error("ingest", "two columns have the same name", shown(*twice), "different names", header);
  const auto roles = find_roles(columns_, header);
  for (int axis = 0; axis < 3; ++axis) {
    if (roles[x + axis] < 0)
      throw Error("ingest", std::string("no column holds ") + "xyz"[axis], list_names(columns_),
                  "columns named x, y, z (or easting, northing, elevation)", header);
    coordinate_[axis] = static_cast<std::size_t>(roles[x + axis]);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (std::find(coordinate_.begin(), coordinate_.end(), c) == coordinate_.end()) other_.push_back(c);
}

void PointTable::reserve(std::size_t rows) {
  positions_.reserve(rows);
  for (std::size_t c : other_) values_[c].reserve(rows);
}

void PointTable::add_row(const double* row) {
  Vec3 position;
  for (int axis = 0; axis < 3; ++axis) {
    const double value = row[coordinate_[axis]];
    position[axis] = std::isfinite(value) ? value : NAN;
  }
  positions_.push_back(position);
  for (std::size_t c : other_) values_[c].push_back(row[c]);
}

bool PointTable::take_colour(const std::array<int, 3>& columns, PointCloud& cloud) {
  const double factor =
      colour_factor({&values_[columns[0]], &values_[columns[1]], &values_[columns[2]]}, columns_[columns[0]].colour);
  if (factor == 0) return false;
  cloud.colour.resize(positions_.size());
  for (int k = 0; k < 3; ++k) {
    std::vector<double>& values = values_[columns[k]];
    for (std::size_t i = 0; i < values.size(); ++i)
      cloud.colour[i][k] = static_cast<std::uint16_t>(std::min(std::lround(values[i] * factor), 65535L));
    values = {};
  }
  return true;
}

void PointTable::take_normals(const std::array<int, 3>& columns, PointCloud& cloud) {
  cloud.normals.resize(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Vec3 n{values_[columns[0]][i], values_[columns[1]][i], values_[columns[2]][i]};
    const double length = norm(n);
    cloud.normals[i] = std::isfinite(length) && length > 0 ? (1 / length) * n : Vec3{0, 0, 0};
  }
  for (int c : columns) values_[c] = {};
}

PointCloud PointTable::into_cloud() && {
  const auto roles = find_roles(columns_, {});
  PointCloud cloud;
  std::vector<char> taken(columns_.size(), 0);
  for (std::size_t c : coordinate_) taken[c] = 1;
  const std::array<int, 3> normal{roles[nx], roles[ny], roles[nz]}, colour{roles[red], roles[green], roles[blue]};
  if (whole(normal)) {
    take_normals(normal, cloud);
    for (int c : normal) taken[c] = 1;
  }
  if (whole(colour) && take_colour(colour, cloud))
    for (int c : colour) taken[c] = 1;
  const auto take = [&](Role role, auto& attribute) {
    const int c = roles[role];
    if (c >= 0) taken[c] = take_integers(values_[c], attribute);
  };
  take(intensity, cloud.intensity);
  take(classification, cloud.classification);
  take(returned, cloud.return_number);
  take(returns, cloud.number_of_returns);
  if (const int c = roles[gps_time]; c >= 0) {
    cloud.gps_time = std::move(values_[c]);
    taken[c] = 1;
  }
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!taken[c]) cloud.scalars.push_back(named_scalar(columns_[c].name, std::move(values_[c])));
  cloud.positions = std::move(positions_);
  return cloud;
}

}  // namespace scarp
