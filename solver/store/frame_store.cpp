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

void check_frame(const std::filesystem::path& path, const Frame& frame) {
  if (path.extension() != ".hdf")
    refuse(path, "extension of a frame", "'" + path.extension().string() + "'", "'.hdf', which ParaView goes by");
  if (frame.positions.empty()) refuse(path, "particles in a frame", "0", "at least 1");
  std::set<std::string> names;
  for (const FrameField& field : frame.fields) {
    if (field.name.empty() || field.name == "." || field.name.find_first_of(std::string("/\0", 2)) != std::string::npos)
      refuse(path, "name of a field", "'" + field.name + "'", "a text without '/'");
    if (!names.insert(field.name).second) refuse(path, "name of a field", "'" + field.name + "' twice", "each once");
    const std::size_t length = std::visit([](const auto& values) { return values.size(); }, field.values);
    if (field.components < 1 || length != frame.positions.size() * static_cast<std::size_t>(field.components))
      refuse(path, "length of the field '" + field.name + "'", std::to_string(length),
             std::to_string(frame.positions.size()) + " particles x " + std::to_string(field.components));
  }
}

/// One vertex cell per particle.
void write_cells(Hdf5Writer& file, std::size_t count) {
  constexpr std::uint8_t vtk_vertex = 1;
  std::vector<std::int64_t> sequence(count + 1);
  std::iota(sequence.begin(), sequence.end(), std::int64_t{0});
  const std::array<std::int64_t, 1> number{static_cast<std::int64_t>(count)};
  file.value("/VTKHDF/NumberOfPoints", number);
  file.value("/VTKHDF/NumberOfCells", number);
  file.value("/VTKHDF/NumberOfConnectivityIds", number);
  file.array("/VTKHDF/Offsets", sequence);
  sequence.pop_back();
  file.array("/VTKHDF/Connectivity", sequence);
  file.array("/VTKHDF/Types", std::vector<std::uint8_t>(count, vtk_vertex));
}

void write_field(Hdf5Writer& file, const FrameField& field, std::size_t count) {
  const std::string path = kFields + "/" + field.name;
  std::visit(
      [&]<class T>(const std::vector<T>& values) {
        file.array(path, {element_type<T>(), count, field.components}, values.data());
      },
      field.values);
  file.text_attribute(path, "unit", field.unit);
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

void write_frame(const std::filesystem::path& path, const Frame& frame) {
  check_frame(path, frame);
  Hdf5Writer file(path);
  write_format(file, kFormat, kVersion);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.text_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  file.array(kPoints, frame.positions);
  file.text_attribute(kPoints, "unit", "m");
  write_cells(file, frame.positions.size());
  file.group(kFields);
  for (const FrameField& field : frame.fields) write_field(file, field, frame.positions.size());

  file.value("/time", frame.time);
  file.text_attribute("/time", "unit", "s");
  file.value("/step", frame.step);
  file.value("/origin", frame.site.origin);
  file.text_attribute("/origin", "unit", "m");
  file.text("/crs", frame.site.crs);
  write_whole(path, file.finish());
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
