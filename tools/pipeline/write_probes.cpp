// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/write_probes.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void clear_earlier_probes(const Artefacts& artefacts) {
  if (!fs::exists(artefacts.probes())) return;
  std::vector<fs::path> stale;
  for (const fs::directory_entry& entry : fs::directory_iterator(artefacts.probes()))
    if (entry.path().extension() == ".csv") stale.push_back(entry.path());
  for (const fs::path& path : stale) fs::remove(path);
}

ProbeWriter::ProbeWriter(const std::vector<ProbeOptions>& probes, const Model& model) {
  for (const ProbeOptions& options : probes) {
    Table table{options.name, Probe(options, model), options.every.value_or(0), 0, {}};
    for (const std::string& column : table.probe.columns()) table.text += (table.text.empty() ? "" : ",") + column;
    table.text += '\n';
    tables_.push_back(std::move(table));
  }
}

void ProbeWriter::look(const Model& model, double time) {
  for (Table& table : tables_) {
    if (time < table.next) continue;
    constexpr double slack = 1e-9;  // due times are multiples of the interval, samples are them but for rounding
    if (table.every > 0) table.next = (std::floor(time / table.every + slack) + 1 - slack) * table.every;
    rows_.clear();
    table.probe.measure(model, time, rows_);
    const std::size_t columns = table.probe.columns().size();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!std::isnan(rows_[i])) table.text += shortest(rows_[i]);
      table.text += (i + 1) % columns == 0 ? '\n' : ',';
    }
  }
}

void ProbeWriter::write(const Artefacts& artefacts) const {
  for (const Table& table : tables_) write_whole(artefacts.probe(table.name), table.text);
}

Json ProbeWriter::summary(const Model& model) {
  Json list = Json::array();
  for (Table& table : tables_) {
    Json entry{{"name", table.name}, {"file", "probes/" + table.name + ".csv"}};
    if (const std::int64_t p = table.probe.watched(model.particles); p >= 0) {
      const auto index = static_cast<std::size_t>(p);
      entry["particle"] = model.particles.id[index];
      entry["reference_position_m"] = to_json(model.particles.reference_position[index] + model.site.origin);
    }
    list.push_back(entry);
  }
  return list;
}

}  // namespace scarp
