// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The TOML library recurses over nested values and dotted keys, and its effort grows with the square of the length
// of a line: deep or long input is refused before it gets there.
#include <string_view>

#include "tools/scenario/parse_toml.hpp"

namespace scarp {
namespace {

constexpr int kDeepest = 64;
constexpr int kLongestLine = 4096;

/// A scan over the characters that knows only what is needed to tell structure from strings and comments.
class BoundsCheck {
 public:
  BoundsCheck(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_string(c);
      else if (c == '#')
        skip_comment();
      else
        structure(c);
    }
  }

 private:
  void structure(char c) {
    if (c == '[' || c == '{') {
      if (++depth_ > kDeepest) fail("brackets are nested deeper than " + std::to_string(kDeepest));
    } else if (c == ']' || c == '}') {
      if (depth_ > 0) --depth_;
    }
    if (c == '.') {
      if (++dots_ > kDeepest) fail("a dotted key has more than " + std::to_string(kDeepest) + " parts");
    } else if (c == '=' || c == ',' || c == '[' || c == '{' || c == '\n') {
      dots_ = 0;
    }
    step();
  }

  void step() {
    const auto c = static_cast<unsigned char>(text_[at_]);
    if ((c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == 0x7f)
      fail("a control character (code " + std::to_string(c) + ") does not belong in a text file");
    ++at_;
    ++column_;
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if (column_ > kLongestLine + 1) {
      fail("a line is longer than " + std::to_string(kLongestLine) + " characters; break it between list entries");
    }
  }

  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool multi = text_.substr(at_).starts_with(triple);
    const std::string_view end = multi ? std::string_view(triple) : std::string_view(triple).substr(0, 1);
    for (std::size_t i = 0; i < end.size(); ++i) step();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(end)) {
      if (!multi && text_[at_] == '\n') return;  // a syntax error, which the library names
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size()) step();
      step();
    }
    for (std::size_t i = 0; i < end.size() && at_ < text_.size(); ++i) step();
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') step();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error("scenario", what, {}, {}, {name_, line_, column_});
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1, depth_ = 0, dots_ = 0;
};

}  // namespace

void check_toml_bounds(const std::string& text, const std::string& name) {
  if (text.size() > kLargestScenario)
    throw Error("scenario", "a scenario of this size is refused", std::to_string(text.size()) + " bytes",
                "at most " + std::to_string(kLargestScenario) + " bytes", {name});
  BoundsCheck(text, name).run();
}

}  // namespace scarp
