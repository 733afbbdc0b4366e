// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/sealed_store.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::string_view kMark = "SCARPEND";
constexpr std::size_t kSealSize = 24;

std::uint64_t little_endian(const char* bytes) {
  std::uint64_t word = 0;
  for (int i = 7; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[i]);
  return word;
}

void append_little_endian(std::string& bytes, std::uint64_t word) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(word >> (8 * i) & 0xff));
}

std::string seal_of(std::uint64_t length, const Checksum& sum) {
  std::string seal(kMark);
  append_little_endian(seal, length);
  append_little_endian(seal, sum.value());
  return seal;
}

/// Of the first `length` bytes.
Checksum checksum_of(std::istream& in, std::uint64_t length, const SourceLocation& where) {
  Checksum sum;
  std::vector<char> block(std::size_t{1} << 20);
  in.seekg(0);
  for (std::uint64_t done = 0; done < length;) {
    const std::size_t part = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), length - done));
    in.read(block.data(), static_cast<std::streamsize>(part));
    if (!in) throw Error("store", "cannot read the file", std::strerror(errno), {}, where);
    sum.add({block.data(), part});
    done += part;
  }
  return sum;
}

}  // namespace

void Checksum::add(std::string_view bytes) {
  constexpr std::uint64_t prime = 0x100000001b3u;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    value_ = (value_ ^ little_endian(bytes.data() + i)) * prime;
    value_ ^= value_ >> 32;  // the product alone never carries a high bit downwards
  }
  for (; i < bytes.size(); ++i) value_ = (value_ ^ static_cast<unsigned char>(bytes[i])) * prime;
}

void append_seal(std::string& bytes) {
  Checksum sum;
  sum.add(bytes);
  bytes += seal_of(bytes.size(), sum);
}

void seal_file(const std::filesystem::path& path, const std::filesystem::path& shown) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const std::uint64_t length = std::filesystem::file_size(path);
  const Checksum sum = checksum_of(file, length, {shown.string()});
  file.seekp(0, std::ios::end);
  file << seal_of(length, sum) << std::flush;
  if (!file) throw Error("store", "cannot complete the file", std::strerror(errno), {}, {shown.string()});
}

void check_seal(const std::filesystem::path& path) {
  const SourceLocation where{path.string()};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error("store", "this is a folder, not a file", {}, {}, where);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("store", "cannot open the file", std::strerror(errno), {}, where);
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  const char* const whole = "a whole file that scarp wrote and nothing changed since";

  char seal[kSealSize];
  if (size < static_cast<std::streamoff>(kSealSize))
    throw Error("store", "the file is too short", std::to_string(size) + " bytes", whole, where);
  const std::uint64_t length = static_cast<std::uint64_t>(size) - kSealSize;
  in.seekg(static_cast<std::streamoff>(length));
  in.read(seal, kSealSize);
  if (!in) throw Error("store", "cannot read the file", std::strerror(errno), {}, where);
  if (std::string_view(seal, kMark.size()) != kMark || little_endian(seal + 8) != length)
    throw Error("store", "the file does not end with the seal of a scarp file: it is cut off, altered or not ours", {},
                whole, where);

  if (checksum_of(in, length, where).value() != little_endian(seal + 16))
    throw Error("store", "the file is damaged: its checksum does not match its content", {}, whole, where);
}

}  // namespace scarp
