// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace scarp {
namespace {

std::string duration(double seconds) {
  char text[32];
  if (seconds < 60)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 3600)
    std::snprintf(text, sizeof text, "%d min %02d s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
  else
    std::snprintf(text, sizeof text, "%d h %02d min", static_cast<int>(seconds) / 3600,
                  static_cast<int>(seconds) / 60 % 60);
  return text;
}

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
  }
  return quoted + '"';
}

}  // namespace

Terminal::Terminal(ProgressStyle style, bool quiet)
    : style_(style), quiet_(quiet), is_terminal_(isatty(STDERR_FILENO)) {}

double Terminal::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Terminal::begin(std::string_view stage) {
  stage_ = stage;
  tenths_shown_ = 0;
  start_ = std::chrono::steady_clock::now();
  drawn_ = {};
  if (quiet_) return;
  if (style_ == ProgressStyle::json)
    std::fprintf(stderr, "{\"stage\":%s,\"event\":\"begin\"}\n", json_string(stage_).c_str());
  else if (style_ == ProgressStyle::automatic)
    std::fprintf(stderr, "%s ...%s", stage_.c_str(), is_terminal_ ? "\r" : "\n");
  std::fflush(stderr);
}

void Terminal::progress(double fraction) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (quiet_ || style_ == ProgressStyle::none) return;
  if (style_ == ProgressStyle::automatic && is_terminal_) return draw_bar(fraction);
  const int tenths = static_cast<int>(fraction * 10 + 1e-9);
  if (tenths <= tenths_shown_) return;
  tenths_shown_ = tenths;
  const double left = fraction > 0 ? elapsed() * (1 - fraction) / fraction : 0;
  if (style_ == ProgressStyle::json)
    std::fprintf(stderr, "{\"stage\":%s,\"fraction\":%.3f,\"elapsed_s\":%.1f,\"left_s\":%.1f}\n",
                 json_string(stage_).c_str(), fraction, elapsed(), left);
  else
    std::fprintf(stderr, "%s %3d %%, %s left\n", stage_.c_str(), tenths * 10, duration(left).c_str());
}

void Terminal::draw_bar(double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (fraction < 1 && now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int width = 40;
  const int filled = static_cast<int>(fraction * width);
  const std::string bar =
      std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(width - filled), '.');
  const double left = fraction > 0 ? elapsed() * (1 - fraction) / fraction : 0;
  std::fprintf(stderr, "\r\033[K%-10s [%s] %3d %%  %s left", stage_.c_str(), bar.c_str(),
               static_cast<int>(fraction * 100), duration(left).c_str());
  std::fflush(stderr);
}

void Terminal::clear_bar() {
  if (!is_terminal_ || style_ != ProgressStyle::automatic) return;
  std::fprintf(stderr, "\r\033[K");
}

void Terminal::note(const std::string& text) {
  if (quiet_) return;
  if (style_ == ProgressStyle::json) {
    std::fprintf(stderr, "{\"stage\":%s,\"note\":%s}\n", json_string(stage_).c_str(), json_string(text).c_str());
    return;
  }
  clear_bar();
  std::fprintf(stderr, "  %s\n", text.c_str());
}

void Terminal::end() {
  if (quiet_) return;
  if (style_ == ProgressStyle::json) {
    std::fprintf(stderr, "{\"stage\":%s,\"event\":\"end\",\"elapsed_s\":%.2f}\n", json_string(stage_).c_str(),
                 elapsed());
    return;
  }
  clear_bar();
  if (style_ == ProgressStyle::automatic)
    std::fprintf(stderr, "%s done in %s\n", stage_.c_str(), duration(elapsed()).c_str());
}

}  // namespace scarp
