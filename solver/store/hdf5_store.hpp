// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The small part of HDF5 that our artefacts need. The library's own header is known to hdf5_store.cpp alone.
// HDF5 is not safe for parallel calls: use this room from one thread at a time.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solver/store/chunk_packer.hpp"

namespace scarp {

enum class ElementType { float32, float64, int32, int64, uint8, uint32 };

/// What one entry of an array is made of: a number, or a std::array of numbers.
template <class V>
struct Entry {
  using Number = V;
  static constexpr int components = 1;
};
template <class T, std::size_t n>
struct Entry<std::array<T, n>> {
  using Number = T;
  static constexpr int components = static_cast<int>(n);
};

template <class V>
constexpr ElementType element_type() {
  using T = typename Entry<V>::Number;
  if constexpr (std::is_same_v<T, float>) return ElementType::float32;
  if constexpr (std::is_same_v<T, double>) return ElementType::float64;
  if constexpr (std::is_same_v<T, std::int32_t>) return ElementType::int32;
  if constexpr (std::is_same_v<T, std::int64_t>) return ElementType::int64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return ElementType::uint8;
  if constexpr (std::is_same_v<T, std::uint32_t>) return ElementType::uint32;
}

struct ArrayShape {
  ElementType type = ElementType::float64;
  std::size_t rows = 0;
  int components = 1;  ///< 1: the array has one dimension, otherwise rows x components
};

/// Writes an HDF5 file, array by array, so that none but the caller's need be in memory. Meant for the temporary file
/// of `write_whole`. A disk that refuses throws Error ("store"). The same calls give the same bytes (no time stamps).
class Hdf5Writer {
 public:
  /// @param shown  the file's final path, for error messages
  Hdf5Writer(const std::filesystem::path& path, std::filesystem::path shown);
  explicit Hdf5Writer(const std::filesystem::path& path) : Hdf5Writer(path, path) {}
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Its parent must exist.
  void group(const std::string& path);
  /// Chunked (16 Ki rows), shuffled, deflated: half the size of floats.
  void array(const std::string& path, const ArrayShape& shape, const void* values);
  /// The same in parts: all rows are there, and undefined until they are written. Parts are whole chunks, but for the
  /// last.
  void begin_array(const std::string& path, const ArrayShape& shape);
  void rows(const std::string& path, std::size_t first, const ArrayShape& part, const void* values);
  void text(const std::string& path, std::string_view value);
  void text_attribute(const std::string& object, const std::string& name, std::string_view value);

  template <class V>
  void array(const std::string& path, const std::vector<V>& values) {
    array(path, {element_type<V>(), values.size(), Entry<V>::components}, values.data());
  }
  template <class V>
  void rows(const std::string& path, std::size_t first, const std::vector<V>& values) {
    rows(path, first, {element_type<V>(), values.size(), Entry<V>::components}, values.data());
  }
  /// A number: a dataset without dimensions; a std::array: one row of them.
  template <class V>
  void value(const std::string& path, const V& value) {
    single(path, element_type<V>(), dimension<V>(), &value);
  }
  template <class V>
  void attribute(const std::string& object, const std::string& name, const V& value) {
    attribute(object, name, element_type<V>(), dimension<V>(), &value);
  }

  /// Closes the file and seals it (sealed_store.hpp). The writer is spent.
  void finish();

 private:
  template <class V>
  static constexpr int dimension() {
    return std::is_arithmetic_v<V> ? 0 : Entry<V>::components;
  }
  void single(const std::string& path, ElementType type, int count, const void* value);
  void attribute(const std::string& object, const std::string& name, ElementType type, int count, const void* value);

  std::filesystem::path path_, shown_;
  std::int64_t file_ = -1;
  ChunkPacker packer_;
};

/// Reads a sealed HDF5 file. Everything throws Error ("store") with the file's name and what is wrong: an object
/// that is missing, of another type or shape than asked for, or larger than the file could hold.
class Hdf5Reader {
 public:
  /// Checks the seal before the library opens the file.
  explicit Hdf5Reader(std::filesystem::path path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Refuses a file whose root does not say that it is this format in this version.
  void expect_format(std::string_view format, std::int64_t version) const;
  /// What the group holds, in the order of writing.
  std::vector<std::string> names(const std::string& group) const;
  ArrayShape shape(const std::string& path) const;
  void read(const std::string& path, const ArrayShape& expected, void* values) const;
  std::string text(const std::string& path) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;

  template <class V>
  std::vector<V> array(const std::string& path) const {
    const ArrayShape found = shape(path);
    std::vector<V> values(found.rows);
    read(path, {element_type<V>(), found.rows, Entry<V>::components}, values.data());
    return values;
  }
  template <class V>
  V value(const std::string& path) const {
    V value{};
    read(path, {element_type<V>(), static_cast<std::size_t>(Entry<V>::components), 1}, &value);
    return value;
  }
  template <class V>
  V attribute(const std::string& object, const std::string& name) const {
    V value{};
    attribute(object, name, element_type<V>(), Entry<V>::components, &value);
    return value;
  }

  /// Throws Error with the file's name: what it holds is not what scarp writes.
  [[noreturn]] void refuse(const std::string& what, const std::string& found = {},
                           const std::string& allowed = {}) const;

 private:
  void attribute(const std::string& object, const std::string& name, ElementType type, int count, void* value) const;

  std::filesystem::path path_;
  std::uintmax_t size_ = 0;  ///< bytes of the file
  std::int64_t file_ = -1;
};

/// Writes what `expect_format` checks.
inline void write_format(Hdf5Writer& file, std::string_view format, std::int64_t version) {
  file.text_attribute("/", "format", format);
  file.attribute("/", "format_version", version);
}

}  // namespace scarp
