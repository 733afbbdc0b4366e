// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "solver/model/error.hpp"
#include "solver/model/frame.hpp"
#include "solver/model/heightfield.hpp"
#include "solver/model/image.hpp"
#include "solver/model/mesh.hpp"
#include "solver/model/parallel.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/scenario.hpp"
#include "solver/model/write_whole.hpp"
#include "tests/support/test_data.hpp"

namespace scarp {
namespace {

TEST(Error, NamesPlaceValueAndWhatIsAllowed) {
  const Error error("scenario", "density of material 'soil'", "-1900", "above 0 kg/m3", {"a.toml", 3, 11, -1});
  EXPECT_STREQ(error.what(), "a.toml:3:11: density of material 'soil': found -1900; allowed: above 0 kg/m3");
}

TEST(Shortest, ReadsBackAndWritesPlainDigits) {
  EXPECT_EQ(shortest(500000), "500000");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-0.00012), "-0.00012");
  EXPECT_EQ(shortest(1e300), "1e+300");
  for (double value : {1.0 / 3, 5412345.6789, 1e-9 / 7, -1e15 / 3}) EXPECT_EQ(std::stod(shortest(value)), value);
}

TEST(WriteWhole, LeavesTheOldFileWhenTheWriterFails) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "sub" / "a.txt";
  write_whole(path, "old");
  EXPECT_THROW(write_whole(path, [](const auto&) { throw Error("test", "no"); }), Error);
  std::ifstream in(path);
  std::string text;
  in >> text;
  EXPECT_EQ(text, "old");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".tmp"));
}

TEST(Particles, EveryFieldIsResizedAndPermuted) {
  Particles particles;
  resize_particles(particles, 3);
  for (int i = 0; i < 3; ++i) particles.id[i] = i;
  permute_particles(particles, {2, 0, 1});
  EXPECT_EQ(particles.id, (std::vector<std::int64_t>{2, 0, 1}));
  for_each_field(particles, [](const char* name, const char*, auto& values, const auto&) {
    EXPECT_EQ(values.size(), 3u) << name;
  });
}

TEST(Heightfield, IsBilinearAndNaNOutside) {
  Heightfield field{2, 2, 2.0, 0.0, 0.0, {0, 1, 2, 3}, {}};
  EXPECT_DOUBLE_EQ(height_at(field, 1, 1), 1.5);
  EXPECT_DOUBLE_EQ(height_at(field, 2, 2), 3);
  EXPECT_TRUE(std::isnan(height_at(field, 2.01, 0)));
}

}  // namespace
}  // namespace scarp
