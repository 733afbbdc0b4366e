// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/number_type.hpp"
#include "ingest/read_buffered.hpp"

namespace scarp {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::f32;
  std::optional<NumberType> length_type;  ///< a list, if set
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Bytes of a binary row, if there is no list in it.
  std::optional<std::uint64_t> fixed_size() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view name) const;
};

/// Reads the header, up to the line "end_header" and its line end. Comments and obj_info are passed over.
/// @throws Error with the line: no PLY, an unknown format, type or word, a property before any element.
PlyHeader read_ply_header(BufferedFile& file);

/// One row of an element.
struct PlyRow {
  std::vector<double> scalars;             ///< the properties that are no lists, in their order
  std::vector<std::vector<double>> lists;  ///< those that are
};

/// The rows of one element, where the file stands at the first of them.
class PlyRows {
 public:
  /// @throws Error if the file is too short for the element's count, or a counted element has no properties.
  PlyRows(BufferedFile& file, PlyFormat format, const PlyElement& element);

  /// @throws Error at line or byte: the end of the file, a value that its type cannot hold, a bad list length.
  void next(PlyRow& row);

  /// Passes over all rows; call it instead of next.
  void skip();

 private:
  void next_ascii(PlyRow& row);
  void next_binary(PlyRow& row);
  void check_length(double length, std::uint64_t available, const SourceLocation& where) const;

  BufferedFile& file_;
  PlyFormat format_;
  const PlyElement& element_;
  std::optional<std::uint64_t> fixed_size_;
  std::size_t lists_ = 0;  ///< properties that are lists
  std::vector<double> tokens_;
};

}  // namespace scarp
