// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh_faces.hpp"

namespace scarp {

void check_vertex(const Vec3& vertex, const SourceLocation& where) {
  if (is_finite(vertex)) return;
  throw Error("ingest", "vertex of a mesh", shortest(vertex[0]) + " " + shortest(vertex[1]) + " " + shortest(vertex[2]),
              "finite coordinates", where);
}

void add_face(const std::vector<double>& corners, std::uint64_t vertices, const SourceLocation& where,
              TriangleMesh& mesh) {
  if (corners.size() < 3)
    throw Error("ingest", "corners of a face", std::to_string(corners.size()), "at least 3", where);
  for (double corner : corners)
    if (!(corner >= 0 && corner < static_cast<double>(vertices)))
      throw Error("ingest", "face names a vertex that is not there", shortest(corner),
                  "0 to " + std::to_string(vertices) + " - 1", where);
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[k - 1]),
                              static_cast<std::uint32_t>(corners[k])});
}

}  // namespace scarp
