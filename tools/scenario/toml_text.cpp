// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/toml_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::size_t kWidth = 100;

bool is_list_of_tables(const TomlValue& value) {
  return value.kind == TomlValue::Kind::array && !value.children.empty() &&
         value.children[0].kind == TomlValue::Kind::table;
}

/// Inline tables cannot be broken over lines, so all of them must fit on one.
bool stays_inline(const TomlValue& value) {
  if (is_list_of_tables(value)) return std::all_of(value.children.begin(), value.children.end(), stays_inline);
  if (value.kind != TomlValue::Kind::table) return true;
  return value.key.size() + print_inline(value).size() + 8 <= kWidth;
}

class Printer {
 public:
  void entries(const TomlValue& table, const std::string& path) {
    const auto is_section = [&](const TomlValue& value) {
      const bool is_tables = value.kind == TomlValue::Kind::table || is_list_of_tables(value);
      return is_tables && (path.empty() || !stays_inline(value));
    };
    for (const TomlValue& entry : table.children)
      if (!is_section(entry)) line(entry);
    for (const TomlValue& entry : table.children)
      if (is_section(entry)) section(entry, path.empty() ? toml_key(entry.key) : path + "." + toml_key(entry.key));
  }

  std::string take() { return std::move(out_); }

 private:
  void section(const TomlValue& value, const std::string& path) {
    if (value.kind == TomlValue::Kind::array) {
      for (const TomlValue& item : value.children) {
        header("[[" + path + "]]");
        entries(item, path);
      }
      return;
    }
    // Tables by name: each is a section of its own, however short.
    const bool is_map =
        !value.children.empty() && std::all_of(value.children.begin(), value.children.end(),
                                               [](const TomlValue& v) { return v.kind == TomlValue::Kind::table; });
    if (is_map) {
      for (const TomlValue& entry : value.children) section(entry, path + "." + toml_key(entry.key));
      return;
    }
    header("[" + path + "]");
    entries(value, path);
  }

  void header(const std::string& text) { out_ += (out_.empty() ? "" : "\n") + text + "\n"; }

  void line(const TomlValue& entry) {
    const std::string start = toml_key(entry.key) + " = ";
    out_ += start;
    if (is_list_of_tables(entry) || start.size() + print_inline(entry).size() > kWidth)
      broken(entry);
    else
      out_ += print_inline(entry);
    out_ += "\n";
  }

  /// A list over several lines: a table per line, other items as many as fit.
  void broken(const TomlValue& list) {
    if (list.kind != TomlValue::Kind::array) {
      out_ += list.text;
      return;
    }
    out_ += "[\n";
    std::string row;
    for (const TomlValue& item : list.children) {
      const std::string text = print_inline(item) + ",";
      if (!row.empty() && (item.kind == TomlValue::Kind::table || row.size() + text.size() + 3 > kWidth)) {
        out_ += "  " + row + "\n";
        row.clear();
      }
      row += (row.empty() ? "" : " ") + text;
    }
    if (!row.empty()) out_ += "  " + row + "\n";
    out_ += "]";
  }

  std::string out_;
};

}  // namespace

std::string toml_double(double value) {
  if (!std::isfinite(value)) throw Error("scenario", "a number of the scenario is not finite", shortest(value));
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-4 && size < 1e15);
  std::array<char, 64> buffer;
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
  std::string text(buffer.data(), end);
  const std::size_t mantissa = std::min(text.find('e'), text.size());
  if (text.find('.') == std::string::npos) text.insert(mantissa, ".0");
  return text;
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (code < ' ' || code == 0x7f) {
      constexpr std::string_view kHex = "0123456789ABCDEF";
      out += "\\u00";
      out += kHex[code >> 4];
      out += kHex[code & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(key) : toml_string(key);
}

std::string print_inline(const TomlValue& value) {
  if (value.kind == TomlValue::Kind::scalar) return value.text;
  const bool table = value.kind == TomlValue::Kind::table;
  if (value.children.empty()) return table ? "{}" : "[]";
  std::string out = table ? "{ " : "[";
  for (std::size_t i = 0; i < value.children.size(); ++i) {
    if (i) out += ", ";
    if (table) out += toml_key(value.children[i].key) + " = ";
    out += print_inline(value.children[i]);
  }
  return out + (table ? " }" : "]");
}

std::string print_toml(const TomlValue& root) {
  Printer printer;
  printer.entries(root, "");
  return printer.take();
}

}  // namespace scarp
