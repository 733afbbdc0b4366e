// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/error.hpp"

#include <charconv>
#include <cmath>
#include <utility>

namespace scarp {
namespace {

std::string compose(const std::string& what, const std::string& value, const std::string& allowed,
                    const SourceLocation& where) {
  std::string text;
  if (!where.file.empty()) {
    text = where.file;
    if (where.line > 0) text += ":" + std::to_string(where.line);
    if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
    if (where.byte >= 0) text += ": byte " + std::to_string(where.byte);
    text += ": ";
  }
  text += what;
  if (!value.empty()) text += ": found " + value;
  if (!allowed.empty()) text += "; allowed: " + allowed;
  return text;
}

}  // namespace

Error::Error(std::string stage, std::string what, std::string value, std::string allowed, SourceLocation where)
    : std::runtime_error(compose(what, value, allowed, where)), stage_(std::move(stage)), where_(std::move(where)) {}

std::string shortest(double value) {
  // Plain digits where a reader would write them: 500000, not 5e+05.
  const double size = std::abs(value);
  const bool plain = value == 0 || (size >= 1e-5 && size < 1e15);
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value,
                                 plain ? std::chars_format::fixed : std::chars_format::general)
                       .ptr;
  return {buffer, end};
}

}  // namespace scarp
