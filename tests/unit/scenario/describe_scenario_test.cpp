// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/describe_scenario.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "solver/model/error.hpp"
#include "solver/model/scenario.hpp"
#include "tools/scenario/schema_kinds.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {
namespace {

/// A walk over the schema on its own: every key with its sentence.
struct Walk {
  std::set<std::pair<std::string, std::string>> keys;

  template <class T>
  void into() {
    if constexpr (is_optional<T> || is_list<T>) {
      into<typename T::value_type>();
    } else if constexpr (is_map<T>) {
      into<typename T::mapped_type>();
    } else if constexpr (Choice<T>) {
      for_each_alternative<T>([&]<class A>() { into<A>(); });
    } else if constexpr (Described<T>) {
      T sample;
      sample.describe([&](std::string_view key, auto& member, const Spec& spec) {
        keys.emplace(key, spec.text);
        into<std::remove_reference_t<decltype(member)>>();
      });
    }
  }
};

std::string without_layout(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\n') out += c;
  return out;
}

TEST(Describe, HasEveryKeyOfTheSchema) {
  Walk walk;
  walk.into<Scenario>();
  EXPECT_GT(walk.keys.size(), 90u);
  const std::string page = describe_markdown();
  for (const auto& [key, text] : walk.keys) {
    EXPECT_NE(page.find("| `" + key + "` |"), std::string::npos) << key;
    EXPECT_NE(page.find("| " + text + " |\n"), std::string::npos) << key;
    const std::string asked = describe_keys(key);
    EXPECT_NE(asked.find("\n  " + key + " "), std::string::npos) << asked;
  }
}

TEST(Describe, FitsATerminal) {
  std::istringstream lines(describe_keys(""));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
}

TEST(Describe, GivesTypeUnitRangeDefaultAndCondition) {
  const std::string angle = describe_keys("materials.rock.dilatancy_angle");
  EXPECT_EQ(without_layout(angle.substr(0, angle.find('\n'))), "materials.NAME(model=\"mohr-coulomb\")");
  EXPECT_NE(angle.find("number, deg, at least 0 and  0  "), std::string::npos) << angle;
  const std::string depth = describe_keys("bodies[].volume.depth");
  EXPECT_NE(depth.find("bodies[].volume  (scan)\n  depth "), std::string::npos) << depth;
  EXPECT_NE(depth.find("number, m, above 0"), std::string::npos) << depth;
  EXPECT_EQ(describe_keys("bodies.0.volume.depth"), depth);
  EXPECT_NE(describe_keys("domain.boundary").find("x_max"), std::string::npos);
  EXPECT_NE(describe_keys("domain.cell").find("required"), std::string::npos);
}

TEST(Describe, SuggestsForUnknownKeys) {
  try {
    describe_keys("domain.cel");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no key is called \"domain.cel\" (did you mean \"domain.cell\"?)");
  }
  EXPECT_THROW(describe_keys("zzzzzzzzzzzz"), Error);
}

TEST(Suggest, FindsWhatIsNear) {
  const std::vector<std::string> known{"cell", "courant", "friction_angle", "mohr-coulomb"};
  EXPECT_EQ(nearest_word("cel", known), "cell");
  EXPECT_EQ(nearest_word("clel", known), "cell");
  EXPECT_EQ(nearest_word("courrant", known), "courant");
  EXPECT_EQ(nearest_word("friction", known), "friction_angle");
  EXPECT_EQ(nearest_word("MOHR_COULOMB", known), "mohr-coulomb");
  EXPECT_EQ(nearest_word("gravity", known), "");
  EXPECT_EQ(nearest_word("", known), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'c'), known), "");
}

}  // namespace
}  // namespace scarp
