// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/info.hpp"

#include <cctype>
#include <cstdio>
#include <fstream>

#include "ingest/read_cloud.hpp"
#include "ingest/read_las.hpp"
#include "ingest/read_mesh.hpp"
#include "ingest/read_raster.hpp"
#include "solver/model/error.hpp"
#include "solver/store/frame_store.hpp"
#include "solver/store/model_store.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {
namespace {

std::string box_line(const Box3& box) {
  if (box.empty()) return "  bounds: none\n";
  char text[256];
  std::snprintf(text, sizeof text, "  bounds: x %.6f .. %.6f, y %.6f .. %.6f, z %.6f .. %.6f m\n", box.min[0],
                box.max[0], box.min[1], box.max[1], box.min[2], box.max[2]);
  return text;
}

/// Whole metres, never as 5e+05.
std::string origin_line(const Vec3& origin) {
  char text[128];
  std::snprintf(text, sizeof text, "  origin: %.0f %.0f %.0f\n", origin[0], origin[1], origin[2]);
  return text;
}

std::string crs_line(const std::string& crs) { return "  CRS: " + (crs.empty() ? "not stated" : crs) + "\n"; }

std::string las_info(const LasHeader& header) {
  std::string text = "LAS " + std::to_string(header.version_major) + "." + std::to_string(header.version_minor) +
                     ", point format " + std::to_string(header.point_format) +
                     (header.compressed ? ", compressed (LAZ)" : "") + "\n  points: " + std::to_string(header.count) +
                     "\n";
  text += box_line(header.bounds);
  text += "  scale: " + shortest(header.scale[0]) + " " + shortest(header.scale[1]) + " " + shortest(header.scale[2]) +
          "\n";
  if (!header.generating_software.empty()) text += "  written by: " + header.generating_software + "\n";
  return text + crs_line(header.crs);
}

std::string cloud_info(const PointCloud& cloud) {
  std::string text = "point cloud\n  points: " + std::to_string(cloud.size()) + "\n";
  Box3 box;
  std::size_t not_finite = 0;
  for (const Vec3& p : cloud.positions) is_finite(p) ? box.extend(p) : void(++not_finite);
  text += box_line(box);
  if (not_finite > 0) text += "  points without finite coordinates: " + std::to_string(not_finite) + "\n";
  std::string fields;
  const auto add = [&](bool present, const std::string& name) {
    if (present) fields += " " + name;
  };
  add(!cloud.colour.empty(), "colour");
  add(!cloud.intensity.empty(), "intensity");
  add(!cloud.classification.empty(), "classification");
  add(!cloud.return_number.empty(), "return_number");
  add(!cloud.gps_time.empty(), "gps_time");
  add(!cloud.normals.empty(), "normals");
  for (const PointScalar& scalar : cloud.scalars) add(true, scalar.name);
  return text + "  fields:" + (fields.empty() ? " none beside the coordinates" : fields) + "\n" +
         crs_line(cloud.site.crs);
}

std::string raster_info(const Heightfield& field) {
  const std::vector<Vec3> centres = raster_to_cloud(field).positions;
  const std::size_t cells = field.z.size();
  return "raster\n  cells: " + std::to_string(field.columns) + " x " + std::to_string(field.rows) + " of " +
         shortest(field.cell) + " m\n  without data: " + std::to_string(cells - centres.size()) + "\n" +
         box_line(bounds(centres)) + crs_line(field.site.crs);
}

std::string frame_info(const Frame& frame) {
  std::string text = "frame\n  time: " + shortest(frame.time) + " s, step " + std::to_string(frame.step) +
                     "\n  particles: " + std::to_string(frame.positions.size()) + "\n" +
                     box_line(bounds(frame.positions));
  text += origin_line(frame.site.origin) + "  fields:";
  for (const FrameField& field : frame.fields)
    text += " " + field.name + "[" + std::to_string(field.components) + "]" +
            (field.unit == "1" ? "" : " (" + field.unit + ")");
  return text + "\n" + crs_line(frame.site.crs);
}

std::string model_info(const Model& model) {
  const Particles& particles = model.particles;
  std::string text =
      "model\n  particles: " + std::to_string(particles.size()) + "\n" + box_line(bounds(current_positions(particles)));
  for (const Body& body : model.bodies)
    text += "  body " + body.name + ": " + std::to_string(body.end - body.begin) + " particles, cell " +
            shortest(body.lattice.cell) + " m\n";
  for (const NamedMaterial& material : model.materials)
    text += "  material " + material.name + ": " +
            std::string(std::visit([](const auto& law) { return law.name; }, material.law)) + "\n";
  return text + origin_line(model.site.origin) + crs_line(model.site.crs);
}

std::string mesh_info(const TriangleMesh& mesh) {
  return "mesh\n  vertices: " + std::to_string(mesh.vertices.size()) +
         "\n  triangles: " + std::to_string(mesh.triangles.size()) + "\n" + box_line(bounds(mesh.vertices));
}

bool starts_with(const std::filesystem::path& file, std::string_view magic) {
  std::ifstream in(file, std::ios::binary);
  std::string start(magic.size(), '\0');
  return in.read(start.data(), static_cast<std::streamsize>(start.size())) && start == magic;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool has_faces(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (int i = 0; i < 200 && std::getline(in, line) && line.rfind("end_header", 0) != 0; ++i)
    if (line.rfind("element face ", 0) == 0) return std::isdigit(line[13]) && line[13] != '0';
  return false;
}

}  // namespace

bool holds_mesh(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".obj" || extension == ".stl" || (starts_with(file, "ply") && has_faces(file));
}

bool holds_raster(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string start(4096, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return is_raster(std::string_view(start).substr(0, static_cast<std::size_t>(in.gcount())));
}

std::string file_info(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw Error("info", file.string() + " is a folder", "", "a file");
  // A pipe would keep the program waiting for ever.
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
    throw Error("info", file.string() + " is not an ordinary file");
  if (!std::ifstream(file)) throw Error("info", "cannot read " + file.string(), "no such file or no permission");
  const std::string extension = lower_extension(file);
  std::string text;
  if (extension == ".hdf") {
    text = is_model_file(file) ? model_info(read_model(file)) : frame_info(read_frame(file));
  } else if (starts_with(file, "LASF")) {
    text = las_info(read_las_header(file));
  } else if (holds_mesh(file)) {
    text = mesh_info(read_mesh(file));
  } else if (holds_raster(file)) {
    text = raster_info(read_raster(file));
  } else {
    text = cloud_info(read_cloud(file));
  }
  return file.string() + ": " + text;
}

}  // namespace scarp
