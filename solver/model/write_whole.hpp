// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace scarp {

/// Writes a file so that its final name only ever holds a whole file: `write` fills `PATH.tmp` (given to it as
/// an argument), which is then synced and renamed, and the folder synced. If `write` throws, the temporary
/// file is removed and the old file, if any, stands. Creates the parent folders.
/// @throws Error ("write") naming the path and the system's reason.
/// A suffix-sensitive writer (an image encoder that goes by extension) can ask for the extension to be kept:
/// then the temporary name is `STEM.tmp.EXT`.
void write_whole(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& temporary)>& write, bool keep_extension = false);

/// The same for text or bytes at hand.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace scarp
