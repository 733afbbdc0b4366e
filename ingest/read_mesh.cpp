// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_mesh.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "ingest/mesh_faces.hpp"
#include "ingest/read_buffered.hpp"
#include "ingest/read_obj.hpp"
#include "ingest/read_ply_rows.hpp"
#include "ingest/read_stl.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

using Places = std::vector<const PlyProperty*>;

/// Where `name` stands among the properties that are lists, or among those that are not; their number if nowhere.
std::size_t place_of(const PlyElement& element, bool list, std::initializer_list<std::string_view> names) {
  Places same_kind;
  for (const PlyProperty& property : element.properties)
    if (property.length_type.has_value() == list) same_kind.push_back(&property);
  const auto found = std::find_if(same_kind.begin(), same_kind.end(), [&](const PlyProperty* property) {
    return std::find(names.begin(), names.end(), property->name) != names.end();
  });
  if (found != same_kind.end()) return static_cast<std::size_t>(found - same_kind.begin());
  throw Error("ingest",
              "PLY element '" + element.name + "' without the property '" + std::string(*names.begin()) + "'");
}

void read_vertices(PlyRows& rows, const PlyElement& element, const BufferedFile& file, bool text, TriangleMesh& mesh) {
  const std::array<std::size_t, 3> xyz{place_of(element, false, {"x"}), place_of(element, false, {"y"}),
                                       place_of(element, false, {"z"})};
  if (element.count > std::numeric_limits<std::uint32_t>::max())
    throw Error("ingest", "vertices of a mesh", std::to_string(element.count), "less than 2^32", file.at_line());
  mesh.vertices.reserve(element.count);
  PlyRow row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    rows.next(row);
    const Vec3 vertex{row.scalars[xyz[0]], row.scalars[xyz[1]], row.scalars[xyz[2]]};
    check_vertex(vertex, text ? file.at_line() : file.at_byte());
    mesh.vertices.push_back(vertex);
  }
}

void read_faces(PlyRows& rows, const PlyElement& element, const BufferedFile& file, bool text, std::uint64_t vertices,
                TriangleMesh& mesh) {
  const std::size_t list = place_of(element, true, {"vertex_indices", "vertex_index"});
  PlyRow row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    rows.next(row);
    add_face(row.lists[list], vertices, text ? file.at_line() : file.at_byte(), mesh);
  }
}

TriangleMesh read_ply_mesh(BufferedFile& file) {
  const PlyHeader header = read_ply_header(file);
  const PlyElement *vertex = header.find("vertex"), *face = header.find("face");
  if (!vertex || !face)
    throw Error("ingest", "PLY file without the element '" + std::string(vertex ? "face" : "vertex") + "'", {},
                "a mesh with vertices and faces", file.at_line());
  const bool text = header.format == PlyFormat::ascii;
  TriangleMesh mesh;
  for (const PlyElement& element : header.elements) {
    PlyRows rows(file, header.format, element);
    if (&element == vertex)
      read_vertices(rows, element, file, text, mesh);
    else if (&element == face)
      read_faces(rows, element, file, text, vertex->count, mesh);
    else
      rows.skip();
  }
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path) {
  BufferedFile file(path);
  const std::string extension = lower_case(path.extension().string());
  TriangleMesh mesh;
  if (file.size() == 0) throw Error("ingest", "is empty", {}, {}, {path.string()});
  if (file.peek().starts_with("ply"))
    mesh = read_ply_mesh(file);
  else if (extension == ".stl" || is_binary_stl(file))
    mesh = read_stl(file);
  else if (extension == ".obj")
    mesh = read_obj(file);
  else
    throw Error("ingest", "mesh format not known", shown(extension), "PLY, OBJ or STL", {path.string()});
  if (mesh.triangles.empty()) throw Error("ingest", "mesh without triangles", {}, {}, {path.string()});
  return mesh;
}

}  // namespace scarp
