// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/model/image.hpp"

namespace scarp {

/// A rectangle of pixels; `right` and `bottom` lie just outside.
struct PixelRect {
  int left = 0, top = 0, width = 0, height = 0;
  int right() const { return left + width; }
  int bottom() const { return top + height; }
};

struct Point2 {
  double x = 0, y = 0;  ///< pixels; whole numbers are corners of pixels, y down
};

enum class Align { left, centre, right };

inline constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu";

/// The font file that a canvas would miss; empty when both are there. To be asked before work begins whose pictures
/// come last.
std::string missing_font(const std::filesystem::path& folder = kFontFolder);

/// @throws Error ("render") if a font is missing
void require_fonts();

/// Antialiased lines, areas and UTF-8 texts (DejaVu Sans) on a picture.
class Canvas {
 public:
  /// Draws into `picture`, which must outlive the canvas.
  /// @throws Error ("render") if the font is not installed.
  explicit Canvas(Picture& picture);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Width of a text set with an em of `size` pixels.
  double text_width(const std::string& text, double size, bool bold = false);
  /// Text with its baseline at at.y.
  void text(const std::string& text, Point2 at, double size, const Rgb8& colour, Align align = Align::left,
            bool bold = false);
  void line(Point2 from, Point2 to, double width, const Rgb8& colour);
  void fill(const std::vector<Point2>& polygon, const Rgb8& colour);
  /// A rectangle of whole pixels.
  void fill(const PixelRect& rect, const Rgb8& colour);
  void outline(const PixelRect& rect, int width, const Rgb8& colour);

 private:
  struct Fonts;
  Picture& picture_;
  Fonts* fonts_;
};

/// Breaks a text at spaces into lines that are at most `width` wide where words allow.
std::vector<std::string> wrap(Canvas& canvas, const std::string& text, double size, double width);

/// The text, shortened with an ellipsis until it is at most `width` wide.
std::string shorten(Canvas& canvas, const std::string& text, double size, double width, bool bold = false);

}  // namespace scarp
