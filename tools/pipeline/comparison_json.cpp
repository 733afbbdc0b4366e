// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "tools/pipeline/summary.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

/// The unit stands in the key, as in the other artefacts: "mean_m", "added_m3", "matching_percent".
std::string key_of(const Measure& measure) {
  if (measure.unit == "1" || measure.unit.empty()) return measure.name;
  return measure.name + "_" + (measure.unit == "%" ? "percent" : measure.unit);
}

Json to_json(const MeasureGroup& group) {
  Json table{{"convention", group.convention}};
  for (const Measure& measure : group.measures)
    std::visit([&](const auto& value) { table[key_of(measure)] = value; }, measure.value);
  return table;
}

MeasureGroup as_group(const DistanceReport& report) {
  return {"distances",
          report.convention +
              " Statistics over matched points, null where there are none: standard deviation with n - 1; nmad = "
              "1.482602 median(abs(d - median)); percentile_95 and largest of abs(d); quantiles linear between ranks.",
          {{"points", static_cast<std::int64_t>(report.points)},
           {"matched", static_cast<std::int64_t>(report.matched)},
           {"max_distance", report.max_distance, "m"},
           {"mean", report.mean, "m"},
           {"median", report.median, "m"},
           {"standard_deviation", report.standard_deviation, "m"},
           {"nmad", report.nmad, "m"},
           {"root_mean_square", report.root_mean_square, "m"},
           {"mean_absolute", report.mean_absolute, "m"},
           {"percentile_95", report.percentile_95, "m"},
           {"largest", report.largest, "m"}}};
}

}  // namespace

Json to_json(const ComparisonReport& report) {
  Json json{{"name", report.name}, {"method", report.method}, {"convention", report.convention}};
  json["names_of_sides"] = {{"simulated", report.sides.simulated}, {"observed", report.sides.observed}};
  if (report.distances) json["distances"] = to_json(as_group(*report.distances));
  for (const MeasureGroup& group : report.groups) json[group.name] = to_json(group);
  json["warnings"] = report.warnings;
  return json;
}

}  // namespace scarp
