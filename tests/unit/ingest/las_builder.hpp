// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LAS files put together byte by byte from the specification's tables, on its own: it shares no constant with the
// reader under test.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace scarp::test {

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(&bytes[at], &value, sizeof value);
}

struct LasPoint {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t intensity = 0;
  int number = 1, of = 1, classification = 0, flags = 0;
  double gps_time = 0;
  std::uint16_t red = 0, green = 0, blue = 0;
  std::string extra = {};
};

struct LasRecord {
  std::string user;
  std::uint16_t id;
  std::string payload;
};

struct LasBuilder {
  int minor = 2, format = 0;
  std::string software = "test";
  double scale[3] = {0.01, 0.02, 0.5}, offset[3] = {1000, -2000, 30};
  std::vector<LasPoint> points;
  std::vector<LasRecord> records, extended;

  static bool has_time(int f) { return f == 1 || f >= 3; }
  static bool has_colour(int f) { return f == 2 || f == 3 || f == 5 || f == 7 || f == 8 || f == 10; }

  /// One point record, field after field in the order of the specification.
  std::string record(const LasPoint& p) const {
    std::string r;
    const auto add = [&r](auto value) { r.append(reinterpret_cast<const char*>(&value), sizeof value); };
    add(p.x), add(p.y), add(p.z), add(p.intensity);
    if (format < 6) {
      add(static_cast<std::uint8_t>(p.number | p.of << 3));
      add(static_cast<std::uint8_t>(p.classification | p.flags << 5));
      add(std::int8_t{-7}), add(std::uint8_t{200}), add(std::uint16_t{77});  // angle, user data, source
    } else {
      add(static_cast<std::uint8_t>(p.number | p.of << 4));
      add(static_cast<std::uint8_t>(p.flags));
      add(static_cast<std::uint8_t>(p.classification));
      add(std::uint8_t{200}), add(std::int16_t{-700}), add(std::uint16_t{77});  // user data, angle, source
    }
    if (has_time(format)) add(p.gps_time);
    if (has_colour(format)) add(p.red), add(p.green), add(p.blue);
    if (format == 8 || format == 10) add(std::uint16_t{999});                                  // near infrared
    if (format == 4 || format == 5 || format == 9 || format == 10) r += std::string(29, 'w');  // wave packet
    return r + p.extra;
  }

  std::size_t header_size() const { return minor >= 4 ? 375 : minor == 3 ? 235 : 227; }

  std::size_t data_offset() const {
    std::size_t at = header_size();
    for (const LasRecord& v : records) at += 54 + v.payload.size();
    return at;
  }

  std::string bytes() const {
    std::string file(header_size(), '\0');
    file.replace(0, 4, "LASF");
    file[24] = 1;
    file[25] = static_cast<char>(minor);
    file.replace(58, software.size(), software);
    put(file, 94, static_cast<std::uint16_t>(header_size()));
    put(file, 96, static_cast<std::uint32_t>(data_offset()));
    put(file, 100, static_cast<std::uint32_t>(records.size()));
    file[104] = static_cast<char>(format);
    put(file, 105, static_cast<std::uint16_t>(record(points.empty() ? LasPoint{} : points[0]).size()));
    if (format < 6 || minor < 4) put(file, 107, static_cast<std::uint32_t>(points.size()));
    for (std::size_t a = 0; a < 3; ++a) {
      put(file, 131 + 8 * a, scale[a]);
      put(file, 155 + 8 * a, offset[a]);
      put(file, 179 + 16 * a, offset[a] + 1000);
      put(file, 187 + 16 * a, offset[a] - 1000);
    }
    if (minor >= 4) put(file, 247, static_cast<std::uint64_t>(points.size()));
    for (const LasRecord& v : records) file += with_head<std::uint16_t>(v);
    for (const LasPoint& p : points) file += record(p);
    if (minor >= 4 && !extended.empty()) {
      put(file, 235, static_cast<std::uint64_t>(file.size()));
      put(file, 243, static_cast<std::uint32_t>(extended.size()));
      for (const LasRecord& v : extended) file += with_head<std::uint64_t>(v);
    }
    return file;
  }

  template <class Length>
  static std::string with_head(const LasRecord& v) {
    std::string head(20 + sizeof(Length) + 32, '\0');
    head.replace(2, v.user.size(), v.user);
    put(head, 18, v.id);
    put(head, 20, static_cast<Length>(v.payload.size()));
    return head + v.payload;
  }
};

/// One entry of the "extra bytes" record.
struct LasExtra {
  int type;
  std::string name;
  double scale = 1, offset = 0;
  std::string no_data = {};  ///< its 8 bytes, or none
  std::string text = {};

  std::string bytes() const {
    std::string entry(192, '\0');
    entry[2] = static_cast<char>(type);
    entry[3] = static_cast<char>((no_data.empty() ? 0 : 1) | (scale != 1 ? 8 : 0) | (offset != 0 ? 16 : 0));
    entry.replace(4, name.size(), name);
    entry.replace(40, no_data.size(), no_data);
    for (std::size_t e = 0; e < 3; ++e) put(entry, 112 + 8 * e, scale), put(entry, 136 + 8 * e, offset);
    entry.replace(160, text.size(), text);
    return entry;
  }
};

/// A GeoTIFF key directory of (key, value) pairs.
inline std::string geo_keys(const std::vector<std::pair<int, int>>& keys) {
  std::string directory(8 + 8 * keys.size(), '\0');
  put(directory, 0, std::uint16_t{1});
  put(directory, 2, std::uint16_t{1});
  put(directory, 6, static_cast<std::uint16_t>(keys.size()));
  for (std::size_t k = 0; k < keys.size(); ++k) {
    put(directory, 8 + 8 * k, static_cast<std::uint16_t>(keys[k].first));
    put(directory, 12 + 8 * k, std::uint16_t{1});
    put(directory, 14 + 8 * k, static_cast<std::uint16_t>(keys[k].second));
  }
  return directory;
}

inline std::filesystem::path save(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

/// A file in memory with a path of its own: thousands of rewrites would make a busy disk the slowest part of a test.
class MemoryFile {
 public:
  MemoryFile() : number_(::memfd_create("las", MFD_CLOEXEC)) {}
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path hold(const std::string& bytes) const {
    if (::ftruncate(number_, 0) != 0 ||
        ::pwrite(number_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("no memory for a test file");
    return "/proc/self/fd/" + std::to_string(number_);
  }

 private:
  int number_;
};

inline std::string load_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace scarp::test
