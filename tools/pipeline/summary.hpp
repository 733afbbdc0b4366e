// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "solver/model/reports.hpp"
#include "tools/pipeline/artefacts.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Replaces one section of summary.json and keeps the others; peak memory and title are brought up to date.
void record_summary(const Project& project, const std::string& section, const nlohmann::ordered_json& content);

/// A JSON artefact of ours. @throws Error naming the file when it is missing or damaged.
nlohmann::ordered_json read_json(const std::filesystem::path& path);
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& content);

nlohmann::ordered_json to_json(const Vec3& vector);
nlohmann::ordered_json to_json(const IngestReport& report);
nlohmann::ordered_json to_json(const VolumeReport& report);
nlohmann::ordered_json to_json(const HistorySample& sample);
nlohmann::ordered_json to_json(const DistanceReport& report);

}  // namespace scarp
