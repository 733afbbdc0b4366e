// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scarp {

/// The entry of `known` that a mistyped `word` most likely meant, or empty if none is near. Near means at most
/// one edit per three letters (insert, delete, replace, swap of neighbours; letter case and '-' against '_' are
/// free), or that one is the beginning of the other.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// " (did you mean "cell"?)", or empty if nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// `"a", "b", "c"`; beyond `most` entries the rest is counted, not listed.
std::string quoted_list(const std::vector<std::string>& words, std::size_t most = 16);

}  // namespace scarp
