// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/scenario/scenario_texts.hpp"
#include "tools/scenario/describe_scenario.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {
namespace {

using test::kDisks;

class RigidKeys : public test::ScenarioFolder {
 protected:
  /// A rigid plate beside the two disks.
  static std::string with_plate(const std::string& rigid, const std::string& more = "") {
    return kDisks +
           "[[bodies]]\nname = \"plate\"\nvolume = { box = { min = [0, 0], max = [1, 0.1] } }\nmaterial = "
           "\"elastic\"\nvelocity = [0, 1]\nformulation = \"rigid\"\n" +
           more + (rigid.empty() ? "" : "rigid = { " + rigid + " }\n");
  }
};

TEST_F(RigidKeys, ReadWriteAndMove) {
  Scenario s = parse(with_plate(
      "motion = \"given\", angular_velocity = 2, about = [0.5, 0.25], table = [[0, 0], [1, 1]], surface = { friction = "
      "0.4 }, grips = [\"left\"]"));
  const RigidOptions rigid = *s.bodies.back().rigid;
  EXPECT_EQ(rigid.motion, RigidMotion::given);
  EXPECT_EQ(rigid.angular_velocity, 2);
  EXPECT_EQ(rigid.surface, (RigidSurface{false, 0.4}));
  EXPECT_EQ(rigid.grips, std::vector<std::string>{"left"});
  const RigidOptions again = *parse(to_toml(s)).bodies.back().rigid;
  EXPECT_EQ(again.table, rigid.table);
  EXPECT_EQ(again.about, rigid.about);
  EXPECT_EQ(again.surface, rigid.surface);
  localize_scenario(s, {1, 2, 3});
  EXPECT_EQ(*s.bodies.back().rigid->about, (Vec3{-0.5, -1.75, -3}));
  EXPECT_EQ(s.bodies.back().velocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(parse(with_plate("motion = \"fixed\"")).bodies.back().rigid->surface, (RigidSurface{true, 0}));
  EXPECT_EQ(parse(with_plate("motion = \"fixed\", surface = \"smooth\"")).bodies.back().rigid->surface,
            (RigidSurface{false, 0}));
}

TEST_F(RigidKeys, WrongOnesAreRefusedWithWhatIsAllowed) {
  EXPECT_NE(error_of(with_plate("")).find("motion"), std::string::npos);
  EXPECT_NE(error_of(with_plate("surface = \"rough\"")).find("motion"), std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"still\"")).find("\"fixed\""), std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"given\", surface = \"ruff\"")).find("\"rough\""), std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"given\", grips = [\"lift\"]")).find("did you mean \"left\""),
            std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"given\", axis = [0, 1]")).find("plane strain"), std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"given\", table = [[1, 0], [1, 1]]")).find("must rise"), std::string::npos);
  EXPECT_NE(error_of(with_plate("motion = \"given\"", "velocity_field = [\"X\", \"Y\"]\n")).find("velocity_field"),
            std::string::npos);
  std::string deforming = with_plate("motion = \"given\"");
  deforming.replace(deforming.find("formulation = \"rigid\""), 21, "formulation = \"updated-lagrangian\"");
  EXPECT_NE(error_of(deforming).find("formulation = \"rigid\""), std::string::npos) << deforming;
}

TEST_F(RigidKeys, AreDescribed) {
  EXPECT_NE(describe_keys("bodies.rigid").find("grips"), std::string::npos);
  EXPECT_NE(describe_keys("bodies.rigid.surface").find("rough"), std::string::npos);
}

}  // namespace
}  // namespace scarp
