// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_pcd.hpp"

#include <bit>
#include <cmath>
#include <span>

#include "ingest/lzf.hpp"
#include "ingest/point_table.hpp"
#include "ingest/read_pcd_header.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr std::string_view kChannels[] = {"red", "green", "blue"};

std::vector<TableColumn> columns_of(const PcdHeader& header) {
  std::vector<TableColumn> columns;
  for (const PcdField& field : header.fields) {
    if (!field.kept()) continue;
    const ColourScale scale = field.type == NumberType::u8                                     ? ColourScale::byte
                              : field.type == NumberType::u16                                  ? ColourScale::word
                              : field.type == NumberType::f32 || field.type == NumberType::f64 ? ColourScale::real
                                                                                               : ColourScale::guess;
    if (field.packed_colour)
      for (std::string_view channel : kChannels) columns.push_back({std::string(channel), ColourScale::byte});
    else
      columns.push_back({field.name, scale});
  }
  return columns;
}

void push_colour(std::uint32_t packed, std::vector<double>& row) {
  for (int shift : {16, 8, 0}) row.push_back(packed >> shift & 255u);
}

/// A packed colour written as text: an integer, or the real number whose four bytes are the colour.
std::uint32_t packed_of(double value, NumberType type, const BufferedFile& file) {
  if (type == NumberType::f32 && std::isfinite(static_cast<float>(value)))
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  if (type != NumberType::f32 && value >= 0) return static_cast<std::uint32_t>(value);
  if (type != NumberType::f32 && value < 0) return static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
  throw Error("ingest", "packed colour cannot be read from text", shortest(value),
              "a finite number, or rgb with TYPE U, or DATA binary", file.at_line());
}

void read_ascii(BufferedFile& file, const PcdHeader& header, PointTable& table) {
  std::vector<double> cells, row;
  std::string_view line;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    do {
      if (!file.next_line(line))
        throw Error("ingest", "PCD file holds fewer points than its header promises", std::to_string(i),
                    std::to_string(header.points), file.at_line());
    } while (is_blank(line));
    read_numbers(line, ' ', file, cells);
    if (cells.size() != header.cells())
      throw Error("ingest", "number of values on a line of PCD data", std::to_string(cells.size()),
                  std::to_string(header.cells()), file.at_line());
    row.clear();
    const double* cell = cells.data();
    for (const PcdField& field : header.fields) {
      const NumberRange range = range_of(field.type);
      if (!fits(*cell, range))
        throw Error("ingest", "PCD field '" + field.name + "'", shortest(*cell),
                    "integers " + shortest(range.least) + " to " + shortest(range.most), file.at_line());
      if (field.packed_colour)
        push_colour(packed_of(*cell, field.type, file), row);
      else if (field.kept())
        row.push_back(*cell);
      cell += field.count;
    }
    table.add_row(row.data());
  }
}

/// Fields of point i: where each starts, and how far the next point's is, in a block of bytes.
struct FieldPlace {
  const PcdField* field;
  std::uint64_t start, step;
};

void add_binary_row(const char* block, std::uint64_t i, const std::vector<FieldPlace>& places, std::vector<double>& row,
                    PointTable& table) {
  row.clear();
  for (const FieldPlace& place : places) {
    const char* bytes = block + place.start + i * place.step;
    // As bits, never as a float: many colours are signalling NaNs, which a conversion would change.
    if (place.field->packed_colour)
      push_colour(static_cast<std::uint32_t>(load_number(bytes, NumberType::u32, false)), row);
    else
      row.push_back(load_number(bytes, place.field->type, false));
  }
  table.add_row(row.data());
}

/// @param together whether all of a field stands together (compressed), or all of a point
std::vector<FieldPlace> places_of(const PcdHeader& header, bool together) {
  std::vector<FieldPlace> places;
  std::uint64_t start = 0;
  for (const PcdField& field : header.fields) {
    if (field.kept()) places.push_back({&field, start, together ? field.bytes() : header.stride()});
    start += together ? field.bytes() * header.points : field.bytes();
  }
  return places;
}

void read_binary(BufferedFile& file, const PcdHeader& header, PointTable& table) {
  const std::vector<FieldPlace> places = places_of(header, false);
  std::vector<double> row;
  for (std::uint64_t i = 0; i < header.points; ++i) add_binary_row(file.take(header.stride()), 0, places, row, table);
}

void read_compressed(BufferedFile& file, const PcdHeader& header, PointTable& table) {
  const char* sizes = file.take(8);
  const auto packed = static_cast<std::uint64_t>(load_number(sizes, NumberType::u32, false));
  const auto expanded = static_cast<std::uint64_t>(load_number(sizes + 4, NumberType::u32, false));
  if (expanded != header.points * header.stride())
    throw Error("ingest", "expanded size of the PCD block", std::to_string(expanded),
                std::to_string(header.points * header.stride()) + ", the size of its points", file.at_byte());
  const SourceLocation where = file.at_byte();
  const char* bytes = file.take(packed);
  const auto block = expand_lzf({bytes, packed}, expanded);
  if (!block) throw Error("ingest", "compressed PCD block is corrupt", {}, {}, where);
  const std::vector<FieldPlace> places = places_of(header, true);
  std::vector<double> row;
  table.reserve(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) add_binary_row(block->data(), i, places, row, table);
}

/// @throws Error if the data cannot be there, before memory is asked for
void check_size(const BufferedFile& file, const PcdHeader& header) {
  std::uint64_t least = header.stride();
  std::uint64_t bytes = file.bytes_left();
  if (header.data == PcdHeader::Data::ascii) {
    least = 2 * header.cells();  // a digit and a separator each
    bytes += 1;
  } else if (header.data == PcdHeader::Data::compressed) {
    bytes *= kLzfLargestRatio;
  }
  if (header.points > bytes / least)
    throw Error("ingest", "PCD header promises more points than the file can hold", std::to_string(header.points),
                "at most " + std::to_string(bytes / least), file.at_line());
}

}  // namespace

PointCloud read_pcd(const std::filesystem::path& path) {
  BufferedFile file(path);
  const PcdHeader header = read_pcd_header(file);
  PointTable table(columns_of(header), file.at_line());
  check_size(file, header);
  if (header.data != PcdHeader::Data::compressed) table.reserve(header.points);
  if (header.data == PcdHeader::Data::ascii) read_ascii(file, header, table);
  if (header.data == PcdHeader::Data::binary) read_binary(file, header, table);
  if (header.data == PcdHeader::Data::compressed && header.points > 0) read_compressed(file, header, table);
  return std::move(table).into_cloud();
}

}  // namespace scarp
