// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_las.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "ingest/write_las.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

using las::load;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
// Small enough to stay in the second-level cache while its fields are taken one after the other.
constexpr std::size_t kBlockBytes = 256 * 1024;

/// Consecutive point records.
struct Block {
  const char* records;
  std::size_t stride;
  std::size_t first;  ///< index of the first point
  std::size_t count;

  const char* at(std::size_t i) const { return records + i * stride; }
};

double finite_or_no_value(double value) { return std::isfinite(value) ? value : kNoValue; }

template <class T>
void take_dimension(const Block& block, const las::ExtraDimension& dimension, std::vector<double>& values) {
  for (std::size_t i = 0; i < block.count; ++i) {
    const double raw = static_cast<double>(load<T>(block.at(i) + dimension.at));
    const bool absent = dimension.no_data && raw == *dimension.no_data;
    values[block.first + i] = absent ? kNoValue : finite_or_no_value(raw * dimension.scale + dimension.offset);
  }
}

void take_extra(const Block& block, const las::ExtraDimension& dimension, std::vector<double>& values) {
  switch (dimension.type) {
    case 1:
      return take_dimension<std::uint8_t>(block, dimension, values);
    case 2:
      return take_dimension<std::int8_t>(block, dimension, values);
    case 3:
      return take_dimension<std::uint16_t>(block, dimension, values);
    case 4:
      return take_dimension<std::int16_t>(block, dimension, values);
    case 5:
      return take_dimension<std::uint32_t>(block, dimension, values);
    case 6:
      return take_dimension<std::int32_t>(block, dimension, values);
    case 7:
      return take_dimension<std::uint64_t>(block, dimension, values);
    case 8:
      return take_dimension<std::int64_t>(block, dimension, values);
    case 9:
      return take_dimension<float>(block, dimension, values);
    default:
      return take_dimension<double>(block, dimension, values);
  }
}

void take_positions(const Block& block, const LasHeader& header, PointCloud& cloud) {
  const Vec3 scale = header.scale, offset = header.offset;
  for (std::size_t i = 0; i < block.count; ++i) {
    const char* record = block.at(i);
    Vec3& p = cloud.positions[block.first + i];
    for (std::size_t a = 0; a < 3; ++a) p[a] = load<std::int32_t>(record + 4 * a) * scale[a] + offset[a];
  }
}

void take_attributes(const Block& block, const las::PointLayout& layout, PointCloud& cloud) {
  const int mask = (1 << layout.return_bits) - 1;
  const int class_mask = layout.classification == 15 ? 0x1F : 0xFF;  // the upper bits of byte 15 are flags
  for (std::size_t i = 0; i < block.count; ++i) {
    const char* record = block.at(i);
    const std::size_t n = block.first + i;
    const int returns = static_cast<unsigned char>(record[14]);
    cloud.intensity[n] = load<std::uint16_t>(record + 12);
    cloud.return_number[n] = static_cast<std::uint8_t>(returns & mask);
    cloud.number_of_returns[n] = static_cast<std::uint8_t>((returns >> layout.return_bits) & mask);
    cloud.classification[n] = static_cast<std::uint8_t>(record[layout.classification] & class_mask);
  }
  if (layout.gps_time >= 0)
    for (std::size_t i = 0; i < block.count; ++i)
      cloud.gps_time[block.first + i] = finite_or_no_value(load<double>(block.at(i) + layout.gps_time));
  if (layout.colour >= 0)
    for (std::size_t i = 0; i < block.count; ++i)
      std::memcpy(cloud.colour[block.first + i].data(), block.at(i) + layout.colour, sizeof(Rgb16));
}

PointCloud allocate(const LasHeader& header) {
  const las::PointLayout& layout = las::point_layout(header.point_format);
  const std::size_t count = header.points_in_file;  // read_las_header held it against the size of the file
  PointCloud cloud;
  cloud.site.crs = header.crs;
  cloud.positions.resize(count);
  cloud.intensity.resize(count);
  cloud.classification.resize(count);
  cloud.return_number.resize(count);
  cloud.number_of_returns.resize(count);
  if (layout.gps_time >= 0) cloud.gps_time.resize(count);
  if (layout.colour >= 0) cloud.colour.resize(count);
  for (const las::ExtraDimension& dimension : header.extra_dimensions)
    cloud.scalars.push_back({dimension.name, dimension.unit, std::vector<double>(count)});
  return cloud;
}

template <class T>
bool all_zero(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](T value) { return value == 0; });
}

/// Zero throughout is how LAS says "not recorded".
void drop_unrecorded(PointCloud& cloud) {
  if (all_zero(cloud.intensity)) cloud.intensity = {};
  if (all_zero(cloud.gps_time)) cloud.gps_time = {};
  if (all_zero(cloud.return_number) && all_zero(cloud.number_of_returns))
    cloud.return_number = cloud.number_of_returns = {};
}

void widen_colour(std::vector<Rgb16>& colour) {
  for (const Rgb16& c : colour)
    if (c[0] > 255 || c[1] > 255 || c[2] > 255) return;
  for (Rgb16& c : colour)
    for (std::uint16_t& channel : c) channel = static_cast<std::uint16_t>(channel * 257);
}

/// Turns NormalX, NormalY, NormalZ into normals if every one of them is a unit vector.
void gather_normals(PointCloud& cloud) {
  std::array<const PointScalar*, 3> component{};
  for (const PointScalar& scalar : cloud.scalars)
    for (std::size_t a = 0; a < 3; ++a)
      if (scalar.name == kNormalNames[a]) component[a] = &scalar;
  if (!component[0] || !component[1] || !component[2]) return;
  std::vector<Vec3> normals(cloud.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = {component[0]->values[i], component[1]->values[i], component[2]->values[i]};
    if (!(std::abs(norm(normals[i]) - 1) < 1e-3)) return;
  }
  cloud.normals = std::move(normals);
  std::erase_if(cloud.scalars, [](const PointScalar& scalar) {
    return std::find(kNormalNames.begin(), kNormalNames.end(), scalar.name) != kNormalNames.end();
  });
}

void read_points(const std::filesystem::path& path, const std::string& name, const LasHeader& header,
                 PointCloud& cloud) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(header.data_offset));
  const las::PointLayout& layout = las::point_layout(header.point_format);
  const std::size_t stride = header.record_length, per_block = std::max<std::size_t>(1, kBlockBytes / stride);
  std::vector<char> buffer(per_block * stride);
  for (std::size_t first = 0; first < cloud.size(); first += per_block) {
    const Block block{buffer.data(), stride, first, std::min(per_block, cloud.size() - first)};
    if (!file.read(buffer.data(), static_cast<std::streamsize>(block.count * stride)))
      throw Error("ingest", "point records cannot be read", {}, {},
                  {.file = name, .byte = static_cast<long long>(header.data_offset + first * stride)});
    take_positions(block, header, cloud);
    take_attributes(block, layout, cloud);
    for (std::size_t d = 0; d < header.extra_dimensions.size(); ++d)
      take_extra(block, header.extra_dimensions[d], cloud.scalars[d].values);
  }
}

}  // namespace

PointCloud read_las(const std::filesystem::path& path, const std::string& shown_as) {
  const std::string name = shown_as.empty() ? path.string() : shown_as;
  const LasHeader header = read_las_header(path, name);
  if (header.compressed)
    throw Error("ingest", "compressed points (LAZ) where plain LAS is expected", {}, {}, {.file = name, .byte = 104});
  PointCloud cloud = allocate(header);
  read_points(path, name, header, cloud);
  drop_unrecorded(cloud);
  if (header.generating_software != kLasSoftware) widen_colour(cloud.colour);
  gather_normals(cloud);
  return cloud;
}

}  // namespace scarp
