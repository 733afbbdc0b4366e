// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_record.hpp"

#include <cmath>
#include <string>

#include "ingest/read_buffered.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr double kGravity = 9.80665;  // the standard one, which records in g are given in

[[noreturn]] void refuse(const BufferedFile& file, const std::string& what, const std::string& value,
                         const std::string& allowed) {
  throw Error("ingest", what, value, allowed, file.at_line());
}

double factor_of(AccelerationUnit unit) {
  return unit == AccelerationUnit::gravities ? kGravity : unit == AccelerationUnit::centimetres ? 0.01 : 1.0;
}

/// The unit in a line such as "acceleration (g)" or "ACCELERATION TIME SERIES IN UNITS OF G".
std::optional<AccelerationUnit> unit_in(std::string_view line) {
  std::string words;  // one blank between, and at both ends
  for (const char c : " " + lower_case(line) + " ")
    words += c == '(' || c == ')' || c == '[' || c == ']' || c == ',' || c == ';' || c == '"' || c == '\t' ? ' ' : c;
  const auto has = [&](const char* word) { return words.find(" " + std::string(word) + " ") != std::string::npos; };
  for (const char* word : {"cm/s2", "cm/s^2", "cm/s/s", "cm/s**2", "cm/sec2", "cm/sec^2", "cm/sec/sec", "gal"})
    if (has(word)) return AccelerationUnit::centimetres;
  for (const char* word : {"m/s2", "m/s^2", "m/s/s", "m/s**2", "m/sec2", "m/sec^2", "m/sec/sec"})
    if (has(word)) return AccelerationUnit::metres;
  if (has("g")) return AccelerationUnit::gravities;
  return std::nullopt;
}

/// Number after "key" and "=", as in "DT=   .0050 SEC".
std::optional<double> value_after(const std::string& line, const std::string& key) {
  std::size_t at = line.find(key);
  if (at == std::string::npos) return std::nullopt;
  at = line.find_first_not_of(" =\t", at + key.size());
  if (at == std::string::npos) return std::nullopt;
  return number_of(std::string_view(line).substr(at, line.find_first_of(" ,\t", at) - at));
}

struct At2Header {
  std::size_t count = 0;
  double interval = 0;  ///< s
  std::optional<AccelerationUnit> unit;
};

At2Header read_at2_header(BufferedFile& file) {
  At2Header header;
  std::string_view line;
  for (int row = 0; row < 20 && file.next_line(line); ++row) {
    const std::string text = lower_case(line);
    if (text.find("npts") == std::string::npos) {
      if (text.find("unit") != std::string::npos) header.unit = unit_in(line);
      continue;
    }
    std::optional<double> count = value_after(text, "npts"), interval = value_after(text, "dt");
    if (!count || !interval) {
      const auto cells = split(line, ' ');
      if (cells.size() >= 2) {
        count = number_of(cells[0]);
        interval = number_of(cells[1]);
      }
    }
    if (!count || !interval || !(*count >= 2 && *count < 1e9 && *count == std::floor(*count)) || !(*interval > 0) ||
        !std::isfinite(*interval))
      refuse(file, "number of points and interval of the record", shown(line), "NPTS= 2 or more, DT= above 0 SEC");
    header.count = static_cast<std::size_t>(*count);
    header.interval = *interval;
    return header;
  }
  refuse(file, "not a PEER record: no NPTS and DT in its first lines", "", "a line such as NPTS= 4000, DT= .0100 SEC");
}

[[noreturn]] void refuse_unit(const BufferedFile& file) {
  refuse(file, "the unit of the accelerations is not stated", "",
         "in the file, as in \"acceleration (m/s2)\", or by the key \"unit\"");
}

void check_value(const BufferedFile& file, double value) {
  if (!std::isfinite(value)) refuse(file, "value of the record", shortest(value), "a finite number");
}

AccelerationRecord read_at2(BufferedFile& file, std::optional<AccelerationUnit> unit) {
  const At2Header header = read_at2_header(file);
  if (!unit) unit = header.unit;
  if (!unit) refuse_unit(file);
  AccelerationRecord record;
  std::string_view line;
  std::vector<double> values;
  while (file.next_line(line)) {
    if (is_blank(line)) continue;
    values.clear();
    read_numbers(line, ' ', file, values);
    for (double value : values) {
      check_value(file, value);
      if (record.time.size() == header.count)
        refuse(file, "the record has more values than NPTS says", "", std::to_string(header.count));
      record.time.push_back(header.interval * static_cast<double>(record.time.size()));
      record.acceleration.push_back(factor_of(*unit) * value);
    }
  }
  if (record.time.size() != header.count)
    refuse(file, "the record has fewer values than NPTS says", std::to_string(record.time.size()),
           std::to_string(header.count));
  return record;
}

AccelerationRecord read_table(BufferedFile& file, std::optional<AccelerationUnit> unit) {
  AccelerationRecord record;
  std::string_view line;
  std::vector<double> values;
  bool first = true;
  while (file.next_line(line)) {
    if (is_blank(line)) continue;
    const bool words = is_comment(line) || (first && !number_of(split(line, separator_of(line)).at(0)));
    if (words) {
      if (!unit && record.time.empty()) unit = unit_in(line);
      first = first && is_comment(line);
      continue;
    }
    first = false;
    values.clear();
    read_numbers(line, separator_of(line), file, values);
    if (values.size() != 2)
      refuse(file, "columns of the record", std::to_string(values.size()), "two: time in s and acceleration");
    for (double value : values) check_value(file, value);
    if (!record.time.empty() && !(values[0] > record.time.back()))
      refuse(file, "times of the record must rise", shortest(values[0]) + " s",
             "above " + shortest(record.time.back()) + " s");
    if (!unit) refuse_unit(file);
    record.time.push_back(values[0]);
    record.acceleration.push_back(factor_of(*unit) * values[1]);
  }
  if (record.time.size() < 2) refuse(file, "samples of the record", std::to_string(record.time.size()), "at least two");
  return record;
}

}  // namespace

AccelerationRecord read_record(const std::filesystem::path& path, std::optional<AccelerationUnit> unit) {
  BufferedFile file(path);
  return lower_case(path.extension().string()) == ".at2" ? read_at2(file, unit) : read_table(file, unit);
}

}  // namespace scarp
