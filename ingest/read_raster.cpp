// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "ingest/read_buffered.hpp"
#include "ingest/read_geotiff.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr std::string_view kWords[] = {"ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
                                       "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};

bool is_word(std::string_view word) {
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

struct Entry {
  double value;
  SourceLocation where;
};
using Entries = std::map<std::string, Entry, std::less<>>;

/// Reads the header; leaves the first line of values in `line`.
Entries read_entries(BufferedFile& file, std::string_view& line) {
  Entries entries;
  while (file.next_line(line)) {
    const auto words = split(line, ' ');
    if (words.empty()) continue;
    if (number_of(words[0])) return entries;
    std::string key = lower_case(words[0]);
    if (key == "xllcentre" || key == "yllcentre") key = key.substr(0, 3) + "center";
    if (!is_word(key))
      throw Error("ingest", "unknown word in the header of an ESRI ASCII grid", shown(words[0]),
                  "ncols nrows xllcorner xllcenter yllcorner yllcenter cellsize nodata_value", file.at_line(1));
    const auto value = words.size() == 2 ? number_of(words[1]) : std::nullopt;
    if (!value)
      throw Error("ingest", "header word " + key, words.size() > 1 ? shown(words[1]) : "nothing", "one number",
                  file.at_line());
    if (!entries.emplace(key, Entry{*value, file.at_line()}).second)
      throw Error("ingest", "header word " + key + " is there twice", {}, {}, file.at_line());
  }
  throw Error("ingest", "ESRI ASCII grid without values", {}, {}, file.at_line());
}

/// The one of the words that is there; both or neither is an Error.
std::pair<std::string_view, Entry> one_of(const Entries& entries, std::string_view a, std::string_view b,
                                          const BufferedFile& file) {
  const auto first = entries.find(a), second = entries.find(b);
  const bool has_first = first != entries.end(), has_second = second != entries.end();
  if (has_first == has_second)
    throw Error("ingest", "header of an ESRI ASCII grid", has_first ? "both words" : "neither word",
                std::string(a) + " or " + std::string(b), file.at_line());
  return has_first ? std::pair{a, first->second} : std::pair{b, second->second};
}

Entry required(const Entries& entries, std::string_view word, const BufferedFile& file) {
  const auto found = entries.find(word);
  if (found == entries.end())
    throw Error("ingest", "header of an ESRI ASCII grid without " + std::string(word), {}, {}, file.at_line());
  return found->second;
}

int cell_count(const Entries& entries, std::string_view word, const BufferedFile& file) {
  const auto [value, where] = required(entries, word, file);
  if (!(value >= 1 && value <= std::numeric_limits<int>::max() && value == std::floor(value)))
    throw Error("ingest", "header word " + std::string(word), shortest(value), "a whole number of at least 1", where);
  return static_cast<int>(value);
}

double cell_size(const Entries& entries, const BufferedFile& file) {
  Entry cell;
  if (entries.count("dx") || entries.count("dy")) {
    cell = required(entries, "dx", file);
    const Entry dy = required(entries, "dy", file);
    if (entries.count("cellsize") || dy.value != cell.value)
      throw Error("ingest", "cells of a raster that are not squares", shortest(cell.value) + " x " + shortest(dy.value),
                  "dx equal to dy, or cellsize alone; resample the raster to square cells", dy.where);
  } else {
    cell = required(entries, "cellsize", file);
  }
  if (!(cell.value > 0 && std::isfinite(cell.value)))
    throw Error("ingest", "cell size of a raster", shortest(cell.value), "above 0", cell.where);
  return cell.value;
}

/// Coordinate of the centre of the first column or row.
double first_centre(const Entries& entries, char axis, double cell, const BufferedFile& file) {
  const std::string corner = std::string(1, axis) + "llcorner", centre = std::string(1, axis) + "llcenter";
  const auto [word, entry] = one_of(entries, corner, centre, file);
  if (!std::isfinite(entry.value))
    throw Error("ingest", "header word " + std::string(word), shortest(entry.value), "a finite number", entry.where);
  return word == corner ? entry.value + 0.5 * cell : entry.value;
}

void read_values(BufferedFile& file, std::string_view line, double nodata, Heightfield& field) {
  std::vector<double> values;
  std::size_t count = 0;
  const std::size_t wanted = field.z.size();
  const auto columns = static_cast<std::size_t>(field.columns);
  do {
    read_numbers(line, ' ', file, values);
    if (values.size() > wanted - count)
      throw Error("ingest", "raster holds more values than its header promises", "more", std::to_string(wanted),
                  file.at_line());
    for (double value : values) {
      if (std::isinf(value)) throw Error("ingest", "height in a raster", shortest(value), "finite", file.at_line());
      const bool absent = value == nodata || static_cast<float>(value) == static_cast<float>(nodata);
      field.z[(field.rows - 1 - count / columns) * columns + count % columns] = absent ? NAN : value;
      ++count;
    }
  } while (file.next_line(line));
  if (count != wanted)
    throw Error("ingest", "raster holds fewer values than its header promises", std::to_string(count),
                std::to_string(wanted), file.at_line());
}

/// The text of the .prj file beside `path`, without blanks and line ends after it; empty if there is none.
std::string read_prj(std::filesystem::path path) {
  path.replace_extension(".prj");
  if (!std::filesystem::is_regular_file(path)) return {};
  constexpr std::uint64_t kLongest = 1 << 20;
  BufferedFile file(path);
  if (file.size() > kLongest)
    throw Error("ingest", "too long for a projection", std::to_string(file.size()) + " bytes", "up to 1 MiB",
                {path.string()});
  const std::uint64_t size = file.size();
  std::string text(file.take(size), size);
  text.resize(text.find_last_not_of(std::string_view(" \t\r\n\0", 5)) + 1);
  return text;
}

}  // namespace

Heightfield read_raster(const std::filesystem::path& path) {
  return is_tiff(BufferedFile(path).peek()) ? read_geotiff(path) : read_ascii_grid(path);
}

Heightfield read_ascii_grid(const std::filesystem::path& path) {
  BufferedFile file(path);
  std::string_view line;
  const Entries entries = read_entries(file, line);
  Heightfield field;
  field.columns = cell_count(entries, "ncols", file);
  field.rows = cell_count(entries, "nrows", file);
  field.cell = cell_size(entries, file);
  field.x0 = first_centre(entries, 'x', field.cell, file);
  field.y0 = first_centre(entries, 'y', field.cell, file);
  const double nodata = entries.count("nodata_value") ? entries.find("nodata_value")->second.value : -9999;
  const std::uint64_t cells = static_cast<std::uint64_t>(field.columns) * static_cast<std::uint64_t>(field.rows);
  // A value takes a digit and a separator.
  const std::uint64_t most = (file.bytes_left() + line.size() + 2) / 2;
  if (cells > most)
    throw Error("ingest", "raster header promises more cells than the file can hold", std::to_string(cells),
                "at most " + std::to_string(most), required(entries, "nrows", file).where);
  field.z.resize(cells);
  read_values(file, line, nodata, field);
  field.site.crs = read_prj(path);
  return field;
}

bool is_raster(std::string_view beginning) {
  if (is_tiff(beginning)) return true;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  beginning.remove_prefix(first);
  return is_word(lower_case(beginning.substr(0, beginning.find_first_of(" \t\r\n"))));
}

PointCloud raster_to_cloud(const Heightfield& field) {
  PointCloud cloud;
  cloud.site = field.site;
  cloud.positions.reserve(
      static_cast<std::size_t>(std::count_if(field.z.begin(), field.z.end(), [](double z) { return !std::isnan(z); })));
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      const double z = field.at(column, row);
      if (!std::isnan(z)) cloud.positions.push_back({field.x0 + column * field.cell, field.y0 + row * field.cell, z});
    }
  return cloud;
}

}  // namespace scarp
