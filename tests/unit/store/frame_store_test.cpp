// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/frame_store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/hdf5_store.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/store/sample_frame.hpp"

namespace scarp {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(FrameStore, GivesBackEverythingInOrderAndType) {
  test::TemporaryFolder folder;
  for (const std::size_t count : {std::size_t{1}, std::size_t{70000}}) {
    const Frame frame = test::sample_frame(count);
    const auto path = folder.path() / "frames" / "frame_000000.hdf";
    write_frame(path, frame);
    const Frame back = read_frame(path);
    EXPECT_EQ(back.time, frame.time);
    EXPECT_EQ(back.step, frame.step);
    EXPECT_EQ(back.site.origin, frame.site.origin);
    EXPECT_EQ(back.site.crs, frame.site.crs);
    EXPECT_EQ(back.positions, frame.positions);
    ASSERT_EQ(back.fields.size(), frame.fields.size());
    for (std::size_t i = 0; i < frame.fields.size(); ++i) {
      EXPECT_EQ(back.fields[i].name, frame.fields[i].name);
      EXPECT_EQ(back.fields[i].unit, frame.fields[i].unit);
      EXPECT_EQ(back.fields[i].components, frame.fields[i].components);
      EXPECT_EQ(back.fields[i].values, frame.fields[i].values) << frame.fields[i].name;
    }
  }
}

Frame part_of(const Frame& whole, std::size_t begin, std::size_t end) {
  const auto cut = [&](auto values, int components) {
    const auto n = static_cast<std::ptrdiff_t>(components);
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin) * n;
    return decltype(values)(first, first + static_cast<std::ptrdiff_t>(end - begin) * n);
  };
  Frame part = whole;
  part.positions = cut(whole.positions, 1);
  for (FrameField& field : part.fields)
    std::visit([&](auto& values) { values = cut(values, field.components); }, field.values);
  return part;
}

TEST(FrameStore, ComesBackFromParts) {
  test::TemporaryFolder folder;
  const Frame frame = test::sample_frame(150000);
  const auto path = folder.path() / "a.hdf";
  const std::vector<std::size_t> cuts{0, 65536, 131072, 147456, 150000};
  const auto each_part = [&](const auto& append) {
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) append(part_of(frame, cuts[i], cuts[i + 1]));
  };
  write_frame(path, 150000, each_part);
  const Frame back = read_frame(path);
  EXPECT_EQ(back.positions, frame.positions);
  ASSERT_EQ(back.fields.size(), frame.fields.size());
  for (std::size_t i = 0; i < frame.fields.size(); ++i) EXPECT_EQ(back.fields[i].values, frame.fields[i].values);
  EXPECT_THROW(write_frame(path, 150001, each_part), Error) << "too few";
  const auto cut_a_chunk = [&](const auto& append) {
    append(part_of(frame, 0, 1000));
    append(part_of(frame, 1000, 150000));
  };
  EXPECT_THROW(write_frame(path, 150000, cut_a_chunk), Error) << "parts that are not whole chunks";
  EXPECT_EQ(read_frame(path).positions.size(), 150000u) << "the frame from before stands";
}

TEST(FrameStore, SameFrameSameBytesWhateverWasWrittenBefore) {
  test::TemporaryFolder folder;
  const Frame frame = test::sample_frame(40000);
  write_frame(folder.path() / "a.hdf", frame);
  ChunkPacker packer;
  const auto packed = [&](std::uint8_t from) {
    std::vector<unsigned char> values(65536);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<unsigned char>(from + i * i % 251);
    const auto bytes = packer.pack(values, 4, values.size()).value();
    return std::vector<unsigned char>(bytes.begin(), bytes.end());
  };
  const auto first = packed(1);
  EXPECT_NE(packed(7), first);
  EXPECT_EQ(packed(1), first);
  write_frame(folder.path() / "b.hdf", test::sample_frame(100));
  write_frame(folder.path() / "c.hdf", frame);
  EXPECT_EQ(bytes_of(folder.path() / "a.hdf"), bytes_of(folder.path() / "c.hdf"));
}

TEST(FrameStore, WhatCannotBePackedIsStored) {
  ChunkPacker packer;
  std::vector<unsigned char> noise(1 << 20);
  std::uint64_t state = 1;
  for (unsigned char& byte : noise) byte = static_cast<unsigned char>((state = state * 6364136223846793005u + 1) >> 56);
  const auto packed = packer.pack(noise, 8, noise.size());
  ASSERT_TRUE(packed);
  EXPECT_LT(packed->size(), noise.size() + noise.size() / 64);
}

TEST(FrameStore, ADiskThatRefusesLeavesTheOldFrameAndNothingElse) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  write_frame(path, test::sample_frame(10));
  const rlimit allowed = [] {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    return before;
  }();
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{200000, allowed.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  EXPECT_THROW(write_frame(path, test::sample_frame(100000)), Error);
  setrlimit(RLIMIT_FSIZE, &allowed);
  std::signal(SIGXFSZ, old);
  EXPECT_EQ(read_frame(path).positions.size(), 10u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  write_frame(path, test::sample_frame(100000));
  EXPECT_EQ(read_frame(path).positions.size(), 100000u);
}

TEST(FrameStore, SameFrameSameBytesAndNoTemporaryLeft) {
  test::TemporaryFolder folder;
  const auto a = folder.path() / "a.hdf", b = folder.path() / "b.hdf";
  write_frame(a, test::sample_frame(1000));
  write_frame(b, test::sample_frame(1000));
  EXPECT_EQ(bytes_of(a), bytes_of(b));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(FrameStore, EmptyCrsAndNoFieldsAreFine) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  Frame frame;
  frame.positions = {{1, 2, 3}};
  write_frame(path, frame);
  EXPECT_EQ(read_frame(path).site.crs, "");
  EXPECT_TRUE(read_frame(path).fields.empty());
}

TEST(FrameStore, RefusesFramesThatAreNone) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  EXPECT_THROW(write_frame(path, Frame{}), Error);
  EXPECT_THROW(write_frame(folder.path() / "a.vtkhdf", test::sample_frame(2)), Error);
  Frame frame = test::sample_frame(4);
  frame.fields[0].components = 2;
  EXPECT_THROW(write_frame(path, frame), Error);
  frame = test::sample_frame(4);
  frame.fields[0].name = "a/b";
  EXPECT_THROW(write_frame(path, frame), Error);
  frame.fields[0].name = frame.fields[1].name;
  EXPECT_THROW(write_frame(path, frame), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FrameStore, ATruncatedFrameIsRefusedAtAnyLength) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  write_frame(path, test::sample_frame(500));
  const std::string whole = bytes_of(path);
  for (std::size_t length = 0; length < whole.size(); length += 997) {
    write_whole(path, whole.substr(0, length));
    EXPECT_THROW(read_frame(path), Error) << length;
  }
  write_whole(path, whole);
  EXPECT_NO_THROW(read_frame(path));
}

TEST(FrameStore, ForeignFilesAreRefusedWithTheirName) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "foreign.hdf";
  EXPECT_THROW(read_frame(path), Error);           // absent
  EXPECT_THROW(read_frame(folder.path()), Error);  // a folder
  write_whole(path, std::string(5000, 'x'));
  EXPECT_THROW(read_frame(path), Error);
  Hdf5Writer other(path);
  write_format(other, "scarp-model", 1);
  other.finish();
  try {
    read_frame(path);
    ADD_FAILURE() << "a model was read as a frame";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("foreign.hdf"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("scarp-model"), std::string::npos);
  }
}

TEST(SeriesStore, RoundTripsAndEscapes) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "frames.hdf.series";
  const std::vector<std::pair<std::string, double>> frames{
      {"frames/frame_000000.hdf", 0}, {"a \"b\" \\ \n \xc3\xbc.hdf", 0.1}, {"c", 1e-300}};
  write_series(path, frames);
  EXPECT_EQ(read_series(path), frames);
  write_series(path, {});
  EXPECT_TRUE(read_series(path).empty());
  EXPECT_THROW(write_series(path, {{"a", NAN}}), Error);
}

TEST(SeriesStore, ReadsAnyLayoutAndRefusesWhatIsNoSeries) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf.series";
  write_whole(path, "{\"files\":[{\"time\":2,\"name\":\"\\u00fc/\\t\"}],\"file-series-version\":\"1.0\"}");
  EXPECT_EQ(read_series(path), (std::vector<std::pair<std::string, double>>{{"\xc3\xbc/\t", 2.0}}));
  const char* const wrong[] = {"",
                               "{",
                               "[]",
                               "{}",
                               "{\"file-series-version\":\"2.0\",\"files\":[]}",
                               "{\"file-series-version\":\"1.0\",\"files\":[{\"name\":\"a\"}]}",
                               "{\"file-series-version\":\"1.0\",\"files\":[{\"name\":\"a\",\"time\":nan}]}",
                               "{\"file-series-version\":\"1.0\",\"files\":[{\"name\":\"a\",\"time\":1}]} x",
                               "{\"file-series-version\":\"1.0\",\"files\":[{\"name\":\"a"};
  for (const char* text : wrong) {
    write_whole(path, text);
    EXPECT_THROW(read_series(path), Error) << text;
  }
  EXPECT_THROW(read_series(folder.path() / "absent"), Error);
}

// What a reader of the format that is not ours makes of it: VTK's and h5py, where they are installed.
TEST(FrameStore, OtherProgramsReadIt) {
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import h5py, vtkmodules.vtkIOHDF' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "no h5py or no VTK for " << python;
  test::TemporaryFolder folder;
  std::vector<std::pair<std::string, double>> series;
  for (int i = 0; i < 2; ++i) {
    const std::string name = "frames/frame_00000" + std::to_string(i) + ".hdf";
    write_frame(folder.path() / name, test::sample_frame(3000, 0.5 * i));
    series.emplace_back(name, 0.5 * i);
  }
  write_series(folder.path() / "frames.hdf.series", series);
  const std::string check = python + " " SCARP_SOURCE_DIR "/tests/cli/frames_test.py " + folder.path().string();
  EXPECT_EQ(std::system((check + " >/dev/null").c_str()), 0);

  write_frame(folder.path() / series[1].first, test::sample_frame(3000, 0.75));
  EXPECT_NE(std::system((check + " >/dev/null 2>&1").c_str()), 0) << "the series' time is wrong and nobody noticed";
}

}  // namespace
}  // namespace scarp
