// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_buffered.hpp"

#include <algorithm>
#include <climits>
#include <cstring>

namespace scarp {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{64} << 20;

}  // namespace

BufferedFile::BufferedFile(const std::filesystem::path& path) : name_(path.string()) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) throw Error("ingest", "no such file", {}, {}, {name_});
  if (std::filesystem::is_directory(status)) throw Error("ingest", "is a folder, not a file", {}, {}, {name_});
  if (!std::filesystem::is_regular_file(status)) throw Error("ingest", "is not an ordinary file", {}, {}, {name_});
  size_ = std::filesystem::file_size(path, code);
  stream_.open(path, std::ios::binary);
  if (code || !stream_) throw Error("ingest", "cannot be opened for reading", {}, {}, {name_});
  buffer_.resize(std::clamp<std::uint64_t>(size_, 64, kBlock));
}

bool BufferedFile::fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  // Never past the size seen when the file was opened: the counts are bounded by it.
  const std::uint64_t unread = size_ - offset_ - end_;
  const std::size_t wanted = std::min<std::uint64_t>(buffer_.size() - end_, unread);
  if (wanted == 0) return false;
  stream_.read(buffer_.data() + end_, static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(stream_.gcount());
  if (got == 0) throw Error("ingest", "cannot be read to its end", {}, {}, {name_, 0, 0, (long long)(offset_ + end_)});
  end_ += got;
  return true;
}

bool BufferedFile::next_line(std::string_view& line) {
  item_start_ = offset_;
  std::size_t searched = 0;
  for (;;) {
    const char* first = buffer_.data() + begin_;
    const auto* feed = static_cast<const char*>(std::memchr(first + searched, '\n', end_ - begin_ - searched));
    searched = end_ - begin_;
    std::size_t length = feed ? feed - first : searched;
    if (!feed) {
      if (length > kLongestLine)
        throw Error("ingest", "line is too long for a text file", {}, "lines up to 64 MiB", {name_, (int)line_ + 1});
      if (fill()) continue;
      if (length == 0) return false;
      first = buffer_.data() + begin_;
    }
    const std::size_t consumed = length + (feed ? 1 : 0);
    begin_ += consumed;
    offset_ += consumed;
    if (length > 0 && first[length - 1] == '\r') --length;
    line = {first, length};
    ++line_;
    return true;
  }
}

void BufferedFile::require(std::uint64_t count) const {
  if (count <= bytes_left()) return;
  throw Error("ingest", "file ends in the middle of its data", std::to_string(bytes_left()) + " bytes left",
              "at least " + std::to_string(count), {name_, 0, 0, static_cast<long long>(offset_)});
}

const char* BufferedFile::take(std::uint64_t count) {
  if (end_ - begin_ < count) {
    require(count);
    if (begin_ + count > buffer_.size()) {
      std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
      if (count > buffer_.size()) buffer_.resize(count);
    }
    while (end_ - begin_ < count) fill();
  }
  const char* first = buffer_.data() + begin_;
  item_start_ = offset_;
  begin_ += count;
  offset_ += count;
  return first;
}

void BufferedFile::skip(std::uint64_t count) {
  require(count);
  item_start_ = offset_;
  while (count > 0) {
    if (begin_ == end_) fill();
    const std::uint64_t part = std::min<std::uint64_t>(count, end_ - begin_);
    begin_ += part;
    offset_ += part;
    count -= part;
  }
}

std::string_view BufferedFile::peek() {
  constexpr std::size_t kPeek = std::size_t{64} << 10;
  while (end_ - begin_ < std::min<std::uint64_t>(kPeek, bytes_left())) fill();
  return {buffer_.data() + begin_, std::min(kPeek, end_ - begin_)};
}

SourceLocation BufferedFile::at_line(std::size_t column) const {
  return {name_, static_cast<int>(std::min<long long>(line_, INT_MAX)),
          static_cast<int>(std::min<std::size_t>(column, INT_MAX)), -1};
}

SourceLocation BufferedFile::at_byte() const { return {name_, 0, 0, static_cast<long long>(item_start_)}; }

}  // namespace scarp
