// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "ingest/number_type.hpp"
#include "ingest/read_buffered.hpp"

namespace scarp {

struct PcdField {
  std::string name;
  NumberType type = NumberType::f32;
  std::uint64_t count = 1;
  bool packed_colour = false;

  std::uint64_t bytes() const { return size_of(type) * count; }
  bool kept() const { return count == 1 && name != "_"; }
};

struct PcdHeader {
  enum class Data { ascii, binary, compressed };

  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  Data data = Data::ascii;

  std::uint64_t stride() const;  ///< bytes of a binary point
  std::uint64_t cells() const;   ///< numbers of a text line
};

/// Reads the header up to and with the line DATA. @throws Error at its line.
PcdHeader read_pcd_header(BufferedFile& file);

}  // namespace scarp
