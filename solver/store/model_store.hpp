// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/model.hpp"

namespace scarp {

/// Writes everything that a Model holds as HDF5:
///
///   /                  format, format_version
///   /site              origin, crs
///   /domain            dimension, cell, min, max, x_min ... z_max
///   /materials/NNNNNN  name, model, and the law's parameters under the names of its `describe`
///   /bodies/NNNNNN     name, formulation, begin, end, lattice; held/NNNNNN: name, condition, axis, nodes (n x 3)
///   /volumes/NNNNNN    the report; by_material/NNNNNN: name, volume
///   /particles         one array per entry of the field list, with its unit; those of the state that are empty are
///   absent
///
/// @throws Error ("store") naming what cannot be stored; Error ("write") if the disk refuses. One thread only.
void write_model(const std::filesystem::path& path, const Model& model);

/// Exactly the model that was written.
/// @throws Error ("store") for a file that is cut off, damaged, of another version, or inconsistent: ranges of
///         bodies outside the particles, indices of materials or bodies that do not exist.
Model read_model(const std::filesystem::path& path);

/// Whether an HDF5 file of ours says that it is a model. @throws Error ("store") for one that is not ours.
bool is_model_file(const std::filesystem::path& path);

}  // namespace scarp
