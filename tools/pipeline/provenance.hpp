// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace scarp {

/// SHA-256 of a file's bytes in lower-case hexadecimal. @throws Error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);
std::string sha256_of_text(std::string_view text);

/// "Linux 6.1 x86_64, 2 processors": enough to tell two results' machines apart.
std::string machine();

}  // namespace scarp
