// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace scarp {

/// Where the pipeline says what it is doing. The command line draws a bar, lines or JSON of it; tests listen.
struct Reporter {
  virtual ~Reporter() = default;
  virtual void begin(std::string_view stage) = 0;
  /// @param fraction done of the current stage, 0..1
  virtual void progress(double fraction) = 0;
  /// A fact that the user should read: a count, a figure, a fallback that was taken.
  virtual void note(const std::string& text) = 0;
  virtual void end() = 0;
};

}  // namespace scarp
