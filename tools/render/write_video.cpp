// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "tools/render/write_picture.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;

constexpr double kSteadyRate = 10;  ///< frames per second below which players stumble

/// While a codec is tried, OpenCV and FFmpeg tell the log and standard error; what matters is in the report.
class Quiet {
 public:
  Quiet() : log_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {
    std::fflush(stderr);
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing < 0) return;
    saved_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    if (saved_ >= 0) ::dup2(nothing, STDERR_FILENO);
    ::close(nothing);
  }
  ~Quiet() {
    std::fflush(stderr);
    if (saved_ >= 0) {
      ::dup2(saved_, STDERR_FILENO);
      ::close(saved_);
    }
    cv::utils::logging::setLogLevel(log_);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  cv::utils::logging::LogLevel log_;
  int saved_ = -1;
};

/// A file that is removed again unless it has been renamed.
class Draft {
 public:
  explicit Draft(fs::path path) : path_(std::move(path)) {}
  ~Draft() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Plan {
  cv::Size size;    ///< of a frame, even
  double rate = 0;  ///< frames per second in the file
  int repeat = 1;   ///< frames per picture
  std::int64_t frames = 0;
};

cv::Mat read_frame(const fs::path& path, const cv::Size& expected) {
  cv::Mat picture = fs::is_regular_file(path) ? cv::imread(path.string(), cv::IMREAD_COLOR) : cv::Mat();
  if (picture.empty()) throw Error("render", "a picture of the video cannot be read", {}, {}, {path.string()});
  if (!expected.empty() && picture.size() != expected)
    throw Error("render", "a picture of the video has another size",
                std::to_string(picture.cols) + " x " + std::to_string(picture.rows),
                std::to_string(expected.width) + " x " + std::to_string(expected.height), {path.string()});
  return picture;
}

Plan plan_video(const cv::Size& picture, std::size_t count, double frames_per_second) {
  Plan plan;
  plan.size = {picture.width + picture.width % 2, picture.height + picture.height % 2};
  plan.repeat = std::max(1, static_cast<int>(std::ceil(kSteadyRate / frames_per_second - 1e-9)));
  plan.rate = frames_per_second * plan.repeat;
  plan.frames = static_cast<std::int64_t>(count) * plan.repeat;
  return plan;
}

/// Returns why it failed, or nothing.
std::string encode(const fs::path& path, const std::vector<fs::path>& pictures, const cv::Size& size, const Plan& plan,
                   const std::string& code) {
  assert(code.size() == 4);
  cv::VideoWriter writer;
  {
    const Quiet quiet;
    const int fourcc = cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]);
    writer.open(path.string(), cv::CAP_FFMPEG, fourcc, plan.rate, plan.size);
  }
  if (!writer.isOpened()) return "no encoder opens";
  for (const fs::path& name : pictures) {
    cv::Mat frame;
    cv::copyMakeBorder(read_frame(name, size), frame, 0, plan.size.height - size.height, 0,
                       plan.size.width - size.width, cv::BORDER_REPLICATE);
    for (int k = 0; k < plan.repeat; ++k) writer.write(frame);
  }
  writer.release();
  return {};
}

/// Returns what is wrong with the file, or nothing: an encoder that fails half-way says nothing itself.
std::string check(const fs::path& path, const Plan& plan) {
  std::error_code failure;
  if (fs::file_size(path, failure) == 0 || failure) return "the encoder left an empty file";
  cv::VideoCapture reader;
  {
    const Quiet quiet;
    reader.open(path.string(), cv::CAP_FFMPEG);
  }
  if (!reader.isOpened()) return "the file does not open again";
  cv::Mat first;
  if (!reader.read(first) || first.size() != plan.size) return "the first frame does not decode in its size";
  std::int64_t count = 1;
  while (count <= plan.frames && reader.grab()) ++count;
  if (count != plan.frames)
    return "the file has " + std::to_string(count) + " frames instead of " + std::to_string(plan.frames);
  return {};
}

}  // namespace

std::vector<VideoFormat> video_formats() { return {{"avc1", ".mp4", "H.264"}, {"VP80", ".webm", "VP8"}}; }

VideoReport write_video(const fs::path& stem, const std::vector<fs::path>& pictures, double frames_per_second,
                        const std::vector<VideoFormat>& formats) {
  if (pictures.empty()) throw Error("render", "a video needs at least one picture", stem.string());
  if (!(frames_per_second > 0) || !(frames_per_second <= 1000))
    throw Error("render", "speed of the video", shortest(frames_per_second), "above 0, at most 1000 per second");
  const cv::Size size = read_frame(pictures.front(), {}).size();
  const Plan plan = plan_video(size, pictures.size(), frames_per_second);
  VideoReport report;
  for (const VideoFormat& format : formats) {
    const fs::path file = stem.string() + format.extension;
    const Draft draft(stem.string() + ".draft" + format.extension);
    std::string reason = encode(draft.path(), pictures, size, plan, format.code);
    if (reason.empty()) reason = check(draft.path(), plan);
    if (reason.empty()) {
      write_whole(
          file, [&](const fs::path& temporary) { fs::rename(draft.path(), temporary); }, true);
      report.file = file;
      report.codec = format.codec;
      return report;
    }
    report.reason_for_fallback += (report.reason_for_fallback.empty() ? "" : "; ") + format.codec + ": " + reason;
  }
  report.codec = "PNG sequence only";
  return report;
}

}  // namespace scarp
