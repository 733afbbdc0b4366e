// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_ply.hpp"

#include "ingest/point_table.hpp"
#include "ingest/read_ply_rows.hpp"

namespace scarp {
namespace {

ColourScale scale_of(NumberType type) {
  switch (type) {
    case NumberType::u8:
      return ColourScale::byte;
    case NumberType::u16:
      return ColourScale::word;
    case NumberType::f32:
    case NumberType::f64:
      return ColourScale::real;
    default:
      return ColourScale::guess;
  }
}

}  // namespace

PointCloud read_ply(const std::filesystem::path& path) {
  BufferedFile file(path);
  const PlyHeader header = read_ply_header(file);
  const PlyElement* vertex = header.find("vertex");
  if (!vertex) throw Error("ingest", "PLY file without the element 'vertex'", {}, {}, file.at_line());
  std::vector<TableColumn> columns;
  for (const PlyProperty& property : vertex->properties)
    if (!property.length_type) columns.push_back({property.name, scale_of(property.type)});
  PointTable table(columns, file.at_line());
  for (const PlyElement& element : header.elements) {
    PlyRows rows(file, header.format, element);
    if (&element != vertex) {
      rows.skip();
      continue;
    }
    table.reserve(element.count);
    PlyRow row;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows.next(row);
      table.add_row(row.scalars.data());
    }
    break;
  }
  return std::move(table).into_cloud();
}

}  // namespace scarp
