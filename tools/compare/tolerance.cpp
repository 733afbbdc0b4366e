// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/tolerance.hpp"

#include <cmath>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {

std::optional<double> find_number(const ComparisonReport& report, const std::string& group,
                                  const std::string& measure) {
  for (const MeasureGroup& g : report.groups)
    for (const Measure& m : g.measures)
      if (g.name == group && m.name == measure)
        if (const double* value = std::get_if<double>(&m.value)) return *value;
  return std::nullopt;
}

namespace {

/// One sentence where a number of a group is outside; `outside(value)` says whether a value that is no NaN is.
template <class F>
std::optional<std::string> excess(const ComparisonReport& report, const std::string& group, const std::string& measure,
                                  const std::string& words, const std::string& limit, F&& outside) {
  const std::optional<double> value = find_number(report, group, measure);
  std::string found = "is not measured by method \"" + report.method + "\" of these data";
  if (value) found = std::isnan(*value) ? "is undefined" : "is " + shortest(*value);
  if (value && !std::isnan(*value) && !outside(*value)) return std::nullopt;
  return report.name + ": " + words + " " + found + "; tolerance " + limit;
}

}  // namespace

bool within_tolerance(const ComparisonReport& report, const CompareTolerance& tolerance,
                      std::vector<std::string>* exceeded) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  bool within = true;
  const auto check = [&](const char* statistic, double DistanceReport::*member, const std::optional<double>& limit) {
    const double value = report.distances ? (*report.distances).*member : kNaN;
    if (!limit || std::abs(value) <= *limit) return;
    within = false;
    if (!exceeded) return;
    std::string found = "is " + shortest(value) + " m";
    if (!report.distances)
      found = "is not measured by method \"" + report.method + "\"";
    else if (std::isnan(value))
      found = "is undefined, " + std::to_string(report.distances->matched) + " of " +
              std::to_string(report.distances->points) + " points matched";
    exceeded->push_back(report.name + ": " + statistic + " distance " + found + "; tolerance " + shortest(*limit) +
                        " m");
  };
  check("mean", &DistanceReport::mean, tolerance.mean);
  check("median", &DistanceReport::median, tolerance.median);
  check("95th percentile", &DistanceReport::percentile_95, tolerance.percentile_95);
  check("largest", &DistanceReport::largest, tolerance.largest);
  const auto note = [&](const std::optional<std::string>& sentence) {
    within = within && !sentence;
    if (sentence && exceeded) exceeded->push_back(*sentence);
  };
  if (tolerance.net_volume)
    note(excess(report, "volumes", "net", "net volume, m3,", "at most " + shortest(*tolerance.net_volume) + " m3",
                [&](double v) { return std::abs(v) > *tolerance.net_volume; }));
  if (tolerance.iou)
    note(excess(report, "footprint", "iou", "overlap of the footprints (IoU)", "at least " + shortest(*tolerance.iou),
                [&](double v) { return v < *tolerance.iou; }));
  return within;
}

}  // namespace scarp
