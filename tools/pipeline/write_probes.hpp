// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "solver/core/probe.hpp"
#include "tools/pipeline/artefacts.hpp"

namespace scarp {

/// Removes the tables of an earlier run.
void clear_earlier_probes(const Artefacts& artefacts);

/// The probes of a run and their tables: probes/NAME.csv, a header with units and a row per sample, an empty cell for
/// what is not a number.
class ProbeWriter {
 public:
  /// @param probes  in local coordinates
  /// @throws Error ("solve"), see Probe.
  ProbeWriter(const std::vector<ProbeOptions>& probes, const Model& model);

  void look(const Model& model, double time);
  /// Writes all tables as they are now.
  void write(const Artefacts& artefacts) const;
  /// Name and file of each, and which material point is watched.
  nlohmann::ordered_json summary(const Model& model);

 private:
  struct Table {
    std::string name;
    Probe probe;
    double every = 0;  ///< s; 0: each sample
    double next = 0;   ///< s, when the next row is due
    std::string text;
  };
  std::vector<Table> tables_;
  std::vector<double> rows_;
};

}  // namespace scarp
