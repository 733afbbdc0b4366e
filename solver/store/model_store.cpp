// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/model_store.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/hdf5_store.hpp"
#include "solver/store/parameters_store.hpp"

namespace scarp {
namespace {

constexpr std::string_view kFormat = "scarp-model";
constexpr std::int64_t kVersion = 4;  // 3: rigid bodies; 4: fields of the state may be absent
constexpr const char* kFaces[6] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/// PARENT/000007: names are the user's and may hold anything, so groups are numbered.
std::string numbered(const std::string& parent, std::size_t i) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "/%06zu", i);
  return parent + digits;
}

/// Calls f(group of entry i) for each entry of a numbered list.
template <class F>
void write_list(Hdf5Writer& file, const std::string& parent, std::size_t count, F&& f) {
  file.group(parent);
  for (std::size_t i = 0; i < count; ++i) {
    file.group(numbered(parent, i));
    f(i, numbered(parent, i));
  }
}

template <class T, class F>
std::vector<T> read_list(const Hdf5Reader& file, const std::string& parent, F&& read_entry) {
  std::vector<T> list;
  const std::size_t count = file.names(parent).size();
  for (std::size_t i = 0; i < count; ++i) list.push_back(read_entry(numbered(parent, i)));
  return list;
}

void write_domain(Hdf5Writer& file, const Domain& domain) {
  const std::string group = "/domain";
  file.group(group);
  file.attribute(group, "dimension", std::int64_t{domain.dimension});
  file.attribute(group, "cell", domain.cell);
  file.attribute(group, "min", domain.min);
  file.attribute(group, "max", domain.max);
  for (int face = 0; face < 6; ++face) {
    const Face& held = domain.faces[face];
    file.text_attribute(group, kFaces[face], name_of(held.condition));
    if (held.condition == FaceCondition::friction)
      file.attribute(group, kFaces[face] + std::string("_friction"), held.friction);
  }
}

Domain read_domain(const Hdf5Reader& file) {
  const std::string group = "/domain";
  Domain domain;
  const auto dimension = file.attribute<std::int64_t>(group, "dimension");
  if (dimension != 2 && dimension != 3) file.refuse("/domain: dimension", std::to_string(dimension), "2, 3");
  domain.dimension = static_cast<int>(dimension);
  domain.cell = file.attribute<double>(group, "cell");
  domain.min = file.attribute<Vec3>(group, "min");
  domain.max = file.attribute<Vec3>(group, "max");
  for (int face = 0; face < 6; ++face) {
    Face& held = domain.faces[face];
    held.condition = read_enum<FaceCondition>(file, group, kFaces[face]);
    if (held.condition == FaceCondition::friction)
      held.friction = file.attribute<double>(group, kFaces[face] + std::string("_friction"));
  }
  return domain;
}

void write_material(Hdf5Writer& file, const std::string& group, NamedMaterial material) {
  file.text_attribute(group, "name", material.name);
  std::visit(
      [&]<class Law>(Law& law) {
        file.text_attribute(group, choice_key<Material>::value.data(), Law::name);
        law.describe(ParameterWriter(file, group));
      },
      material.law);
}

/// Tries the laws of the table until one has that name.
template <std::size_t i = 0>
Material read_law(const Hdf5Reader& file, const std::string& group, const std::string& name) {
  if constexpr (i == std::variant_size_v<Material>) {
    file.refuse(group + ": law that this program does not know", "'" + name + "'");
  } else {
    using Law = std::variant_alternative_t<i, Material>;
    if (Law::name != name) return read_law<i + 1>(file, group, name);
    Law law;
    law.describe(ParameterReader(file, group));
    return law;
  }
}

NamedMaterial read_material(const Hdf5Reader& file, const std::string& group) {
  return {file.text_attribute(group, "name"),
          read_law(file, group, file.text_attribute(group, choice_key<Material>::value.data()))};
}

void write_body(Hdf5Writer& file, const std::string& group, const Body& body) {
  file.text_attribute(group, "name", body.name);
  file.text_attribute(group, "formulation", name_of(body.formulation));
  file.attribute(group, "begin", static_cast<std::int64_t>(body.begin));
  file.attribute(group, "end", static_cast<std::int64_t>(body.end));
  file.attribute(group, "lattice_origin", body.lattice.origin);
  file.attribute(group, "lattice_cell", body.lattice.cell);
  file.attribute(group, "lattice_cells", body.lattice.cells);
  write_list(file, group + "/held", body.held.size(), [&](std::size_t i, const std::string& entry) {
    const NodeSet& set = body.held[i];
    file.text_attribute(entry, "name", set.name);
    file.text_attribute(entry, "condition", name_of(set.condition));
    file.attribute(entry, "axis", std::int64_t{set.axis});
    file.array(entry + "/nodes", set.nodes);
  });
  file.group(group + "/boundary");
  file.attribute(group + "/boundary", "ball_radius", body.ball_radius);
  file.array(group + "/boundary/vertices", body.boundary.vertices);
  file.array(group + "/boundary/triangles", body.boundary.triangles);
}

NodeSet read_node_set(const Hdf5Reader& file, const std::string& group, const Lattice& lattice) {
  NodeSet set;
  set.name = file.text_attribute(group, "name");
  set.condition = read_enum<Condition>(file, group, "condition");
  const auto axis = file.attribute<std::int64_t>(group, "axis");
  if (axis < -1 || axis > 2) file.refuse(group + ": axis", std::to_string(axis), "-1 to 2");
  set.axis = static_cast<int>(axis);
  set.nodes = file.array<std::array<std::int32_t, 3>>(group + "/nodes");
  for (const auto& node : set.nodes)
    for (int a = 0; a < 3; ++a)
      if (node[a] < 0 || node[a] > lattice.cells[a])
        file.refuse(group + ": node outside the lattice", std::to_string(node[a]),
                    "0 to " + std::to_string(lattice.cells[a]));
  return set;
}

TriangleMesh read_boundary(const Hdf5Reader& file, const std::string& group) {
  TriangleMesh mesh;
  mesh.vertices = file.array<Vec3>(group + "/vertices");
  mesh.triangles = file.array<std::array<std::uint32_t, 3>>(group + "/triangles");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      if (vertex >= mesh.vertices.size())
        file.refuse(group + ": vertex of a triangle", std::to_string(vertex),
                    "below " + std::to_string(mesh.vertices.size()));
  return mesh;
}

Body read_body(const Hdf5Reader& file, const std::string& group) {
  Body body;
  body.name = file.text_attribute(group, "name");
  body.formulation = read_enum<Formulation>(file, group, "formulation");
  body.begin = static_cast<std::size_t>(file.attribute<std::int64_t>(group, "begin"));
  body.end = static_cast<std::size_t>(file.attribute<std::int64_t>(group, "end"));
  body.lattice.origin = file.attribute<Vec3>(group, "lattice_origin");
  body.lattice.cell = file.attribute<double>(group, "lattice_cell");
  body.lattice.cells = file.attribute<std::array<std::int32_t, 3>>(group, "lattice_cells");
  for (const std::int32_t cells : body.lattice.cells)
    if (cells < 0) file.refuse(group + ": cells of the lattice", std::to_string(cells), "at least 0");
  body.held = read_list<NodeSet>(file, group + "/held",
                                 [&](const std::string& entry) { return read_node_set(file, entry, body.lattice); });
  body.boundary = read_boundary(file, group + "/boundary");
  body.ball_radius = file.attribute<double>(group + "/boundary", "ball_radius");
  return body;
}

/// The numbers of a volume report, named once for both directions.
template <class R, class F>
void for_each_number(R& report, F&& f) {
  f("input_volume", report.input_volume);
  f("particle_volume", report.particle_volume);
  f("particles", report.particles);
  f("cells", report.cells);
  f("full_cells", report.full_cells);
  f("isolated_particles", report.isolated_particles);
  f("mean_thickness_in_cells", report.mean_thickness_in_cells);
  f("closed", report.closed);
  f("self_intersecting", report.self_intersecting);
}

void write_volume(Hdf5Writer& file, const std::string& group, const VolumeReport& report) {
  file.text_attribute(group, "body", report.body);
  for_each_number(report, [&]<class T>(const char* name, const T& value) {
    if constexpr (std::is_same_v<T, double>)
      file.attribute(group, name, value);
    else
      file.attribute(group, name, static_cast<std::int64_t>(value));
  });
  write_list(file, group + "/by_material", report.volume_by_material.size(),
             [&](std::size_t i, const std::string& entry) {
               file.text_attribute(entry, "name", report.volume_by_material[i].first);
               file.attribute(entry, "volume", report.volume_by_material[i].second);
             });
}

VolumeReport read_volume(const Hdf5Reader& file, const std::string& group) {
  VolumeReport report;
  report.body = file.text_attribute(group, "body");
  for_each_number(report, [&]<class T>(const char* name, T& value) {
    if constexpr (std::is_same_v<T, double>)
      value = file.attribute<double>(group, name);
    else
      value = static_cast<T>(file.attribute<std::int64_t>(group, name));
  });
  report.volume_by_material =
      read_list<std::pair<std::string, double>>(file, group + "/by_material", [&](const std::string& entry) {
        return std::pair(file.text_attribute(entry, "name"), file.attribute<double>(entry, "volume"));
      });
  return report;
}

void write_particles(Hdf5Writer& file, const Particles& particles) {
  file.group("/particles");
  const auto write = [&](const std::string& name, const char* unit, auto member, const auto&) {
    const auto& values = particles.*member;
    if (values.size() != particles.size())
      throw Error("store", "length of the particle field " + name, std::to_string(values.size()),
                  std::to_string(particles.size()));
    file.array("/particles/" + name, values);
    file.text_attribute("/particles/" + name, "unit", unit);
  };
  for_each_constant(write);
  for_each_of_state([&](const std::string& name, const char* unit, auto member, const auto& initial) {
    if (!(particles.*member).empty()) write(name, unit, member, initial);
  });
}

Particles read_particles(const Hdf5Reader& file) {
  Particles particles;
  const auto read = [&](const std::string& name, const char*, auto member, const auto& initial) {
    auto& values = particles.*member;
    values = file.array<std::decay_t<decltype(initial)>>("/particles/" + name);
    if (values.size() != particles.size())
      file.refuse("rows of /particles/" + name, std::to_string(values.size()), std::to_string(particles.size()));
  };
  for_each_constant(read);
  const std::vector<std::string> there = file.names("/particles");
  for_each_of_state([&](const std::string& name, const char* unit, auto member, const auto& initial) {
    if (std::find(there.begin(), there.end(), name) != there.end()) read(name, unit, member, initial);
  });
  return particles;
}

/// What the solver relies on when it indexes.
void check_consistency(const Hdf5Reader& file, const Model& model) {
  const Particles& particles = model.particles;
  for (const Body& body : model.bodies)
    if (body.begin > body.end || body.end > particles.size())
      file.refuse("range of the body '" + body.name + "'",
                  std::to_string(body.begin) + " to " + std::to_string(body.end),
                  "within the " + std::to_string(particles.size()) + " particles");
  const auto check = [&](const char* what, const std::vector<std::int32_t>& indices, std::size_t count) {
    for (const std::int32_t i : indices)
      if (i < 0 || static_cast<std::size_t>(i) >= count)
        file.refuse(std::string(what) + " of a particle", std::to_string(i), "below " + std::to_string(count));
  };
  check("body", particles.body, model.bodies.size());
  check("material", particles.material, model.materials.size());
}

void write_content(Hdf5Writer& file, const Model& model) {
  write_format(file, kFormat, kVersion);
  file.group("/site");
  file.value("/site/origin", model.site.origin);
  file.text("/site/crs", model.site.crs);
  write_domain(file, model.domain);
  write_list(file, "/materials", model.materials.size(),
             [&](std::size_t i, const std::string& group) { write_material(file, group, model.materials[i]); });
  write_list(file, "/bodies", model.bodies.size(),
             [&](std::size_t i, const std::string& group) { write_body(file, group, model.bodies[i]); });
  write_list(file, "/volumes", model.volumes.size(),
             [&](std::size_t i, const std::string& group) { write_volume(file, group, model.volumes[i]); });
  write_particles(file, model.particles);
}

}  // namespace

void write_model(const std::filesystem::path& path, const Model& model) {
  write_whole(path, [&](const std::filesystem::path& temporary) {
    Hdf5Writer file(temporary, path);
    write_content(file, model);
    file.finish();
  });
}

Model read_model(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  file.expect_format(kFormat, kVersion);
  Model model;
  model.site.origin = file.value<Vec3>("/site/origin");
  model.site.crs = file.text("/site/crs");
  model.domain = read_domain(file);
  model.materials = read_list<NamedMaterial>(file, "/materials",
                                             [&](const std::string& group) { return read_material(file, group); });
  model.bodies = read_list<Body>(file, "/bodies", [&](const std::string& group) { return read_body(file, group); });
  model.volumes =
      read_list<VolumeReport>(file, "/volumes", [&](const std::string& group) { return read_volume(file, group); });
  model.particles = read_particles(file);
  check_consistency(file, model);
  return model;
}

bool is_model_file(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  return file.has_attribute("/", "format") && file.text_attribute("/", "format") == kFormat;
}

}  // namespace scarp
