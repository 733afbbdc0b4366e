// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_las_header.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;
using las::load;

// Byte offsets of the public header block.
constexpr std::size_t kEncoding = 6, kMajor = 24, kMinor = 25, kSystem = 26, kSoftware = 58, kHeaderSize = 94,
                      kDataOffset = 96, kVlrCount = 100, kFormat = 104, kRecordLength = 105, kLegacyCount = 107,
                      kScale = 131, kOffset = 155, kBounds = 179, kEvlrStart = 235, kEvlrCount = 243, kCount = 247;

// No WKT or list of extra dimensions comes near this.
constexpr std::uint64_t kLargestPayload = 16u << 20;

/// A file with its size, whose reads name the byte when they fail.
class Source {
 public:
  Source(const fs::path& path, std::string name) : name_(std::move(name)) {
    std::error_code failure;
    if (!fs::is_regular_file(path, failure))
      throw Error("ingest", fs::exists(path, failure) ? "not a regular file" : "no such file", {}, {}, {name_});
    size_ = fs::file_size(path, failure);
    stream_.open(path, std::ios::binary);
    if (failure || !stream_) throw Error("ingest", "cannot be opened for reading", {}, {}, {name_});
  }

  std::uint64_t size() const { return size_; }

  /// @pre at + count <= size()
  std::string bytes(std::uint64_t at, std::uint64_t count) {
    std::string block(count, '\0');
    stream_.seekg(static_cast<std::streamoff>(at));
    if (!stream_.read(block.data(), static_cast<std::streamsize>(count))) fail(at, "cannot be read");
    return block;
  }

  [[noreturn]] void fail(std::uint64_t byte, const std::string& what, const std::string& value = {},
                         const std::string& allowed = {}) const {
    throw Error("ingest", what, value, allowed, {.file = name_, .byte = static_cast<long long>(byte)});
  }

 private:
  std::string name_;
  std::uint64_t size_ = 0;
  std::ifstream stream_;
};

std::size_t least_header(int minor) {
  return minor >= 4 ? las::kHeader14 : minor == 3 ? las::kHeader13 : las::kSmallestHeader;
}

/// The public header block: at least its 227 first bytes, at most 375.
std::string read_block(Source& file) {
  const std::string begin = file.bytes(0, std::min<std::uint64_t>(4, file.size()));
  if (begin != "LASF") file.fail(0, "not a LAS file: it does not begin with LASF");
  if (file.size() < las::kSmallestHeader)
    file.fail(file.size(), "truncated: the file ends inside its header", std::to_string(file.size()) + " bytes",
              "at least " + std::to_string(las::kSmallestHeader));
  std::string block = file.bytes(0, std::min<std::uint64_t>(las::kHeader14, file.size()));
  const int major = static_cast<unsigned char>(block[kMajor]), minor = static_cast<unsigned char>(block[kMinor]);
  if (major != 1 || minor > 4)
    file.fail(kMajor, "LAS version", std::to_string(major) + "." + std::to_string(minor), "1.0 to 1.4");
  const std::size_t stated = load<std::uint16_t>(&block[kHeaderSize]), least = least_header(minor);
  if (stated < least)
    file.fail(kHeaderSize, "header size", std::to_string(stated), "at least " + std::to_string(least));
  if (block.size() < least) file.fail(file.size(), "truncated: the file ends inside its header");
  return block;
}

void parse_point_record(const Source& file, const std::string& block, LasHeader& header) {
  const int bits = static_cast<unsigned char>(block[kFormat]);
  header.compressed = (bits & 0xC0) != 0;
  header.point_format = bits & 0x3F;
  if (header.point_format >= las::kFormats)
    file.fail(kFormat, "point format", std::to_string(header.point_format), "0 to 10");
  header.record_length = load<std::uint16_t>(&block[kRecordLength]);
  const int least = las::point_layout(header.point_format).length;
  if (header.record_length < static_cast<std::uint32_t>(least))
    file.fail(kRecordLength, "record length of point format " + std::to_string(header.point_format),
              std::to_string(header.record_length) + " bytes", "at least " + std::to_string(least));
}

void parse_frame(const Source& file, const std::string& block, LasHeader& header) {
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t scale_at = kScale + 8 * a, offset_at = kOffset + 8 * a;
    header.scale[a] = load<double>(&block[scale_at]);
    header.offset[a] = load<double>(&block[offset_at]);
    if (!std::isfinite(header.scale[a]) || header.scale[a] == 0)
      file.fail(scale_at, "coordinate scale", shortest(header.scale[a]), "finite and not zero");
    if (!std::isfinite(header.offset[a]))
      file.fail(offset_at, "coordinate offset", shortest(header.offset[a]), "finite");
    if (!std::isfinite(std::abs(header.scale[a]) * 2147483648.0 + std::abs(header.offset[a])))
      file.fail(scale_at, "coordinate scale", shortest(header.scale[a]), "one that keeps coordinates finite");
    header.bounds.max[a] = load<double>(&block[kBounds + 16 * a]);
    header.bounds.min[a] = load<double>(&block[kBounds + 16 * a + 8]);
  }
}

/// Point count, and how many of them the file can hold.
void parse_count(const Source& file, const std::string& block, LasHeader& header) {
  const std::uint64_t legacy = load<std::uint32_t>(&block[kLegacyCount]);
  header.count = legacy;
  if (header.version_minor >= 4) {
    header.count = load<std::uint64_t>(&block[kCount]);
    if (header.count == 0 && legacy > 0) {
      header.count = legacy;
      header.remarks.push_back("the 64-bit point count is 0; the 32-bit count " + std::to_string(legacy) + " is used");
    }
  }
  header.points_in_file = header.count;
  if (header.compressed) return;
  const std::uint64_t room = file.size() - header.data_offset;
  const std::uint64_t held = room / header.record_length;
  if (room == 0 && header.count > 0) {
    header.points_in_file = 0;
    header.remarks.push_back("the header promises " + std::to_string(header.count) +
                             " points, the file ends where they would begin");
  } else if (header.count > held) {
    file.fail(file.size(), "truncated: header promises " + std::to_string(header.count) + " points, the file holds " +
                               std::to_string(held));
  }
}

/// What the records after the header say.
struct Records {
  std::string wkt, geo_keys, extra_bytes;
};

/// Keeps the payload if it is one that is looked for and the first of its kind.
void keep_record(Source& file, Records& records, const std::string& head, std::uint64_t at, std::uint64_t length) {
  const char* user = &head[2];
  const auto id = load<std::uint16_t>(&head[18]);
  const bool projection = las::user_is(user, las::kProjectionUser);
  std::string* wanted = nullptr;
  if (projection && id == las::kWktRecord) wanted = &records.wkt;
  if (projection && id == las::kGeoKeyRecord) wanted = &records.geo_keys;
  if (las::user_is(user, las::kSpecUser) && id == las::kExtraBytesRecord) wanted = &records.extra_bytes;
  if (wanted == nullptr || !wanted->empty()) return;
  if (length > kLargestPayload)
    file.fail(at, "record " + std::to_string(id) + " of " + las::printable({user, 16}),
              std::to_string(length) + " bytes", "at most " + std::to_string(kLargestPayload));
  *wanted = file.bytes(at, length);
}

void read_vlrs(Source& file, const std::string& block, LasHeader& header, Records& records) {
  const std::uint64_t promised = load<std::uint32_t>(&block[kVlrCount]);
  std::uint64_t at = load<std::uint16_t>(&block[kHeaderSize]);
  const std::uint64_t room = (header.data_offset - at) / las::kVlrHeader;
  if (promised > room)
    file.fail(
        kVlrCount, "number of variable length records", std::to_string(promised),
        "at most " + std::to_string(room) + " before the points begin at byte " + std::to_string(header.data_offset));
  for (std::uint64_t i = 0; i < promised; ++i) {
    if (header.data_offset - at < las::kVlrHeader) {
      header.remarks.push_back("the header promises " + std::to_string(promised) + " variable length records, " +
                               std::to_string(i) + " stand before the points");
      return;
    }
    const std::string head = file.bytes(at, las::kVlrHeader);
    const std::uint64_t length = load<std::uint16_t>(&head[20]);
    if (length > header.data_offset - at - las::kVlrHeader)
      file.fail(at + 20, "length of variable length record " + std::to_string(i), std::to_string(length) + " bytes",
                "no more than stands before the points begin at byte " + std::to_string(header.data_offset));
    keep_record(file, records, head, at + las::kVlrHeader, length);
    at += las::kVlrHeader + length;
  }
}

void read_evlrs(Source& file, const std::string& block, const LasHeader& header, Records& records) {
  if (header.version_minor < 4) return;
  const std::uint64_t promised = load<std::uint32_t>(&block[kEvlrCount]);
  std::uint64_t at = load<std::uint64_t>(&block[kEvlrStart]);
  if (promised == 0) return;
  if (at < header.data_offset || at > file.size() || promised > (file.size() - at) / las::kEvlrHeader)
    file.fail(kEvlrStart, "truncated: header promises " + std::to_string(promised) + " extended records from byte " +
                              std::to_string(at) + ", the file has " + std::to_string(file.size()) + " bytes");
  for (std::uint64_t i = 0; i < promised; ++i) {
    if (file.size() - at < las::kEvlrHeader)
      file.fail(at, "truncated: the file ends inside extended record " + std::to_string(i));
    const std::string head = file.bytes(at, las::kEvlrHeader);
    const auto length = load<std::uint64_t>(&head[20]);
    if (length > file.size() - at - las::kEvlrHeader)
      file.fail(at + 20, "length of extended record " + std::to_string(i), std::to_string(length) + " bytes",
                "no more than the file holds");
    keep_record(file, records, head, at + las::kEvlrHeader, length);
    at += las::kEvlrHeader + length;
  }
}

void apply_records(const Source& file, Records records, LasHeader& header) {
  records.wkt.resize(records.wkt.find_last_not_of('\0') + 1);  // npos + 1 == 0
  header.crs = records.wkt.empty() ? las::epsg_of_geo_keys(records.geo_keys) : std::move(records.wkt);
  if (header.crs.empty() && !records.geo_keys.empty())
    header.remarks.push_back("the GeoTIFF keys name no EPSG code: the coordinate system is unknown");
  const auto first = static_cast<std::size_t>(las::point_layout(header.point_format).length);
  las::ExtraBytes extra = las::parse_extra_bytes(records.extra_bytes, first);
  if (extra.end > header.record_length)
    file.fail(kRecordLength, "record length", std::to_string(header.record_length) + " bytes",
              "at least " + std::to_string(extra.end) + ", which the described extra bytes need");
  header.extra_dimensions = std::move(extra.dimensions);
}

void check_bounds(LasHeader& header) {
  bool sane = header.points_in_file > 0;
  for (std::size_t a = 0; a < 3; ++a)
    sane = sane && is_finite(header.bounds.min) && is_finite(header.bounds.max) &&
           header.bounds.min[a] <= header.bounds.max[a];
  if (sane) return;
  if (header.points_in_file > 0) header.remarks.push_back("the header's bounds are not a box");
  header.bounds = Box3{};
}

}  // namespace

LasHeader read_las_header(const fs::path& path, const std::string& shown_as) {
  Source file(path, shown_as.empty() ? path.string() : shown_as);
  const std::string block = read_block(file);
  LasHeader header;
  header.version_major = block[kMajor];
  header.version_minor = block[kMinor];
  header.system_identifier = las::printable({&block[kSystem], 32});
  header.generating_software = las::printable({&block[kSoftware], 32});
  header.data_offset = load<std::uint32_t>(&block[kDataOffset]);
  const std::uint64_t size = load<std::uint16_t>(&block[kHeaderSize]);
  if (header.data_offset < size)
    file.fail(kDataOffset, "offset to the points", std::to_string(header.data_offset),
              "at least the header size " + std::to_string(size));
  if (header.data_offset > file.size())
    file.fail(file.size(), "truncated: the points should begin at byte " + std::to_string(header.data_offset));
  parse_point_record(file, block, header);
  parse_frame(file, block, header);
  Records records;
  read_vlrs(file, block, header, records);
  parse_count(file, block, header);
  read_evlrs(file, block, header, records);
  apply_records(file, std::move(records), header);
  check_bounds(header);
  return header;
}

}  // namespace scarp
