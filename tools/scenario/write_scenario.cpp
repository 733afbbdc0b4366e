// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/write_scenario.hpp"

#include <algorithm>

#include "tools/scenario/schema_writer.hpp"

namespace scarp {

std::string to_toml(const Scenario& scenario) {
  TomlValue root = SchemaWriter(scenario.domain.dimension).write(scenario);
  if (scenario.only_surveys())
    std::erase_if(root.children,
                  [](const TomlValue& v) { return v.key != "title" && v.key != "scans" && v.key != "compare"; });
  return print_toml(root);
}

}  // namespace scarp
