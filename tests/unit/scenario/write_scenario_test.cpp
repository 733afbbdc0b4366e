// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/write_scenario.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/scenario/scenario_texts.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/toml_text.hpp"

namespace scarp {
namespace {

using test::kDisks;
using test::kHillside;
class WriteScenario : public test::ScenarioFolder {};

TEST_F(WriteScenario, ReadsBackToTheSame) {
  for (const std::string& text : {kDisks, kHillside}) {
    for (const bool resolved : {false, true}) {
      Scenario scenario = parse(text);
      if (resolved) resolve_defaults(scenario);
      const std::string written = to_toml(scenario);
      // Another folder: input files must have been written so that they are found again.
      const Scenario again = parse_scenario(written, "again.toml", "/");
      EXPECT_EQ(to_toml(again), written);
      EXPECT_EQ(again.title, scenario.title);
      ASSERT_EQ(again.bodies.size(), scenario.bodies.size());
      for (std::size_t i = 0; i < again.bodies.size(); ++i) {
        EXPECT_EQ(again.bodies[i].volume.index(), scenario.bodies[i].volume.index());
        EXPECT_EQ(again.bodies[i].velocity, scenario.bodies[i].velocity);
      }
      EXPECT_EQ(again.solver.gravity.has_value(), resolved || scenario.solver.gravity.has_value());
    }
  }
}

TEST_F(WriteScenario, KeepsEveryBitAndEveryCharacter) {
  Scenario scenario = parse(kHillside);
  std::get<MohrCoulomb>(scenario.materials["colluvium"]).cohesion = 0.1 + 0.2;
  std::get<MohrCoulomb>(scenario.materials["colluvium"]).youngs_modulus = 1.0 / 3 * 1e25;
  scenario.solver.end_time = std::numeric_limits<double>::denorm_min();
  scenario.domain.cell = 1e-7;
  scenario.solver.max_steps = std::numeric_limits<std::int64_t>::max();
  scenario.title = "quote \" backslash \\ newline \n tab \t bell \a delete \x7f umlaut \u00fc";
  std::get<ScanVolume>(scenario.bodies[0].volume).outline.clear();
  for (int i = 0; i < 3000; ++i)
    std::get<ScanVolume>(scenario.bodies[0].volume).outline.push_back({std::sqrt(i), std::cbrt(i)});
  std::get<PrismRule>(scenario.bodies[0].materials[3]).prism = std::get<ScanVolume>(scenario.bodies[0].volume).outline;
  const std::string written = to_toml(scenario);
  const Scenario again = parse(written);
  EXPECT_EQ(to_toml(again), written);
  EXPECT_EQ(std::get<MohrCoulomb>(again.materials.at("colluvium")).cohesion, 0.1 + 0.2);
  EXPECT_EQ(std::get<MohrCoulomb>(again.materials.at("colluvium")).youngs_modulus, 1.0 / 3 * 1e25);
  EXPECT_EQ(again.solver.end_time, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(again.solver.max_steps, scenario.solver.max_steps);
  EXPECT_EQ(again.title, scenario.title);
  EXPECT_EQ(std::get<ScanVolume>(again.bodies[0].volume).outline,
            std::get<ScanVolume>(scenario.bodies[0].volume).outline);
  EXPECT_EQ(std::get<PrismRule>(again.bodies[0].materials[3]).prism.size(), 3000u);
}

TEST_F(WriteScenario, WritesInTheStyleOfAPerson) {
  Scenario scenario = parse(kDisks);
  resolve_defaults(scenario);
  const std::string written = to_toml(scenario);
  for (const char* part :
       {"title = \"Two elastic disks\"\nscans = []\n", "\n[domain]\ndimension = 2\ncell = 0.025\nmin = [0.0, 0.0]\n",
        "\n[materials.elastic]\nmodel = \"neo-hookean\"\ndensity = 1000.0\n", "\n[[bodies]]\nname = \"left\"\n",
        "volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }\n", "velocity = [0.1, 0.1]\n",
        "points_per_cell = 4\n", "gravity = [0.0, 0.0]\n", "history_every = 0.005\n"})
    EXPECT_NE(written.find(part), std::string::npos) << part << "not in\n" << written;
  EXPECT_EQ(written.find("[materials]"), std::string::npos);
}

TEST_F(WriteScenario, RefusesWhatIsNotFinite) {
  Scenario scenario = parse(kDisks);
  scenario.solver.end_time = INFINITY;
  EXPECT_THROW(to_toml(scenario), Error);
}

TEST(TomlDouble, IsShortAndAFloat) {
  EXPECT_EQ(toml_double(0), "0.0");
  EXPECT_EQ(toml_double(-0.0), "-0.0");
  EXPECT_EQ(toml_double(1900), "1900.0");
  EXPECT_EQ(toml_double(2e7), "20000000.0");
  EXPECT_EQ(toml_double(0.1), "0.1");
  EXPECT_EQ(toml_double(1e-7), "1.0e-07");
  EXPECT_EQ(toml_double(1.5e300), "1.5e+300");
}

TEST_F(WriteScenario, DefaultsBecomeExplicit) {
  Scenario scenario = parse(kHillside);
  resolve_defaults(scenario);
  EXPECT_EQ(scenario.solver.gravity, (Vec3{0, 0, -9.81}));
  EXPECT_EQ(scenario.output.every, 1.0);
  EXPECT_EQ(scenario.output.history_every, 0.1);
  EXPECT_EQ(scenario.bodies[0].points_per_cell, 8);
  EXPECT_EQ(scenario.bodies[1].points_per_cell, 27);
  EXPECT_EQ(scenario.compare[0].name, "last_after");
  EXPECT_EQ(scenario.compare[0].max_distance, 5);
  EXPECT_EQ(scenario.compare[0].simulated_spacing, 0.25) << "cells of 0.5 m, 8 points in each";
  const std::string once = to_toml(scenario);
  resolve_defaults(scenario);
  EXPECT_EQ(to_toml(scenario), once);

  Scenario flat = parse(test::with(test::with(kDisks, "gravity = [0, 0]\n", ""), "points_per_cell = 4\n", ""));
  resolve_defaults(flat);
  EXPECT_EQ(flat.solver.gravity, (Vec3{0, -9.81, 0}));
  EXPECT_EQ(flat.bodies[0].points_per_cell, 4);
}

TEST_F(WriteScenario, LocalizingMovesPositionsAndNothingElse) {
  Scenario scenario = parse(kHillside, {"domain.min=[0, 0, 0]", "domain.max=[100, 100, 500]"});
  const Scenario before = scenario;
  localize_scenario(scenario, {1000, 200, 30});
  EXPECT_EQ(scenario.domain.min, (Vec3{-1000, -200, -30}));
  EXPECT_EQ(scenario.domain.max, (Vec3{-900, -100, 470}));
  EXPECT_EQ(std::get<Crop>(scenario.scans[0].clean[0]).max, (Vec3{-800, -80, 60}));
  EXPECT_EQ(std::get<ScanVolume>(scenario.bodies[0].volume).outline[1], (Vec2{-990, -200}));
  EXPECT_EQ(std::get<ScanVolume>(scenario.bodies[4].volume).base_elevation, 365.5);
  EXPECT_EQ(std::get<BoxRule>(scenario.bodies[0].materials[2]).box.min, (Vec3{-1000, -200, -30}));
  EXPECT_EQ(std::get<PrismRule>(scenario.bodies[0].materials[3]).prism[2], (Vec2{-996, -196}));
  EXPECT_EQ(std::get<BoxVolume>(scenario.bodies[2].volume).box.max, (Vec3{-996, -195, -24}));
  EXPECT_EQ(std::get<SphereVolume>(scenario.bodies[3].volume).sphere.centre, (Vec3{-999, -198, -27}));
  localize_scenario(scenario, {-1000, -200, -30});
  EXPECT_EQ(to_toml(scenario), to_toml(before));
}

}  // namespace
}  // namespace scarp
