// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace scarp {

/// Where a user's mistake stands. `line` and `column` count from 1; 0 means that they do not apply.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  /// For binary files: byte offset, or -1.
  long long byte = -1;
};

/// The one exception for what the user can mend: usage, scenario, input data (exit code 2).
///
/// Programmer errors are assertions; numerical outcomes are values in the run report. A library throws this
/// and never prints. The text reads "FILE:LINE:COL: what: found VALUE; allowed: CONSTRAINT", with the parts
/// that are empty left out.
class Error : public std::runtime_error {
 public:
  /// @param stage   who noticed: "scenario", "ingest", "discretize", ...
  /// @param what    the thing that is wrong, in the user's words
  /// @param value   the value found, as the user wrote it; may be empty
  /// @param allowed what would have been accepted; may be empty
  Error(std::string stage, std::string what, std::string value = {}, std::string allowed = {},
        SourceLocation where = {});

  const std::string& stage() const { return stage_; }
  const SourceLocation& where() const { return where_; }

 private:
  std::string stage_;
  SourceLocation where_;
};

/// Shortest decimal text that reads back to the same double ("0.25", not "0.250000").
std::string shortest(double value);

}  // namespace scarp
