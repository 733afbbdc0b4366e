// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/las_format.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace scarp::las {
namespace {

constexpr std::array<PointLayout, kFormats> kLayouts{{
    {20, -1, -1, 15, 3},
    {28, 20, -1, 15, 3},
    {26, -1, 20, 15, 3},
    {34, 20, 28, 15, 3},
    {57, 20, -1, 15, 3},
    {63, 20, 28, 15, 3},
    {30, 22, -1, 16, 4},
    {36, 22, 30, 16, 4},
    {38, 22, 30, 16, 4},
    {59, 22, -1, 16, 4},
    {67, 22, 30, 16, 4},
}};

// Fields of an entry of the "extra bytes" record.
constexpr std::size_t kType = 2, kOptions = 3, kName = 4, kNoData = 40, kScale = 112, kOffset = 136, kText = 160;
constexpr int kHasNoData = 1, kHasScale = 8, kHasOffset = 16;

constexpr std::string_view kUnitPrefix = "unit: ";

// GeoTIFF 1.1, requirements class GeoKeyDirectory.
constexpr std::uint16_t kModelType = 1024, kRasterType = 1025, kGeographic = 2048, kProjected = 3072;
constexpr std::uint16_t kModelProjected = 1, kModelGeographic = 2, kUserDefined = 32767;

double raw_no_data(const char* from, int type) {
  // The specification widens no_data to 64 bits of the same kind.
  if (type >= 9) return load<double>(from);
  return type % 2 == 1 ? static_cast<double>(load<std::uint64_t>(from)) : static_cast<double>(load<std::int64_t>(from));
}

}  // namespace

const PointLayout& point_layout(int format) { return kLayouts[static_cast<std::size_t>(format)]; }

std::size_t extra_type_size(int type) {
  constexpr std::array<std::size_t, 11> sizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

ExtraBytes parse_extra_bytes(std::string_view payload, std::size_t first) {
  ExtraBytes extra;
  extra.end = first;
  for (std::size_t entry = 0; entry + kExtraDescriptor <= payload.size(); entry += kExtraDescriptor) {
    const char* field = payload.data() + entry;
    const int stated = static_cast<unsigned char>(field[kType]);
    const int options = static_cast<unsigned char>(field[kOptions]);
    if (stated == 0 || stated > 30) {  // bytes without a meaning; the options field is their number
      extra.end += static_cast<std::size_t>(options);
      continue;
    }
    const int elements = (stated - 1) / 10 + 1;  // types 11-20 are pairs, 21-30 triples
    ExtraDimension dimension;
    dimension.type = (stated - 1) % 10 + 1;
    std::string name = printable({field + kName, 32});
    if (name.empty()) name = "extra_" + std::to_string(entry / kExtraDescriptor);
    const std::string text = printable({field + kText, 32});
    if (text.starts_with(kUnitPrefix)) dimension.unit = text.substr(kUnitPrefix.size());
    for (int e = 0; e < elements; ++e) {
      const std::size_t eighth = 8 * static_cast<std::size_t>(e);
      dimension.name = elements == 1 ? name : name + std::to_string(e);
      dimension.at = extra.end;
      dimension.scale = (options & kHasScale) ? load<double>(field + kScale + eighth) : 1;
      dimension.offset = (options & kHasOffset) ? load<double>(field + kOffset + eighth) : 0;
      dimension.no_data.reset();
      if (options & kHasNoData) dimension.no_data = raw_no_data(field + kNoData + eighth, dimension.type);
      extra.end += extra_type_size(dimension.type);
      extra.dimensions.push_back(dimension);
    }
  }
  return extra;
}

void append_double_descriptor(std::string& payload, const std::string& name, const std::string& unit) {
  std::array<char, kExtraDescriptor> field{};
  field[kType] = 10;
  field[kOptions] = kHasNoData;
  store(field.data() + kNoData, std::nan(""));
  std::memcpy(field.data() + kName, name.data(), name.size());
  const std::string text = unit.empty() ? std::string() : std::string(kUnitPrefix) + unit;
  std::memcpy(field.data() + kText, text.data(), text.size());
  payload.append(field.data(), field.size());
}

std::string epsg_of_geo_keys(std::string_view directory) {
  if (directory.size() < 8) return {};
  const std::size_t room = directory.size() / 8 - 1;
  const std::size_t stated = load<std::uint16_t>(directory.data() + 6);
  std::uint16_t model = 0, geographic = 0, projected = 0;
  for (std::size_t k = 1; k <= std::min(room, stated); ++k) {
    const char* key = directory.data() + 8 * k;
    if (load<std::uint16_t>(key + 2) != 0) continue;  // the value stands in another record: not a code
    const auto value = load<std::uint16_t>(key + 6);
    switch (load<std::uint16_t>(key)) {
      case kModelType:
        model = value;
        break;
      case kGeographic:
        geographic = value;
        break;
      case kProjected:
        projected = value;
        break;
      default:
        break;
    }
  }
  // With a user-defined projection the geographic code is only its base: naming it would turn metres into degrees.
  const std::uint16_t code = projected != 0 || model == kModelProjected ? projected : geographic;
  return code == 0 || code == kUserDefined ? std::string() : "EPSG:" + std::to_string(code);
}

std::string geo_keys_of_epsg(std::uint16_t code, bool geographic) {
  using Key = std::array<std::uint16_t, 4>;       // key, where the value stands (0: here), count, value
  const std::array<Key, 4> keys{Key{1, 1, 0, 3},  // version, revision, minor revision, number of keys
                                Key{kModelType, 0, 1, geographic ? kModelGeographic : kModelProjected},
                                Key{kRasterType, 0, 1, 1}, Key{geographic ? kGeographic : kProjected, 0, 1, code}};
  return {reinterpret_cast<const char*>(keys.data()), sizeof keys};
}

std::optional<std::uint16_t> epsg_code(std::string_view crs) {
  constexpr std::string_view authority = "EPSG:";
  if (!crs.starts_with(authority)) return std::nullopt;
  const std::string_view digits = crs.substr(authority.size());
  std::uint16_t code = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), code);
  if (failure != std::errc() || end != digits.data() + digits.size() || code == 0 || code == kUserDefined)
    return std::nullopt;
  return code;
}

std::string printable(std::string_view field) {
  std::string text(field.substr(0, field.find('\0')));
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool user_is(const char* field16, std::string_view id) {
  const std::string_view field(field16, 16);
  return field.substr(0, field.find('\0')) == id;
}

}  // namespace scarp::las
