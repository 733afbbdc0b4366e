// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/error.hpp"

namespace scarp {

/// An input file read once from front to back, in blocks: lines, bytes, or lines and then bytes (PLY and PCD have
/// a text header before binary data). What it returns stays valid until the next call.
class BufferedFile {
 public:
  /// @throws Error if the file is missing, a folder, not an ordinary file, or unreadable.
  explicit BufferedFile(const std::filesystem::path& path);

  /// The next line without its LF or CR LF; false at the end of the file.
  /// @throws Error for a line above 64 MiB: such a file is not text.
  bool next_line(std::string_view& line);

  /// The next `count` bytes, contiguous. @throws Error if the file ends before.
  const char* take(std::uint64_t count);

  /// Passes over `count` bytes. @throws Error if the file ends before.
  void skip(std::uint64_t count);

  /// The first bytes of the file, at most 64 KiB, without passing over them. For the very start only.
  std::string_view peek();

  std::uint64_t size() const { return size_; }
  std::uint64_t bytes_left() const { return size_ - offset_; }

  /// Where the last line, or the last bytes taken, stand; for messages.
  SourceLocation at_line(std::size_t column = 0) const;
  SourceLocation at_byte() const;

 private:
  /// Makes the unread part of the buffer longer; false if the file has no more.
  bool fill();
  void require(std::uint64_t count) const;

  std::string name_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;      ///< of the first unread byte
  std::uint64_t item_start_ = 0;  ///< of what was returned last
  long long line_ = 0;            ///< of the line returned last, from 1
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< the unread part of the buffer
};

}  // namespace scarp
