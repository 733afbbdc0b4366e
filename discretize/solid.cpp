// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/solid.hpp"

#include "solver/model/error.hpp"

namespace scarp {
namespace {

template <class T>
const T& loaded(const std::map<std::string, T>& inputs, const std::string& key, const char* what,
                const std::string& body) {
  const auto found = inputs.find(key);
  if (found != inputs.end()) return found->second;
  std::string known;
  for (const auto& [name, unused] : inputs) known += (known.empty() ? "" : ", ") + name;
  throw Error("discretize", "body '" + body + "': unknown " + what, "'" + key + "'", known.empty() ? "none" : known);
}

struct Close {
  const DiscretizeInput& input;
  const std::string& body;
  int dimension;

  Solid operator()(const ScanVolume& v) const {
    need_dimension(dimension, 3, "scan", body);
    const PointCloud* base = v.base_scan ? &loaded(input.scans, *v.base_scan, "scan", body) : nullptr;
    return close_terrain(v, loaded(input.scans, v.scan, "scan", body), base, body, input.threads);
  }
  Solid operator()(const MeshVolume& v) const {
    need_dimension(dimension, 3, "mesh", body);
    return close_mesh(loaded(input.meshes, v.mesh.path, "mesh", body), body, v.mesh.path);
  }
  Solid operator()(const BoxVolume& v) const { return close_box(v, dimension, body); }
  Solid operator()(const DiskVolume& v) const { return close_disk(v, dimension, body); }
  Solid operator()(const SphereVolume& v) const { return close_sphere(v, dimension, body); }
  Solid operator()(const PolygonVolume& v) const { return close_polygon(v, dimension, body); }
};

}  // namespace

Solid close_volume(const BodyOptions& options, const DiscretizeInput& input) {
  return std::visit(Close{input, options.name, input.scenario.domain.dimension}, options.volume);
}

}  // namespace scarp
