// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solver/model/body_options.hpp"
#include "solver/model/heightfield.hpp"
#include "solver/model/model.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// What the rules of a body may ask for beside the points themselves.
struct RuleContext {
  int dimension = 3;
  const std::map<std::string, Heightfield>& surfaces;  ///< by InputFile::path, local
  const PointCloud* scan = nullptr;                    ///< of a terrain solid
  const std::vector<std::uint32_t>& scan_points;       ///< for each point of the body; empty if no rule asks for it
};

/// True if a rule asks for the nearest scan point.
bool needs_scan_points(const BodyOptions& options);

/// Gives each point of model.bodies[body] its material, rule after rule, and its mass. Writes
/// points_beside_rule_surface, particle_volume and volume_by_material of the report.
/// @throws Error ("discretize") naming the body and the rule for an unknown material or surface, a class rule without
/// a classified scan, or a `below` rule in 2D.
void assign_materials(const BodyOptions& options, const RuleContext& context, std::size_t body, int threads,
                      Model& model, VolumeReport& report);

}  // namespace scarp
