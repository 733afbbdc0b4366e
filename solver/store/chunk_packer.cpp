// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/chunk_packer.hpp"

#include <isa-l.h>

#include <bit>
#include <cstdint>

namespace scarp {

static_assert(std::endian::native == std::endian::little, "chunks are stored as they are in memory");

namespace {

/// All first bytes, then all second ones, ... of numbers whose place in the chunk is `all` numbers long.
template <std::size_t element>
void shuffle(const unsigned char* values, std::size_t count, std::size_t all, unsigned char* out) {
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t byte = 0; byte < element; ++byte) out[byte * all + i] = values[i * element + byte];
}

}  // namespace

ChunkPacker::ChunkPacker() : level_(ISAL_DEF_LVL1_DEFAULT) {}

std::optional<std::span<const unsigned char>> ChunkPacker::pack(std::span<const unsigned char> values,
                                                                std::size_t element, std::size_t bytes) {
  const std::size_t all = bytes / element, count = values.size() / element;
  if (count < all || shuffled_.size() != bytes) shuffled_.assign(bytes, 0);
  switch (element) {
    case 1:
      shuffle<1>(values.data(), count, all, shuffled_.data());
      break;
    case 4:
      shuffle<4>(values.data(), count, all, shuffled_.data());
      break;
    case 8:
      shuffle<8>(values.data(), count, all, shuffled_.data());
      break;
    default:
      return std::nullopt;
  }
  packed_.resize(bytes + bytes / 8 + 1024);  // more than stored blocks of 64 KiB take
  isal_zstream stream;
  isal_deflate_stateless_init(&stream);
  stream.level = 1;
  stream.level_buf = level_.data();
  stream.level_buf_size = static_cast<std::uint32_t>(level_.size());
  stream.gzip_flag = IGZIP_ZLIB;
  stream.end_of_stream = 1;
  stream.flush = NO_FLUSH;
  stream.next_in = shuffled_.data();
  stream.avail_in = static_cast<std::uint32_t>(bytes);
  stream.next_out = packed_.data();
  stream.avail_out = static_cast<std::uint32_t>(packed_.size());
  if (isal_deflate_stateless(&stream) != COMP_OK) return std::nullopt;
  return std::span<const unsigned char>(packed_.data(), stream.total_out);
}

}  // namespace scarp
