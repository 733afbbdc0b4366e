// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/lzf.hpp"

#include <cstring>

namespace scarp {

std::optional<std::vector<char>> expand_lzf(std::span<const char> block, std::size_t size) {
  if (size / kLzfLargestRatio > block.size()) return {};
  std::vector<char> out(size);
  const char* in = block.data();
  const char* const in_end = in + block.size();
  std::size_t written = 0;
  while (in != in_end) {
    const unsigned control = static_cast<unsigned char>(*in++);
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > static_cast<std::size_t>(in_end - in) || length > size - written) return {};
      std::memcpy(out.data() + written, in, length);
      in += length;
      written += length;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    if (control >> 5 == 7) {
      if (in == in_end) return {};
      length += static_cast<unsigned char>(*in++);
    }
    if (in == in_end) return {};
    const std::size_t distance = ((control & 31u) << 8 | static_cast<unsigned char>(*in++)) + 1;
    if (distance > written || length > size - written) return {};
    // Byte by byte: source and target overlap where a pattern repeats.
    for (std::size_t i = 0; i < length; ++i, ++written) out[written] = out[written - distance];
  }
  if (written != size) return {};
  return out;
}

}  // namespace scarp
