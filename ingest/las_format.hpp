// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of LAS 1.0-1.4 as the ASPRS specification (LAS 1.4 R15) lays them out: what the reader and the writer
// share. Pure functions over bytes; no file is touched here. Multi-byte values are little-endian.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp::las {

static_assert(std::endian::native == std::endian::little, "LAS fields are copied without swapping bytes");

template <class T>
T load(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class T>
void store(char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

inline constexpr std::size_t kSmallestHeader = 227;   ///< versions 1.0 to 1.2
inline constexpr std::size_t kHeader13 = 235;         ///< version 1.3
inline constexpr std::size_t kHeader14 = 375;         ///< version 1.4
inline constexpr std::size_t kVlrHeader = 54;         ///< variable length record, before its payload
inline constexpr std::size_t kEvlrHeader = 60;        ///< extended variable length record, before its payload
inline constexpr std::size_t kExtraDescriptor = 192;  ///< one entry of the "extra bytes" record
inline constexpr std::uint16_t kWktBit = 16;          ///< in the global encoding: the CRS is WKT
inline constexpr int kFormats = 11;                   ///< point formats 0 to 10
inline constexpr char kProjectionUser[] = "LASF_Projection";
inline constexpr char kSpecUser[] = "LASF_Spec";
inline constexpr std::uint16_t kWktRecord = 2112;
inline constexpr std::uint16_t kGeoKeyRecord = 34735;
inline constexpr std::uint16_t kExtraBytesRecord = 4;

/// Where the fields of a point record stand, in bytes from its start; -1: the format does not have it.
struct PointLayout {
  int length;  ///< least record length; what follows is "extra bytes"
  int gps_time;
  int colour;
  int classification;
  int return_bits;  ///< width of the return number and of the number of returns in byte 14
};

/// @param format 0 to 10
const PointLayout& point_layout(int format);

/// One number per point that the "extra bytes" record describes. An entry for arrays gives several.
struct ExtraDimension {
  std::string name;
  std::string unit;    ///< from a description "unit: ..." as write_las writes it; else empty
  int type = 0;        ///< 1 u8, 2 i8, 3 u16, 4 i16, 5 u32, 6 i32, 7 u64, 8 i64, 9 float, 10 double
  std::size_t at = 0;  ///< byte in the point record
  double scale = 1, offset = 0;
  std::optional<double> no_data;  ///< raw value, before scale and offset
};

/// Bytes of a value of type 1 to 10 (see ExtraDimension).
std::size_t extra_type_size(int type);

/// The dimensions described by the payload of an "extra bytes" record, and the record length they need.
/// @param first byte of the point record where the extra bytes begin
struct ExtraBytes {
  std::vector<ExtraDimension> dimensions;
  std::size_t end = 0;
};
ExtraBytes parse_extra_bytes(std::string_view payload, std::size_t first);

/// One 192-byte entry for a double, NaN meaning no data.
/// @pre name and unit fit (see write_las)
void append_double_descriptor(std::string& payload, const std::string& name, const std::string& unit);

/// "EPSG:n" from a GeoTIFF key directory: the projected system, else the geographic one; empty if the directory
/// names none (user-defined, or damaged).
std::string epsg_of_geo_keys(std::string_view directory);

/// A key directory for EPSG:n.
std::string geo_keys_of_epsg(std::uint16_t code, bool geographic);

/// n of "EPSG:n" with n in 1..65535 except 32767 (which means user-defined in a key directory).
std::optional<std::uint16_t> epsg_code(std::string_view crs);

/// Text of a fixed field up to its first NUL, other than printable ASCII replaced by '?', right blanks cut.
std::string printable(std::string_view field);

/// Does a fixed user-id field hold this id?
bool user_is(const char* field16, std::string_view id);

}  // namespace scarp::las
