// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_obj.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ingest/mesh_faces.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

/// The vertex index, from 0, of a corner such as "3", "3/1", "3//2", "-1/-1/-1".
double corner_of(std::string_view corner, std::size_t vertices, const BufferedFile& file) {
  const std::string_view index = corner.substr(0, corner.find('/'));
  const auto value = number_of(index);
  if (!value || *value != std::floor(*value) || *value == 0)
    throw Error("ingest", "corner of a face", shown(corner),
                "v, v/vt, v//vn or v/vt/vn with indices from 1, or from -1 backwards", file.at_line());
  return *value > 0 ? *value - 1 : static_cast<double>(vertices) + *value;
}

Vec3 vertex_of(std::string_view line, const std::vector<std::string_view>& words, const BufferedFile& file) {
  if (words.size() < 4) throw Error("ingest", "vertex", shown(line), "v X Y Z", file.at_line());
  Vec3 vertex;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = words[axis + 1];
    const auto value = number_of(word);
    if (!value)
      throw Error("ingest", "not a number", shown(word), "a decimal number",
                  file.at_line(static_cast<std::size_t>(word.data() - line.data()) + 1));
    vertex[axis] = *value;
  }
  check_vertex(vertex, file.at_line());
  return vertex;
}

}  // namespace

TriangleMesh read_obj(BufferedFile& file) {
  TriangleMesh mesh;
  std::vector<double> corners;
  // A face may stand before its vertices: what it names is checked when all are there.
  double most = -1;
  SourceLocation most_where;
  std::string_view line;
  while (file.next_line(line)) {
    const std::vector<std::string_view> words = split(line, ' ');
    if (words.empty()) continue;
    if (words[0] == "v") mesh.vertices.push_back(vertex_of(line, words, file));
    if (words[0] != "f") continue;
    corners.clear();
    for (std::size_t k = 1; k < words.size(); ++k) {
      corners.push_back(corner_of(words[k], mesh.vertices.size(), file));
      if (corners.back() > most) {
        most = corners.back();
        most_where = file.at_line();
      }
    }
    add_face(corners, std::numeric_limits<std::uint32_t>::max(), file.at_line(), mesh);
  }
  if (most >= static_cast<double>(mesh.vertices.size()))
    throw Error("ingest", "face names a vertex that is not there", shortest(most + 1),
                "1 to " + std::to_string(mesh.vertices.size()), most_where);
  return mesh;
}

}  // namespace scarp
