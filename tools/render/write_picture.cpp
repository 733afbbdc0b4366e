// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/write_picture.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"

namespace scarp {

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t expected = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (expected == 0 || picture.pixels.size() != expected)
    throw Error("render", "an empty picture cannot be written to " + path.string());
  // OpenCV only reads what this points to.
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3, const_cast<Rgb8*>(picture.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", bgr, bytes)) throw Error("render", "the PNG encoder failed for " + path.string());
  write_whole(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Picture read_png(const std::filesystem::path& path) {
  const cv::Mat bgr = std::filesystem::is_regular_file(path) ? cv::imread(path.string(), cv::IMREAD_COLOR) : cv::Mat();
  if (bgr.empty()) throw Error("render", "not a picture that can be read", {}, "a PNG file", {path.string()});
  Picture picture{bgr.cols, bgr.rows, std::vector<Rgb8>(bgr.total())};
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, picture.pixels.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return picture;
}

}  // namespace scarp
