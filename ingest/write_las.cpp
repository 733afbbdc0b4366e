// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/write_las.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "ingest/las_format.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"

namespace scarp {
namespace {

using las::store;

constexpr std::size_t kPointsPerBlock = 8192;
constexpr double kLargestInt = 2147483647.0;
// A name that fills its field needs no NUL; the unit shares its field with the prefix "unit: ".
constexpr std::size_t kLongestName = 32, kLongestUnit = 26, kLongestPayload = 65535;

[[noreturn]] void refuse(const std::string& what, const std::string& value = {}, const std::string& allowed = {}) {
  throw Error("write", what, value, allowed);
}

/// The integers that stand for the coordinates: X = round((p + origin - offset) / scale).
struct Quantization {
  double per_metre = 1e6;                       ///< exact, unlike its inverse the scale
  Vec3 shift{0, 0, 0};                          ///< origin - offset, m
  std::array<std::int64_t, 3> offset{0, 0, 0};  ///< m
  std::array<std::int32_t, 3> least{0, 0, 0}, largest{0, 0, 0};

  double scale() const { return 1 / per_metre; }
  std::int32_t operator()(double position, std::size_t a) const {
    return static_cast<std::int32_t>(std::nearbyint((position + shift[a]) * per_metre));
  }
};

/// Everything that is decided before the first byte is written.
struct Plan {
  int format = 6;
  std::size_t record_length = 0;
  Quantization quantization;
  std::string records;  ///< the variable length records
  std::uint32_t number_of_records = 0;
  bool wkt_bit = true;
  std::array<std::uint64_t, 15> by_return{};
};

void check_lengths(const PointCloud& cloud) {
  for_each_attribute(cloud, [&](const auto& values) {
    if (!values.empty() && values.size() != cloud.size())
      refuse("a point attribute has another length than the positions", std::to_string(values.size()),
             std::to_string(cloud.size()));
  });
}

void check_scalars(const PointCloud& cloud) {
  const std::size_t most = kLongestPayload / las::kExtraDescriptor - (cloud.normals.empty() ? 0 : 3);
  if (cloud.scalars.size() > most)
    refuse("scalars per point in a LAS file", std::to_string(cloud.scalars.size()), "at most " + std::to_string(most));
  for (const PointScalar& scalar : cloud.scalars) {
    if (scalar.name.empty() || scalar.name.size() > kLongestName)
      refuse("length of a scalar's name in a LAS file", "\"" + scalar.name + "\"", "1 to 32 bytes");
    if (scalar.unit.size() > kLongestUnit)
      refuse("length of the unit of " + scalar.name + " in a LAS file", "\"" + scalar.unit + "\"", "at most 26 bytes");
    if (scalar.values.size() != cloud.size())
      refuse("values of " + scalar.name, std::to_string(scalar.values.size()), std::to_string(cloud.size()));
  }
}

Quantization quantize(const PointCloud& cloud) {
  Quantization q;
  if (cloud.empty()) return q;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!is_finite(cloud.positions[i])) refuse("position of point " + std::to_string(i), "not finite");
  const Box3 box = bounds(cloud.positions);
  double reach = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double middle = std::floor(0.5 * box.min[a] + 0.5 * box.max[a] + cloud.site.origin[a]);
    if (!(std::abs(middle) < 9e15)) refuse("coordinate in a LAS file", shortest(middle), "within 9e15 of zero");
    q.offset[a] = static_cast<std::int64_t>(middle);
    q.shift[a] = cloud.site.origin[a] - middle;
    reach = std::max({reach, std::abs(box.min[a] + q.shift[a]), std::abs(box.max[a] + q.shift[a])});
  }
  while (q.per_metre > 1e3 && std::nearbyint(reach * q.per_metre) > kLargestInt) q.per_metre /= 10;
  if (std::nearbyint(reach * q.per_metre) > kLargestInt)
    refuse("extent of a cloud in a LAS file with a scale of 0.001 m", "+-" + shortest(reach) + " m about its middle",
           "at most +-2147483.647 m");
  for (std::size_t a = 0; a < 3; ++a) {
    q.least[a] = q(box.min[a], a);
    q.largest[a] = q(box.max[a], a);
  }
  return q;
}

std::uint8_t value_or(const std::vector<std::uint8_t>& values, std::size_t i, std::uint8_t otherwise) {
  return values.empty() ? otherwise : values[i];
}

/// Counts the returns; false if formats 0 to 3 cannot hold the classes or returns.
bool count_returns(const PointCloud& cloud, Plan& plan) {
  bool small = true;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const int number = value_or(cloud.return_number, i, 1), of = value_or(cloud.number_of_returns, i, 1);
    if (number > 15 || of > 15)
      refuse("return of point " + std::to_string(i) + " in a LAS file",
             std::to_string(number) + " of " + std::to_string(of), "at most 15 of 15");
    small = small && number <= 7 && of <= 7 && value_or(cloud.classification, i, 0) <= 31;
    if (number > 0) ++plan.by_return[static_cast<std::size_t>(number - 1)];
  }
  return small;
}

void append_record(Plan& plan, std::string_view user, std::uint16_t id, std::string_view text,
                   const std::string& payload) {
  std::array<char, las::kVlrHeader> head{};
  std::copy(user.begin(), user.end(), &head[2]);
  store(&head[18], id);
  store(&head[20], static_cast<std::uint16_t>(payload.size()));
  std::copy(text.begin(), text.end(), &head[22]);
  plan.records.append(head.data(), head.size()).append(payload);
  ++plan.number_of_records;
}

bool within_degrees(const PointCloud& cloud) {
  const Box3 box = bounds(cloud.positions);
  const Vec3 low = box.min + cloud.site.origin, high = box.max + cloud.site.origin;
  return low[0] >= -180 && high[0] <= 180 && low[1] >= -90 && high[1] <= 90;
}

void choose_format(const PointCloud& cloud, bool small, Plan& plan) {
  const bool keys = las::epsg_code(cloud.site.crs).has_value();
  if (keys && small) {
    plan.format = (cloud.gps_time.empty() ? 0 : 1) + (cloud.colour.empty() ? 0 : 2);
    plan.wkt_bit = false;
  } else {
    // Readers refuse formats 6-10 without the WKT bit, even where there is no WKT.
    plan.format = cloud.colour.empty() ? 6 : 7;
    plan.wkt_bit = true;
  }
}

void append_crs(const PointCloud& cloud, Plan& plan) {
  const std::string& crs = cloud.site.crs;
  if (crs.empty()) return;
  if (const std::optional<std::uint16_t> code = las::epsg_code(crs)) {
    const bool geographic = *code >= 4000 && *code <= 4999 && !cloud.empty() && within_degrees(cloud);
    append_record(plan, las::kProjectionUser, las::kGeoKeyRecord, "GeoTIFF keys",
                  las::geo_keys_of_epsg(*code, geographic));
    return;
  }
  if (crs.find('[') == std::string::npos)
    refuse("coordinate reference system in a LAS file", "\"" + crs.substr(0, 80) + "\"", "WKT or EPSG:n");
  if (crs.size() + 1 > kLongestPayload)
    refuse("length of the WKT in a LAS file", std::to_string(crs.size()) + " bytes", "at most 65534");
  append_record(plan, las::kProjectionUser, las::kWktRecord, "WKT", crs + '\0');
}

void append_extra_bytes(const PointCloud& cloud, Plan& plan) {
  std::string payload;
  if (!cloud.normals.empty())
    for (std::string_view name : kNormalNames) las::append_double_descriptor(payload, std::string(name), {});
  for (const PointScalar& scalar : cloud.scalars) las::append_double_descriptor(payload, scalar.name, scalar.unit);
  plan.record_length = static_cast<std::size_t>(las::point_layout(plan.format).length) +
                       sizeof(double) * (payload.size() / las::kExtraDescriptor);
  if (!payload.empty()) append_record(plan, las::kSpecUser, las::kExtraBytesRecord, "extra bytes", payload);
}

Plan make_plan(const PointCloud& cloud) {
  check_lengths(cloud);
  check_scalars(cloud);
  Plan plan;
  plan.quantization = quantize(cloud);
  choose_format(cloud, count_returns(cloud, plan), plan);
  append_crs(cloud, plan);
  append_extra_bytes(cloud, plan);
  return plan;
}

/// Seconds of a GPS week stay below this; adjusted standard times do so only within a week of September 2011.
bool in_gps_week(const std::vector<double>& times) {
  return std::none_of(times.begin(), times.end(), [](double t) { return t < 0 || t > 604800; });
}

std::string header_bytes(const PointCloud& cloud, const Plan& plan) {
  std::string block(las::kHeader14, '\0');
  const Quantization& q = plan.quantization;
  block.replace(0, 4, "LASF");
  store(&block[6],
        static_cast<std::uint16_t>((plan.wkt_bit ? las::kWktBit : 0) | (in_gps_week(cloud.gps_time) ? 0 : 1)));
  block[24] = 1;
  block[25] = 4;
  block.replace(26, 5, "OTHER");
  block.replace(58, kLasSoftware.size(), kLasSoftware);
  store(&block[94], static_cast<std::uint16_t>(las::kHeader14));
  store(&block[96], static_cast<std::uint32_t>(las::kHeader14 + plan.records.size()));
  store(&block[100], plan.number_of_records);
  block[104] = static_cast<char>(plan.format);
  store(&block[105], static_cast<std::uint16_t>(plan.record_length));
  // The 32-bit counts stand only for formats 0-5, and are 0 where they cannot hold the number.
  if (plan.format < 6 && cloud.size() <= 0xFFFFFFFFu) {
    store(&block[107], static_cast<std::uint32_t>(cloud.size()));
    for (std::size_t r = 0; r < 5; ++r) store(&block[111 + 4 * r], static_cast<std::uint32_t>(plan.by_return[r]));
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const double offset = static_cast<double>(q.offset[a]);
    store(&block[131 + 8 * a], q.scale());
    store(&block[155 + 8 * a], offset);
    store(&block[179 + 16 * a], q.largest[a] * q.scale() + offset);
    store(&block[187 + 16 * a], q.least[a] * q.scale() + offset);
  }
  store(&block[247], static_cast<std::uint64_t>(cloud.size()));
  for (std::size_t r = 0; r < plan.by_return.size(); ++r) store(&block[255 + 8 * r], plan.by_return[r]);
  return block;
}

void fill_record(const PointCloud& cloud, const Plan& plan, std::size_t i, char* record) {
  const las::PointLayout& layout = las::point_layout(plan.format);
  for (std::size_t a = 0; a < 3; ++a) store(record + 4 * a, plan.quantization(cloud.positions[i][a], a));
  if (!cloud.intensity.empty()) store(record + 12, cloud.intensity[i]);
  const int number = value_or(cloud.return_number, i, 1), of = value_or(cloud.number_of_returns, i, 1);
  record[14] = static_cast<char>(number | (of << layout.return_bits));
  record[layout.classification] = static_cast<char>(value_or(cloud.classification, i, 0));
  if (layout.gps_time >= 0 && !cloud.gps_time.empty()) store(record + layout.gps_time, cloud.gps_time[i]);
  if (layout.colour >= 0) std::memcpy(record + layout.colour, cloud.colour[i].data(), sizeof(Rgb16));
  char* extra = record + layout.length;
  if (!cloud.normals.empty()) {
    std::memcpy(extra, cloud.normals[i].data(), sizeof(Vec3));
    extra += sizeof(Vec3);
  }
  for (const PointScalar& scalar : cloud.scalars) {
    store(extra, scalar.values[i]);
    extra += sizeof(double);
  }
}

void write_file(const std::filesystem::path& path, const PointCloud& cloud, const Plan& plan) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  const std::string header = header_bytes(cloud, plan);
  file.write(header.data(), static_cast<std::streamsize>(header.size()));
  file.write(plan.records.data(), static_cast<std::streamsize>(plan.records.size()));
  std::vector<char> buffer;
  for (std::size_t first = 0; first < cloud.size() && file; first += kPointsPerBlock) {
    const std::size_t count = std::min(kPointsPerBlock, cloud.size() - first);
    buffer.assign(count * plan.record_length, 0);
    for (std::size_t i = 0; i < count; ++i) fill_record(cloud, plan, first + i, buffer.data() + i * plan.record_length);
    file.write(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  }
  file.close();
  if (!file) refuse("cannot write " + path.string());
}

}  // namespace

void write_las(const std::filesystem::path& path, const PointCloud& cloud) {
  const Plan plan = make_plan(cloud);
  write_whole(path, [&](const std::filesystem::path& temporary) { write_file(temporary, cloud, plan); });
}

}  // namespace scarp
