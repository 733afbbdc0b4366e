// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Stages whose artefacts later ones read, by their section in summary.json.
enum class Maker { ingest, discretize, solver };

/// Notes in summary.json which sections of the scenario the artefacts of a stage come from.
void record_made_from(const Project& project, Maker maker);

/// A stage that is run alone must not mix artefacts of another scenario with this one.
/// Artefacts without a note (copied here by hand) are taken as they are.
/// @throws Error naming the section that has changed and the verb to run.
void require_made_from(const Project& project, Maker maker);

/// The same as a note, for stages that show artefacts as they are and compute nothing from what has changed.
void warn_unless_made_from(const Project& project, Maker maker);

}  // namespace scarp
