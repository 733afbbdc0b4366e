// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"

namespace scarp::test {

/// A file's content, put together number by number.
class Bytes {
 public:
  explicit Bytes(std::string_view text = {}) : bytes_(text) {}

  template <class T>
  Bytes& little(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }
  template <class T>
  Bytes& big(T value) {
    const std::size_t start = bytes_.size();
    little(value);
    std::reverse(bytes_.begin() + static_cast<std::ptrdiff_t>(start), bytes_.end());
    return *this;
  }
  Bytes& text(std::string_view more) {
    bytes_ += more;
    return *this;
  }
  const std::string& string() const { return bytes_; }

 private:
  std::string bytes_;
};

/// What can be changed of the GeoTIFF sample.
struct TiffChanges {
  double pixel_height = 2;
  std::uint16_t epsg = 25832;
  std::uint16_t bands = 1;
  float last = 4;
  bool georeferenced = true;
};

/// A GeoTIFF of 2 x 2 floats (from the north-west: 1, 2, no data, 4) with cells of 2 m; the outer corner in the
/// north-west is at (500000, 5400004).
inline std::string geotiff_sample(const TiffChanges& change = {}) {
  constexpr std::uint32_t pixels = 182, scale = 198, tie = 222, keys = 270;
  Bytes file(std::string_view("II*\0", 4));
  file.little(std::uint32_t{8}).little(std::uint16_t{14});
  const auto tag = [&](std::uint16_t id, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
    file.little(id).little(type).little(count).little(value);
  };
  tag(256, 3, 1, 2 / change.bands), tag(257, 3, 1, 2);
  tag(258, 3, 1, 32), tag(259, 3, 1, 1), tag(262, 3, 1, 1), tag(273, 4, 1, pixels);
  tag(277, 3, 1, change.bands), tag(278, 3, 1, 2), tag(279, 4, 1, 16), tag(339, 3, 1, 3);
  if (change.georeferenced)
    tag(33550, 12, 3, scale), tag(33922, 12, 6, tie), tag(34735, 3, 16, keys);
  else  // private tags instead
    tag(65000, 12, 3, scale), tag(65001, 12, 6, tie), tag(65002, 3, 16, keys);
  if (change.georeferenced)
    tag(42113, 2, 3, 0x00392D);  // "-9"
  else
    tag(65003, 2, 3, 0x00392D);
  file.little(std::uint32_t{0});
  file.little(1.f).little(2.f).little(-9.f).little(change.last);
  file.little(2.0).little(change.pixel_height).little(0.0);
  for (double v : {0.0, 0.0, 0.0, 500000.0, 5400004.0, 0.0}) file.little(v);
  const std::uint16_t model = change.epsg == 4326 ? 2 : 1, key = change.epsg == 4326 ? 2048 : 3072;
  for (int v : {1, 1, 0, 3, 1024, 0, 1, int(model), 1025, 0, 1, 1, int(key), 0, 1, int(change.epsg)})
    file.little(static_cast<std::uint16_t>(v));
  return file.string();
}

/// Files of given content in a folder that goes with the object.
class Files {
 public:
  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    const auto path = folder_.path() / name;
    std::filesystem::remove(path);  // some file systems sync a file that is cut and written again
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

/// The message of the Error that f() throws; a test failure if it throws none.
template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_EQ(error.stage(), "ingest");
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// An LZF encoder, slow and plain: the longest earlier match of three bytes and more, else a literal.
inline std::string compress_lzf(std::string_view in) {
  std::string out, literals;
  const auto flush = [&] {
    for (std::size_t i = 0; i < literals.size(); i += 32) {
      const std::string_view run = std::string_view(literals).substr(i, 32);
      out += static_cast<char>(run.size() - 1);
      out += run;
    }
    literals.clear();
  };
  for (std::size_t at = 0; at < in.size();) {
    std::size_t best = 0, distance = 0;
    for (std::size_t back = 1; back <= std::min<std::size_t>(at, 8192); ++back) {
      std::size_t length = 0;
      while (length < 264 && at + length < in.size() && in[at + length] == in[at + length - back]) ++length;
      if (length > best) best = length, distance = back;
    }
    if (best < 3) {
      literals += in[at++];
      continue;
    }
    flush();
    const std::size_t length = best - 2, offset = distance - 1;
    out += static_cast<char>(std::min<std::size_t>(length, 7) << 5 | offset >> 8);
    if (length >= 7) out += static_cast<char>(length - 7);
    out += static_cast<char>(offset & 255);
    at += best;
  }
  flush();
  return out;
}

struct Sample {
  std::string name;  ///< with the extension that its reader expects
  std::string bytes;
};

/// A small valid file of every variant that is read; defined in damaged_files_test.cpp.
std::vector<Sample> format_samples();

}  // namespace scarp::test
