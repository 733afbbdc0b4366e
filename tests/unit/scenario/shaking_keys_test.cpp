// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include "tests/unit/scenario/scenario_texts.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {
namespace {

using test::kDisks;

class ShakingKeys : public test::ScenarioFolder {
 protected:
  void SetUp() override { std::ofstream(folder_.path() / "quake.csv") << "time (s), a (g)\n0, 0\n1, 0\n"; }
};

const std::string kShaking = "[[shaking]]\nfile = \"quake.csv\"\n";

TEST_F(ShakingKeys, ReadAndWrite) {
  const Scenario s = parse(kDisks + kShaking + "direction = [0, 2]\nscale = 1.5\nunit = \"cm/s2\"\n" +
                           "baseline = \"linear\"\nhigh_pass = 0.1\nstart = 2\n");
  ASSERT_EQ(s.shaking.size(), 1u);
  EXPECT_EQ(s.shaking[0].direction, (Vec3{0, 2, 0}));
  EXPECT_EQ(s.shaking[0].unit, AccelerationUnit::centimetres);
  EXPECT_EQ(s.shaking[0].baseline, Baseline::linear);
  const Scenario again = parse(to_toml(s));
  EXPECT_EQ(again.shaking[0].high_pass, 0.1);
  EXPECT_EQ(again.shaking[0].start, 2);
  EXPECT_EQ(again.shaking[0].file.path, s.shaking[0].file.path);
}

TEST_F(ShakingKeys, WrongOnesAreRefused) {
  EXPECT_NE(error_of(kDisks + kShaking + "direction = [0, 0]\n").find("no length"), std::string::npos);
  EXPECT_NE(error_of(kDisks + kShaking + "base = \"compliant\"\n").find("domain.boundary.y_min = \"absorbing\""),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + kShaking + "face = \"y_min\"\n").find("compliant"), std::string::npos);
  EXPECT_NE(error_of(kDisks + kShaking + "baseline = \"cubic\"\n").find("quadratic"), std::string::npos);
  EXPECT_NE(error_of(kDisks + "[[shaking]]\nfile = \"none.csv\"\n").find("none.csv"), std::string::npos);
  EXPECT_EQ(error_of(kDisks + "[domain.boundary]\ny_min = \"absorbing\"\n" + kShaking + "base = \"compliant\"\n"),
            "no error");
  EXPECT_NE(
      error_of(kDisks + "[domain.boundary]\ny_min = \"absorbing\"\n" + kShaking + "base = \"compliant\"\n" + kShaking)
          .find("do not mix"),
      std::string::npos);
}

using WaterKeys = test::ScenarioFolder;

TEST_F(WaterKeys, ReadWriteAndMove) {
  const Scenario s = parse(kDisks + "[water_table]\nline = [[0, 1], [1, 1.5]]\n", {"solver.gravity=[0, -9]"});
  ASSERT_TRUE(s.water_table.has_value());
  EXPECT_EQ(s.water_table->density, 1000);
  EXPECT_EQ(parse(to_toml(s)).water_table->line, (std::vector<Vec2>{{0, 1}, {1, 1.5}}));
  Scenario local = s;
  localize_scenario(local, {0.5, 1, 0});
  EXPECT_EQ(local.water_table->line[1], (Vec2{0.5, 0.5}));
}

TEST_F(WaterKeys, WrongOnesAreRefused) {
  EXPECT_NE(error_of(kDisks + "[water_table]\n").find("must have one of"), std::string::npos);
  EXPECT_NE(error_of(kDisks + "[water_table]\nelevation = 1\nline = [[0, 1]]\n").find("must have one of"),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + "[water_table]\nline = [[0, 1], [0, 2]]\n").find("x must rise"), std::string::npos);
  EXPECT_NE(error_of(kDisks + "[water_table]\nsurface = \"bedrock.asc\"\n").find("3D"), std::string::npos);
  EXPECT_NE(error_of(kDisks + "[water_table]\nelevation = 1\n", {"solver.gravity=[1, -9]"}).find("straight down"),
            std::string::npos);
}

TEST_F(WaterKeys, K0ReadsAndIsRefused) {
  EXPECT_EQ(parse(kDisks + "[solver.k0]\n", {"solver.gravity=[0, -9]"}).solver.k0->rule, K0Rule::jaky);
  EXPECT_EQ(parse(kDisks + "[solver.k0]\nrule = \"elastic\"\n", {"solver.gravity=[0, -9]"}).solver.k0->rule,
            K0Rule::elastic);
  EXPECT_NE(error_of(kDisks + "[solver.k0]\nratio = 0\n", {"solver.gravity=[0, -9]"}).find("above 0"),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + "[solver.k0]\n", {"solver.gravity=[0, -9]", "solver.gravity_ramp=1"}).find("bears all"),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + "[solver.k0]\n", {"solver.gravity=[0, 9]"}).find("straight down"), std::string::npos);
}

}  // namespace
}  // namespace scarp
