// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/frame_store.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/hdf5_store.hpp"

namespace scarp {
namespace {

constexpr std::string_view kFormat = "scarp-frame";
constexpr std::int64_t kVersion = 1;
const std::string kPoints = "/VTKHDF/Points";
const std::string kFields = "/VTKHDF/PointData";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what, const std::string& found,
                         const std::string& allowed) {
  throw Error("store", what, found, allowed, {path.string()});
}

void check_part(const std::filesystem::path& path, const Frame& part) {
  std::set<std::string> names;
  for (const FrameField& field : part.fields) {
    if (field.name.empty() || field.name == "." || field.name.find_first_of(std::string("/\0", 2)) != std::string::npos)
      refuse(path, "name of a field", "'" + field.name + "'", "a text without '/'");
    if (!names.insert(field.name).second) refuse(path, "name of a field", "'" + field.name + "' twice", "each once");
    const std::size_t length = std::visit([](const auto& values) { return values.size(); }, field.values);
    if (field.components < 1 || length != part.positions.size() * static_cast<std::size_t>(field.components))
      refuse(path, "length of the field '" + field.name + "'", std::to_string(length),
             std::to_string(part.positions.size()) + " particles x " + std::to_string(field.components));
  }
}

/// One vertex cell per particle.
void begin_cells(Hdf5Writer& file, std::size_t count) {
  const std::array<std::int64_t, 1> number{static_cast<std::int64_t>(count)};
  file.value("/VTKHDF/NumberOfPoints", number);
  file.value("/VTKHDF/NumberOfCells", number);
  file.value("/VTKHDF/NumberOfConnectivityIds", number);
  file.begin_array("/VTKHDF/Offsets", {ElementType::int64, count + 1, 1});
  file.begin_array("/VTKHDF/Connectivity", {ElementType::int64, count, 1});
  file.begin_array("/VTKHDF/Types", {ElementType::uint8, count, 1});
}

void write_cells(Hdf5Writer& file, std::size_t first, std::size_t count, bool last) {
  constexpr std::uint8_t vtk_vertex = 1;
  std::vector<std::int64_t> sequence(count + last);
  std::iota(sequence.begin(), sequence.end(), static_cast<std::int64_t>(first));
  file.rows("/VTKHDF/Offsets", first, sequence);
  sequence.resize(count);
  file.rows("/VTKHDF/Connectivity", first, sequence);
  file.rows("/VTKHDF/Types", first, std::vector<std::uint8_t>(count, vtk_vertex));
}

ArrayShape shape_of(const FrameField& field, std::size_t rows) {
  return std::visit(
      [&]<class T>(const std::vector<T>&) {
        return ArrayShape{element_type<T>(), rows, field.components};
      },
      field.values);
}

std::string path_of(const FrameField& field) { return kFields + "/" + field.name; }

/// All that the file has beside its rows.
void begin_frame(Hdf5Writer& file, const Frame& part, std::size_t count) {
  write_format(file, kFormat, kVersion);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.text_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  file.begin_array(kPoints, {ElementType::float64, count, 3});
  file.text_attribute(kPoints, "unit", "m");
  begin_cells(file, count);
  file.group(kFields);
  for (const FrameField& field : part.fields) {
    file.begin_array(path_of(field), shape_of(field, count));
    file.text_attribute(path_of(field), "unit", field.unit);
  }
  file.value("/time", part.time);
  file.text_attribute("/time", "unit", "s");
  file.value("/step", part.step);
  file.value("/origin", part.site.origin);
  file.text_attribute("/origin", "unit", "m");
  file.text("/crs", part.site.crs);
}

void write_part(Hdf5Writer& file, const Frame& part, std::size_t first, std::size_t count) {
  const std::size_t rows = part.positions.size();
  file.rows(kPoints, first, part.positions);
  write_cells(file, first, rows, first + rows == count);
  for (const FrameField& field : part.fields)
    std::visit([&](const auto& values) { file.rows(path_of(field), first, shape_of(field, rows), values.data()); },
               field.values);
}

FrameField read_field(const Hdf5Reader& file, const std::string& name, std::size_t count) {
  const std::string path = kFields + "/" + name;
  const ArrayShape shape = file.shape(path);
  if (shape.rows != count)
    file.refuse("rows of the array " + path, std::to_string(shape.rows), std::to_string(count) + ", one per point");
  FrameField field;
  field.name = name;
  field.unit = file.text_attribute(path, "unit");
  field.components = shape.components;
  switch (shape.type) {
    case ElementType::float32:
      field.values = std::vector<float>();
      break;
    case ElementType::int64:
      field.values = std::vector<std::int64_t>();
      break;
    case ElementType::int32:
      field.values = std::vector<std::int32_t>();
      break;
    case ElementType::uint8:
      field.values = std::vector<std::uint8_t>();
      break;
    case ElementType::float64:
    case ElementType::uint32:
      file.refuse("type of the array " + path, shape.type == ElementType::uint32 ? "uint32" : "float64",
                  "float32, int64, int32, uint8");
  }
  std::visit(
      [&](auto& values) {
        values.resize(count * static_cast<std::size_t>(field.components));
        file.read(path, shape, values.data());
      },
      field.values);
  return field;
}

}  // namespace

void write_frame(const std::filesystem::path& path, std::size_t particles, const FrameParts& each_part) {
  if (path.extension() != ".hdf")
    refuse(path, "extension of a frame", "'" + path.extension().string() + "'", "'.hdf', which ParaView goes by");
  if (particles == 0) refuse(path, "particles in a frame", "0", "at least 1");
  write_whole(path, [&](const std::filesystem::path& temporary) {
    Hdf5Writer file(temporary, path);
    std::size_t done = 0;
    each_part([&](const Frame& part) {
      check_part(path, part);
      if (done == 0) begin_frame(file, part, particles);
      write_part(file, part, done, particles);
      done += part.positions.size();
    });
    if (done != particles)
      refuse(path, "particles in the parts of a frame", std::to_string(done), std::to_string(particles));
    file.finish();
  });
}

void write_frame(const std::filesystem::path& path, const Frame& frame) {
  write_frame(path, frame.positions.size(), [&](const auto& append) { append(frame); });
}

Frame read_frame(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  file.expect_format(kFormat, kVersion);
  Frame frame;
  frame.time = file.value<double>("/time");
  frame.step = file.value<std::int64_t>("/step");
  frame.site.origin = file.value<Vec3>("/origin");
  frame.site.crs = file.text("/crs");
  frame.positions = file.array<Vec3>(kPoints);
  if (frame.positions.empty()) file.refuse("particles in the frame", "0", "at least 1");
  for (const std::string& name : file.names(kFields))
    frame.fields.push_back(read_field(file, name, frame.positions.size()));
  return frame;
}

}  // namespace scarp
