// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/series_store.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"

namespace scarp {
namespace {

constexpr std::string_view kVersion = "1.0";

std::string json_text(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += "\\u00";
      out += digits[c >> 4];
      out += digits[c & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

void append_utf8(std::string& out, std::uint32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | code >> 6);
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    out += static_cast<char>(0xe0 | code >> 12);
    out += static_cast<char>(0x80 | (code >> 6 & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
}

/// Just enough JSON for a series: objects and arrays of texts and numbers, no recursion.
class SeriesParser {
 public:
  SeriesParser(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  std::vector<std::pair<std::string, double>> parse() {
    std::vector<std::pair<std::string, double>> frames;
    bool has_version = false, has_files = false;
    object([&](const std::string& key) {
      if (key == "file-series-version") {
        const std::size_t at = at_;
        const std::string version = text();
        if (version != kVersion) refuse("version of the series '" + version + "'", "'1.0'", at);
        has_version = true;
      } else if (key == "files") {
        expect('[');
        if (!take(']')) do {
            frames.push_back(frame());
          } while (more(']'));
        has_files = true;
      } else {
        refuse("unknown key '" + key + "'", "file-series-version, files", at_);
      }
    });
    skip_space();
    if (at_ != text_.size()) refuse("something stands behind the end of the series", {}, at_);
    if (!has_version || !has_files) refuse("the series is incomplete", "file-series-version and files", at_);
    return frames;
  }

 private:
  std::pair<std::string, double> frame() {
    std::optional<std::string> name;
    std::optional<double> time;
    object([&](const std::string& key) {
      if (key == "name")
        name = text();
      else if (key == "time")
        time = number();
      else
        refuse("unknown key '" + key + "'", "name, time", at_);
    });
    if (!name || !time) refuse("a frame of the series is incomplete", "name and time", at_);
    return {*name, *time};
  }

  template <class F>
  void object(F&& value_of) {
    expect('{');
    if (take('}')) return;
    do {
      const std::string key = text();
      expect(':');
      value_of(key);
    } while (more('}'));
  }

  std::string text() {
    expect('"');
    std::string out;
    while (true) {
      const char c = next();
      if (c == '"') return out;
      if (c == '\\')
        escape(out);
      else
        out += c;
    }
  }

  void escape(std::string& out) {
    const std::size_t at = at_;
    const char c = next();
    constexpr std::string_view from = "\"\\/bfnrt", to = "\"\\/\b\f\n\r\t";
    if (const std::size_t i = from.find(c); i != from.npos) {
      out += to[i];
    } else if (c == 'u' && at_ + 4 <= text_.size()) {
      std::uint32_t code = 0;
      const char* const end = text_.data() + at_ + 4;
      // Halves of a surrogate pair are refused: names that we write never need them.
      if (std::from_chars(text_.data() + at_, end, code, 16).ptr != end || (code >= 0xd800 && code < 0xe000))
        refuse("escape in a text", {}, at);
      at_ += 4;
      append_utf8(out, code);
    } else {
      refuse("escape in a text", {}, at);
    }
  }

  double number() {
    skip_space();
    double value = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, failure] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (failure != std::errc() || !std::isfinite(value)) refuse("this is no time", "a finite number, s", at_);
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  void skip_space() {
    while (at_ < text_.size() && std::strchr(" \t\r\n", text_[at_]) && text_[at_] != '\0') ++at_;
  }
  char next() {
    if (at_ >= text_.size()) refuse("the file ends too early", {}, at_);
    return text_[at_++];
  }
  bool take(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) refuse("this is no series of frames", std::string("'") + c + "' here", at_);
  }
  /// After an entry: true for a comma, false for the closing bracket.
  bool more(char close) {
    if (take(',')) return true;
    expect(close);
    return false;
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed, std::size_t at) const {
    throw Error("store", what, {}, allowed, {file_, 0, 0, static_cast<long long>(at)});
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
};

}  // namespace

void write_series(const std::filesystem::path& path, const std::vector<std::pair<std::string, double>>& frames) {
  std::string text = "{\n  \"file-series-version\": \"" + std::string(kVersion) + "\",\n  \"files\": [";
  const char* separator = "\n";
  for (const auto& [name, time] : frames) {
    if (!std::isfinite(time))
      throw Error("store", "time of the frame " + name, shortest(time), "a finite number", {path.string()});
    text += separator;
    text += "    {\"name\": " + json_text(name) + ", \"time\": " + shortest(time) + "}";
    separator = ",\n";
  }
  text += "\n  ]\n}\n";
  write_whole(path, text);
}

std::vector<std::pair<std::string, double>> read_series(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("store", "cannot open the file", std::strerror(errno), {}, {path.string()});
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw Error("store", "cannot read the file", std::strerror(errno), {}, {path.string()});
  return SeriesParser(text, path.string()).parse();
}

}  // namespace scarp
