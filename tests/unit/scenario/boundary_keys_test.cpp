// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/scenario/scenario_texts.hpp"
#include "tools/scenario/describe_scenario.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {
namespace {

using test::kDisks;

class BoundaryKeys : public test::ScenarioFolder {
 protected:
  static std::string with_text(const std::string& keys) { return kDisks + "[domain.boundary]\n" + keys + "\n"; }
  Scenario with_boundary(const std::string& keys) { return parse(with_text(keys)); }
};

TEST_F(BoundaryKeys, AFaceIsANameOrATableWithFriction) {
  const BoundaryOptions b =
      with_boundary("x_min = \"absorbing\"\nx_max = \"roller\"\ny_min = { friction = 0.4 }\ny_max = \"fixed\"")
          .domain.boundary;
  EXPECT_EQ(b.x_min, Face(FaceCondition::absorbing));
  EXPECT_EQ(b.x_max, Condition::roller);
  EXPECT_EQ(b.y_min, Face(FaceCondition::friction, 0.4));
  EXPECT_EQ(b.y_max, Condition::fixed);
  EXPECT_EQ(b.z_min, Condition::free);
}

TEST_F(BoundaryKeys, WrittenOnesReadBack) {
  const Scenario s = with_boundary("x_min = \"absorbing\"\ny_min = { friction = 0.25 }");
  const Scenario again = parse(to_toml(s));
  EXPECT_EQ(again.domain.boundary.x_min, s.domain.boundary.x_min);
  EXPECT_EQ(again.domain.boundary.y_min, s.domain.boundary.y_min);
  EXPECT_EQ(again.domain.boundary.y_max, s.domain.boundary.y_max);
  EXPECT_NE(to_toml(s).find("y_min = { friction = 0.25 }"), std::string::npos) << to_toml(s);
}

TEST_F(BoundaryKeys, WrongOnesAreRefusedWithWhatIsAllowed) {
  EXPECT_NE(error_of(with_text("x_min = \"friction\"")).find("\"absorbing\""), std::string::npos);
  EXPECT_NE(error_of(with_text("x_min = \"absorbin\"")).find("did you mean \"absorbing\""), std::string::npos);
  EXPECT_NE(error_of(with_text("x_min = { friction = -0.1 }")).find("at least 0"), std::string::npos);
  EXPECT_NE(error_of(with_text("x_min = { }")).find("friction"), std::string::npos);
  EXPECT_NE(error_of(with_text("x_min = { mu = 0.3 }")).find("friction"), std::string::npos);
  EXPECT_NE(error_of(with_text("x_min = 0.4")).find("x_min"), std::string::npos);
  EXPECT_NE(error_of(with_text("z_min = { friction = 0.1 }")).find("plane strain"), std::string::npos);
}

TEST_F(BoundaryKeys, AreDescribed) {
  EXPECT_NE(describe_keys("domain.boundary.x_min").find("table"), std::string::npos);
  EXPECT_NE(describe_keys("domain.boundary.x_min.friction").find("Coulomb"), std::string::npos);
  EXPECT_EQ(describe_keys("bodies.volume.base").find("absorbing"), std::string::npos);
}

const std::string kLoad = R"([[loads]]
name = "footing"
where = { box = { min = [0.4, 0.9], max = [0.6, 1] } }
)";

TEST_F(BoundaryKeys, LoadsReadWriteAndMove) {
  const Scenario s = parse(kDisks + kLoad + "traction = [0, \"-10 kPa\"]\ntable = [[0, 0], [1, 1]]\n");
  ASSERT_EQ(s.loads.size(), 1u);
  EXPECT_EQ(s.loads[0].name, "footing");
  EXPECT_EQ(s.loads[0].traction, (Vec3{0, -10000, 0}));
  EXPECT_EQ(s.loads[0].table, (std::vector<Vec2>{{0, 0}, {1, 1}}));
  EXPECT_EQ(s.loads[0].where.box->max, (Vec3{0.6, 1, 0}));
  const Scenario again = parse(to_toml(s));
  EXPECT_EQ(again.loads[0].traction, s.loads[0].traction);
  EXPECT_EQ(again.loads[0].table, s.loads[0].table);
  Scenario local = s;
  localize_scenario(local, {0.25, 0.5, 0});
  EXPECT_EQ(local.loads[0].where.box->min, (Vec3{0.4 - 0.25, 0.9 - 0.5, 0}));
  EXPECT_EQ(local.loads[0].traction, s.loads[0].traction);
}

TEST_F(BoundaryKeys, WrongLoadsAreRefused) {
  EXPECT_NE(error_of(kDisks + kLoad).find("loads.footing must have one of"), std::string::npos);
  EXPECT_NE(error_of(kDisks + kLoad + "force = [0, 1]\nvelocity = [0, 1]\n").find("must have one of"),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + kLoad + "displacement = [0, 1]\n").find("0 at time 0"), std::string::npos);
  EXPECT_NE(error_of(kDisks + kLoad + "displacement = [0, 1]\ntable = [[0, 0.1], [1, 1]]\n").find("0 at time 0"),
            std::string::npos);
  EXPECT_NE(error_of(kDisks + kLoad + "velocity = [0, 1]\naxes = \"w\"\n").find("axes"), std::string::npos);
  EXPECT_NE(error_of(kDisks + kLoad + "force = [0, 1]\ntable = [[1, 0], [0, 1]]\n").find("times must rise"),
            std::string::npos);
}

TEST_F(BoundaryKeys, ARegionIsABoxAFaceOrABody) {
  const std::string load = "[[loads]]\nforce = [0, 1]\nwhere = ";
  const LoadRegion region = parse(kDisks + load + "{ face = \"y_min\", body = \"left\" }\n").loads[0].where;
  EXPECT_EQ(region.face, FaceName::y_min);
  EXPECT_EQ(region.body, "left");
  EXPECT_FALSE(region.box.has_value());
  EXPECT_NE(error_of(kDisks + load + "{ }\n").find("must say where"), std::string::npos);
  EXPECT_NE(error_of(kDisks + load + "{ face = \"z_min\" }\n").find("no faces in z"), std::string::npos);
  EXPECT_NE(error_of(kDisks + load + "{ body = \"lefd\" }\n").find("did you mean \"left\""), std::string::npos);
}

TEST_F(BoundaryKeys, StartsAtRestReadAndWrite) {
  const Scenario s = parse(kDisks + "[solver.relax]\nuntil = 1e-8\n");
  ASSERT_TRUE(s.solver.relax.has_value());
  EXPECT_EQ(s.solver.relax->until, 1e-8);
  EXPECT_EQ(s.solver.relax->damping, 0.7);
  EXPECT_EQ(parse(to_toml(s)).solver.relax->until, 1e-8);
  EXPECT_FALSE(parse(kDisks).solver.relax.has_value());
}

}  // namespace
}  // namespace scarp
