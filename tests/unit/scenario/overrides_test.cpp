// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/overrides.hpp"

#include "tests/unit/scenario/scenario_texts.hpp"

namespace scarp {
namespace {

using test::kDisks;
using test::kHillside;
class Overrides : public test::ScenarioFolder {};

TEST_F(Overrides, SetValuesOfEveryKind) {
  const Scenario s =
      parse(kDisks, {"domain.cell=0.05", "title=Two soft disks", "bodies.0.cell = 4 cm",
                     "bodies.right.velocity=[0, \"1 km/h\"]", "materials.elastic.density=1.5 t/m3",
                     "domain.boundary.y_min=roller", "domain.max.1=2", "output.fields=[\"velocity\"]",
                     "materials.\"new one\"={ model = 'linear-elastic', density = 1, youngs_modulus = 1, "
                     "poissons_ratio = 0 }",
                     "bodies.right.material=new one", "bodies.right.volume.disk.radius=0.1"});
  EXPECT_EQ(s.domain.cell, 0.05);
  EXPECT_EQ(s.title, "Two soft disks");
  EXPECT_EQ(s.bodies[0].cell, 0.04);
  EXPECT_NEAR(s.bodies[1].velocity[1], 1 / 3.6, 1e-15);
  EXPECT_EQ(std::get<NeoHookean>(s.materials.at("elastic")).density, 1500);
  EXPECT_EQ(s.domain.boundary.y_min, Condition::roller);
  EXPECT_EQ(s.domain.max, (Vec3{1, 2, 0}));
  EXPECT_EQ(s.output.fields, (std::vector<OutputField>{OutputField::velocity}));
  EXPECT_EQ(s.bodies[1].material, "new one");
  EXPECT_EQ(std::get<DiskVolume>(s.bodies[1].volume).disk.radius, 0.1);
}

TEST_F(Overrides, TakeANameThatIsANumberForTheName) {
  const Scenario s = parse(kDisks, {"bodies.0.name=\"1\"", "bodies.1.cell=0.04"});
  EXPECT_EQ(s.bodies[0].cell, 0.04);
  EXPECT_FALSE(s.bodies[1].cell);
}

TEST_F(Overrides, TheLastOneWins) {
  EXPECT_EQ(parse(kDisks, {"domain.cell=0.05", "domain.cell=0.1"}).domain.cell, 0.1);
}

TEST_F(Overrides, MakeTablesThatAreMissing) {
  const Scenario s = parse(kHillside, {"render.overview.camera={}", "compare.0.tolerance.median=0.2",
                                       "scans.after.synthetic.slide.depth=4", "domain.min=[0,0,0]"});
  EXPECT_EQ(s.render[0].camera.view, View::oblique);
  EXPECT_EQ(s.compare[0].tolerance.median, 0.2);
  EXPECT_EQ(s.scans[1].synthetic->slide->depth, 4);
  const std::string bare = test::with(kDisks, "[output]\nevery = 0.05\nhistory_every = 0.005\n", "");
  EXPECT_EQ(parse(bare, {"output.every=0.5"}).output.every, 0.5);
}

TEST_F(Overrides, TextThatOnlyLooksLikeTomlStaysText) {
  EXPECT_EQ(parse(kDisks, {"title=a\nb = 1"}).title, "a\nb = 1");
  EXPECT_EQ(parse(kDisks, {"title=[a"}).title, "[a");
  EXPECT_EQ(parse(kDisks, {"title="}).title, "");
  EXPECT_EQ(parse(kDisks, {"title=a=b"}).title, "a=b");
}

TEST_F(Overrides, ErrorsNameTheArgument) {
  const auto starts = [&](const std::string& argument, const std::string& says) {
    const std::string said = error_of(kDisks, {argument});
    EXPECT_EQ(said.substr(0, says.size()), says);
  };
  starts("domain.cell=-1", "--set domain.cell=-1: domain.cell is out of range: found -1; allowed: above 0 m");
  starts("domain.cel=1", "--set domain.cel=1: unknown key \"cel\" in domain (did you mean \"cell\"?)");
  starts("domian.cell=1", "--set domian.cell=1: unknown key \"domian\" in the scenario (did you mean \"domain\"?)");
  starts(
      "bodies.lift.material=x",
      "--set bodies.lift.material=x: bodies has no entry named \"lift\" (did you mean \"left\"?); allowed: \"left\", "
      "\"right\", or an index from 0");
  starts("bodies.2.material=x", "--set bodies.2.material=x: bodies has no entry 2; allowed: 0 to 1");
  starts("domain.cell.x=1", "--set domain.cell.x=1: domain.cell holds a single value; it has no \"x\"");
  starts("materials.elastik.density=1",
         "--set materials.elastik.density=1: materials.elastik lacks the required key \"model\"");
  starts("bodies.0.material=elastik", "--set bodies.0.material=elastik: bodies.left.material: there is no material");
  starts("domain.cell", "--set domain.cell: an override needs a value; allowed: --set key.path=value");
  starts("=1", "--set =1: an override needs a key between the dots");
  starts("domain..cell=1", "--set domain..cell=1: an override needs a key between the dots");
  starts("title=" + std::string(900000, '['), "--set title=[[[[");
  starts(
      "a" +
          [] {
            std::string path;
            for (int i = 0; i < 100; ++i) path += ".a";
            return path;
          }() +
          "=1",
      "--set a.a.a");
}

}  // namespace
}  // namespace scarp
