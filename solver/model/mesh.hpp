// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/site.hpp"

namespace scarp {

/// Triangles with shared vertices; counter-clockwise seen from outside. Vertices in metres minus site.origin.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  SiteFrame site;
};

}  // namespace scarp
