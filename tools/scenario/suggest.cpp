// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/suggest.hpp"

#include <algorithm>
#include <cctype>

namespace scarp {
namespace {

/// Words beyond this length are not compared: the distance costs the product of the lengths.
constexpr std::size_t kLongestWord = 64;

std::string folded(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Optimal string alignment distance: Levenshtein's, with swaps of neighbours.
int edit_distance(const std::string& a, const std::string& b) {
  const std::size_t n = b.size() + 1;
  std::vector<int> before(n), last(n), now(n);
  for (std::size_t j = 0; j < n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < n; ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[n - 1];
}

bool one_begins_the_other(const std::string& a, const std::string& b) {
  return std::min(a.size(), b.size()) >= 3 && (a.starts_with(b) || b.starts_with(a));
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > kLongestWord) return {};
  const std::string wanted = folded(word);
  std::string best;
  int least = std::max(1, static_cast<int>(wanted.size()) / 3) + 1;
  for (const std::string& entry : known) {
    if (entry.size() > kLongestWord) continue;
    const int distance = edit_distance(wanted, folded(entry));
    if (distance < least) {
      least = distance;
      best = entry;
    }
  }
  if (!best.empty()) return best;
  for (const std::string& entry : known)
    if (one_begins_the_other(wanted, folded(entry))) return entry;
  return {};
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string best = nearest_word(word, known);
  return best.empty() ? "" : " (did you mean \"" + best + "\"?)";
}

std::string quoted_list(const std::vector<std::string>& words, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) out += (i ? ", \"" : "\"") + words[i] + "\"";
  if (words.size() > most) out += " and " + std::to_string(words.size() - most) + " more";
  return out;
}

}  // namespace scarp
