// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

#include "tools/pipeline/reporter.hpp"

namespace scarp {

enum class ProgressStyle { automatic, json, none };

/// Progress on standard error: a bar with the time left on a terminal, a line per ten percent in a pipe, or JSON
/// lines. Own code: no progress library is packaged.
class Terminal : public Reporter {
 public:
  Terminal(ProgressStyle style, bool quiet);

  void begin(std::string_view stage) override;
  void progress(double fraction) override;
  void note(const std::string& text) override;
  void end() override;

 private:
  void draw_bar(double fraction);
  double elapsed() const;
  void clear_bar();

  ProgressStyle style_;
  bool quiet_;
  bool is_terminal_;
  std::string stage_;
  int tenths_shown_ = 0;
  std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace scarp
