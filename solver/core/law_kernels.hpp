// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/kernels/choose_kernels.hpp"
#include "solver/kernels/nodal.hpp"
#include "solver/kernels/particles.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// What the kernel of a law needs, or nothing where the law, or an option of it, has none.
std::optional<kernels::LawParameters> kernel_of(const Material& material);

/// The same for each of the model's materials.
std::vector<std::optional<kernels::LawParameters>> kernels_of(const Model& model);

/// The fields of particles that carry their state.
kernels::ParticleArrays arrays_of(Particles& particles);

/// The kernels of the widest packs up to `widest` that cells fill best, where lanes are the particles of one cell.
/// @param cell_begin  range of each cell in a list of particles
template <class Index>
const kernels::Kernels& best_filled(const std::vector<Index>& cell_begin, const kernels::Kernels& widest) {
  const auto taken = [&](std::size_t lanes) {  // filled or not
    std::size_t sum = 0;
    for (std::size_t c = 0; c + 1 < cell_begin.size(); ++c)
      sum += (cell_begin[c + 1] - cell_begin[c] + lanes - 1) / lanes * lanes;
    return static_cast<double>(sum);
  };
  const kernels::Kernels* best = &widest;
  for (const kernels::Kernels& narrower : kernels::available_kernels())
    if (narrower.lanes < best->lanes &&
        taken(static_cast<std::size_t>(narrower.lanes)) < 0.8 * taken(static_cast<std::size_t>(best->lanes)))
      best = &narrower;
  return *best;
}

}  // namespace scarp
