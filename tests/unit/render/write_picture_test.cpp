// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/write_picture.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;

Picture test_picture(int width, int height, int shift) {
  Picture picture{width, height, std::vector<Rgb8>(static_cast<std::size_t>(width) * height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at(x, y) = {static_cast<std::uint8_t>((x + shift) % 256), static_cast<std::uint8_t>(y % 256),
                          static_cast<std::uint8_t>(shift % 256)};
  return picture;
}

std::vector<fs::path> write_pictures(const fs::path& folder, int count, int width, int height) {
  std::vector<fs::path> paths;
  for (int i = 0; i < count; ++i) {
    paths.push_back(folder / ("p_" + std::to_string(i) + ".png"));
    write_png(paths.back(), test_picture(width, height, 9 * i));
  }
  return paths;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

unsigned big_endian(const std::string& bytes, std::size_t at, int count) {
  unsigned value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

/// What the file's own tables say, read without the library that wrote it (ISO/IEC 14496-12: stsz, avc1).
struct Mp4 {
  unsigned frames, width, height;
};

Mp4 read_mp4(const fs::path& path) {
  const std::string bytes = bytes_of(path);
  const std::size_t sizes = bytes.find("stsz"), entry = bytes.find("avc1", bytes.find("stsd"));
  return {big_endian(bytes, sizes + 12, 4), big_endian(bytes, entry + 28, 2), big_endian(bytes, entry + 30, 2)};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WritePng, RoundTrips) {
  const test::TemporaryFolder folder;
  const Picture picture = test_picture(37, 21, 5);
  write_png(folder.path() / "sub" / "a.png", picture);
  const Picture back = read_png(folder.path() / "sub" / "a.png");
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.pixels, picture.pixels);
  EXPECT_EQ(files_in(folder.path() / "sub"), 1u);
  EXPECT_THROW(write_png(folder.path() / "b.png", Picture{}), Error);
  EXPECT_THROW(read_png(folder.path() / "absent.png"), Error);
}

TEST(WriteVideo, HoldsAllPicturesInTheirSize) {
  const test::TemporaryFolder folder;
  const auto pictures = write_pictures(folder.path(), 7, 128, 96);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const VideoReport report = write_video(folder.path() / "over.view", pictures, 10);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  if (report.codec != "H.264") GTEST_SKIP() << "no H.264 encoder here: " << report.reason_for_fallback;
  EXPECT_EQ(report.file, folder.path() / "over.view.mp4");
  EXPECT_EQ(report.reason_for_fallback, "");
  const Mp4 video = read_mp4(report.file);
  EXPECT_EQ(video.frames, 7u);
  EXPECT_EQ(video.width, 128u);
  EXPECT_EQ(video.height, 96u);
  EXPECT_EQ(files_in(folder.path()), 8u);  // no draft is left
}

TEST(WriteVideo, MakesOddSizesEvenAndHoldsStillsAtLowSpeed) {
  const test::TemporaryFolder folder;
  const auto pictures = write_pictures(folder.path(), 3, 101, 75);
  const VideoReport report = write_video(folder.path() / "v", pictures, 2);
  if (report.codec != "H.264") GTEST_SKIP() << "no H.264 encoder here: " << report.reason_for_fallback;
  const Mp4 video = read_mp4(report.file);
  EXPECT_EQ(video.frames, 15u);  // each picture for half a second at ten frames a second
  EXPECT_EQ(video.width, 102u);
  EXPECT_EQ(video.height, 76u);
}

TEST(WriteVideo, FallsBackAndSaysWhy) {
  const test::TemporaryFolder folder;
  const auto pictures = write_pictures(folder.path(), 3, 64, 48);
  const VideoFormat unknown{"zzzz", ".mp4", "nothing"};
  testing::internal::CaptureStderr();
  const VideoReport second = write_video(folder.path() / "v", pictures, 10, {unknown, {"VP80", ".webm", "VP8"}});
  const VideoReport none = write_video(folder.path() / "w", pictures, 10, {unknown});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(second.reason_for_fallback.find("nothing: "), std::string::npos);
  EXPECT_EQ(none.file, fs::path());
  EXPECT_EQ(none.codec, "PNG sequence only");
  if (second.file.empty()) GTEST_SKIP() << "no VP8 encoder here: " << second.reason_for_fallback;
  EXPECT_EQ(second.file, folder.path() / "v.webm");
  EXPECT_EQ(files_in(folder.path()), 4u);
}

TEST(WriteVideo, RefusesPicturesOfSeveralSizesAndLeavesNothing) {
  const test::TemporaryFolder folder;
  auto pictures = write_pictures(folder.path(), 2, 64, 48);
  write_png(folder.path() / "other.png", test_picture(64, 50, 0));
  pictures.push_back(folder.path() / "other.png");
  EXPECT_THROW(write_video(folder.path() / "v", pictures, 10), Error);
  EXPECT_EQ(files_in(folder.path()), 3u);
  EXPECT_THROW(write_video(folder.path() / "v", {}, 10), Error);
  EXPECT_THROW(write_video(folder.path() / "v", {folder.path() / "absent.png"}, 10), Error);
}

}  // namespace
}  // namespace scarp
