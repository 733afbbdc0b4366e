// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/canvas.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr const char *kRegular = "DejaVuSans.ttf", *kBold = "DejaVuSans-Bold.ttf";
constexpr int kShift = 6;  ///< bits after the point in OpenCV's fixed-point drawing coordinates

cv::Ptr<cv::freetype::FreeType2> load_font(const char* name) {
  cv::Ptr<cv::freetype::FreeType2> font = cv::freetype::createFreeType2();
  font->loadFontData(std::filesystem::path(kFontFolder) / name, 0);
  return font;
}

cv::Scalar scalar(const Rgb8& colour) { return {double(colour[0]), double(colour[1]), double(colour[2])}; }

cv::Mat view(Picture& picture) { return {picture.height, picture.width, CV_8UC3, picture.pixels.data()}; }

/// OpenCV counts from the centre of the first pixel.
cv::Point fixed(Point2 p) { return {cvRound((p.x - 0.5) * (1 << kShift)), cvRound((p.y - 0.5) * (1 << kShift))}; }

}  // namespace

std::string missing_font(const std::filesystem::path& folder) {
  std::error_code failure;
  for (const char* name : {kRegular, kBold})
    if (!std::filesystem::exists(folder / name, failure)) return folder / name;
  return {};
}

void require_fonts() {
  if (const std::string path = missing_font(); !path.empty())
    throw Error("render", "the font for the texts is not installed", path, "install the package fonts-dejavu-core");
}

struct Canvas::Fonts {
  Fonts() : regular(load_font(kRegular)), bold(load_font(kBold)) {}
  cv::Ptr<cv::freetype::FreeType2> regular, bold;
};

Canvas::Canvas(Picture& picture) : picture_(picture), fonts_(nullptr) {
  require_fonts();
  fonts_ = new Fonts;
}
Canvas::~Canvas() { delete fonts_; }

double Canvas::text_width(const std::string& text, double size, bool bold) {
  if (text.empty()) return 0;
  int baseline = 0;
  return (bold ? fonts_->bold : fonts_->regular)->getTextSize(text, cvRound(size), -1, &baseline).width;
}

void Canvas::text(const std::string& text, Point2 at, double size, const Rgb8& colour, Align align, bool bold) {
  if (text.empty()) return;
  const double width = align == Align::left ? 0 : text_width(text, size, bold);
  const double left = align == Align::left ? at.x : align == Align::centre ? at.x - width / 2 : at.x - width;
  cv::Mat image = view(picture_);
  (bold ? fonts_->bold : fonts_->regular)
      ->putText(image, text, {cvRound(left), cvRound(at.y)}, cvRound(size), scalar(colour), -1, cv::LINE_AA, true);
}

void Canvas::line(Point2 from, Point2 to, double width, const Rgb8& colour) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (!(length > 0)) return;
  const double nx = -dy / length * width / 2, ny = dx / length * width / 2;
  fill({{from.x + nx, from.y + ny}, {to.x + nx, to.y + ny}, {to.x - nx, to.y - ny}, {from.x - nx, from.y - ny}},
       colour);
}

void Canvas::fill(const std::vector<Point2>& polygon, const Rgb8& colour) {
  std::vector<cv::Point> points;
  for (const Point2& p : polygon) points.push_back(fixed(p));
  cv::Mat image = view(picture_);
  cv::fillConvexPoly(image, points, scalar(colour), cv::LINE_AA, kShift);
}

void Canvas::fill(const PixelRect& rect, const Rgb8& colour) {
  for (int y = std::max(0, rect.top); y < std::min(picture_.height, rect.bottom()); ++y)
    for (int x = std::max(0, rect.left); x < std::min(picture_.width, rect.right()); ++x) picture_.at(x, y) = colour;
}

void Canvas::outline(const PixelRect& rect, int width, const Rgb8& colour) {
  fill(PixelRect{rect.left - width, rect.top - width, rect.width + 2 * width, width}, colour);
  fill(PixelRect{rect.left - width, rect.bottom(), rect.width + 2 * width, width}, colour);
  fill(PixelRect{rect.left - width, rect.top, width, rect.height}, colour);
  fill(PixelRect{rect.right(), rect.top, width, rect.height}, colour);
}

std::vector<std::string> wrap(Canvas& canvas, const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const bool fits = !lines.empty() && canvas.text_width(lines.back() + " " + word, size) <= width;
    if (fits)
      lines.back() += " " + word;
    else if (!word.empty())
      lines.push_back(word);
    begin = end + 1;
  }
  return lines;
}

std::string shorten(Canvas& canvas, const std::string& text, double size, double width, bool bold) {
  if (canvas.text_width(text, size, bold) <= width) return text;
  std::string head = text;
  while (!head.empty() && canvas.text_width(head + "…", size, bold) > width) {
    // One character may be several bytes: drop its continuation bytes with it.
    while (!head.empty() && (static_cast<unsigned char>(head.back()) & 0xC0) == 0x80) head.pop_back();
    if (!head.empty()) head.pop_back();
  }
  return head.empty() ? head : head + "…";
}

}  // namespace scarp
