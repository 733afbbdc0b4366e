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
