// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/write_scenario.hpp"

#include "tools/scenario/schema_writer.hpp"

namespace scarp {

std::string to_toml(const Scenario& scenario) {
  return print_toml(SchemaWriter(scenario.domain.dimension).write(scenario));
}

}  // namespace scarp
