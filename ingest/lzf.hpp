// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace scarp {

/// Expands an LZF block (the compression of PCD files, defined by Marc Lehmann's liblzf) to exactly `size` bytes;
/// nothing if the block is corrupt or expands to another size. Our own, because output and references must stay in
/// bounds whatever the input, and forty lines are less than one more package.
///
/// A block is a row of runs. A control byte c below 32: c + 1 literal bytes follow. Otherwise a copy of bytes already
/// written: length (c >> 5) + 2, where 7 means that the next byte is added, from ((c & 31) << 8 | next byte) + 1 back.
std::optional<std::vector<char>> expand_lzf(std::span<const char> block, std::size_t size);

/// A run of 3 bytes makes at most 7 + 255 + 2: no block expands by more.
inline constexpr std::size_t kLzfLargestRatio = 88;

}  // namespace scarp
