// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The seal at the end of our binary files. The HDF5 library trusts what it parses, so a damaged file can crash
// it; the seal tells a whole file from a damaged one before the library sees a byte. HDF5 readers ignore what
// stands behind the end of the HDF5 data, so the files stay ordinary HDF5 files for everyone else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace scarp {

/// A 64-bit checksum in the manner of FNV-1a, eight bytes at a time: any change within one word alters it.
class Checksum {
 public:
  /// Every call but the last must add a multiple of eight bytes.
  void add(std::string_view bytes);
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Appends 24 bytes: "SCARPEND", the length before them and the checksum over it, both little-endian.
void append_seal(std::string& bytes);
/// The same of a file, which it reads once. @throws Error ("store") if the disk refuses, naming the path `shown`.
void seal_file(const std::filesystem::path& path, const std::filesystem::path& shown);

/// Reads the whole file once. @throws Error ("store") if it cannot be read, or is cut off, altered, or not ours.
void check_seal(const std::filesystem::path& path);

}  // namespace scarp
