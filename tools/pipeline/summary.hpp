// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "solver/model/comparison_report.hpp"
#include "solver/model/reports.hpp"
#include "tools/pipeline/artefacts.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Replaces one section of summary.json and keeps the others; peak memory and title are brought up to date.
void record_summary(const Project& project, const std::string& section, const nlohmann::ordered_json& content);

/// What summary.json holds so far; an empty object when there is none. @throws Error when it is damaged.
nlohmann::ordered_json read_summary(const Project& project);

/// A JSON artefact of ours. @throws Error naming the file when it is missing or damaged.
nlohmann::ordered_json read_json(const std::filesystem::path& path);
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& content);

nlohmann::ordered_json to_json(const Vec3& vector);
nlohmann::ordered_json to_json(const IngestReport& report);
nlohmann::ordered_json to_json(const VolumeReport& report);
/// What the user should know of a solid beside its volume: one sentence each.
std::vector<std::string> warnings(const VolumeReport& report);
nlohmann::ordered_json to_json(const HistorySample& sample);
nlohmann::ordered_json to_json(const ComparisonReport& report);

}  // namespace scarp
