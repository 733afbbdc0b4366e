// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/scenario/scenario_texts.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {
namespace {

using test::kDisks;

using TransferKeys = test::ScenarioFolder;

TEST_F(TransferKeys, ReadAndWrite) {
  const Scenario s = parse(kDisks, {"solver.transfer=\"xpic\"", "solver.xpic_order=5"});
  EXPECT_EQ(s.solver.transfer, Transfer::xpic);
  const Scenario again = parse(to_toml(s));
  EXPECT_EQ(again.solver.transfer, Transfer::xpic);
  EXPECT_EQ(again.solver.xpic_order, 5);
  EXPECT_EQ(parse(to_toml(parse(kDisks, {"solver.transfer=\"apic\""}))).solver.transfer, Transfer::apic);
}

TEST_F(TransferKeys, ThoseOfAnotherTransferAreRefused) {
  const auto error = [&](const std::vector<std::string>& overrides) { return error_of(kDisks, overrides); };
  EXPECT_NE(error({"solver.transfer=\"apic\"", "solver.flip=0.9"}).find("solver.transfer = \"flip\""),
            std::string::npos);
  EXPECT_NE(error({"solver.transfer=\"xpic\"", "solver.pic_rate=2"}).find("solver.transfer = \"flip\""),
            std::string::npos);
  EXPECT_NE(error({"solver.transfer=\"apic\"", "solver.reference_update=3"}).find("does not go with"),
            std::string::npos);
  EXPECT_NE(error({"solver.xpic_order=3"}).find("solver.transfer = \"xpic\""), std::string::npos);
  EXPECT_NE(error({"solver.transfer=\"xpic\"", "solver.xpic_order=6"}).find("5"), std::string::npos);
  EXPECT_NE(error({"solver.transfer=\"pic\""}).find("\"apic\""), std::string::npos);
}

}  // namespace
}  // namespace scarp
