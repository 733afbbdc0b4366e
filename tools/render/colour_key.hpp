// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/render/colour_field.hpp"
#include "tools/render/colour_map.hpp"
#include "tools/render/render.hpp"
#include "tools/render/ticks.hpp"

namespace scarp {

/// The key to the colours: a bar for a scalar, swatches for classes, nothing for the scan's own colours.
struct ColourKey {
  ColourKind kind = ColourKind::scalar;
  std::string label;  ///< in words
  DisplayUnit unit;
  ColourScale scale;                     ///< SI
  Ticks ticks;                           ///< in display units
  bool below = false;                    ///< some frame has values below the bar
  bool above = false;                    ///< some frame has values above it
  bool missing = false;                  ///< some frame has points without a value
  std::vector<int> classes;              ///< indices met
  std::vector<std::string> class_names;  ///< one for each of `classes`

  std::string unit_text() const { return unit.symbol.empty() ? "" : " (" + unit.symbol + ")"; }
};

/// Takes a value (SI, must be finite) into the histogram of a scene.
void count_value(std::vector<std::uint64_t>& histogram, float value);

/// The key for all frames of the scene. The range is the options' or that of the scene rounded outwards; if one in ten
/// thousand values would stretch it more than threefold, they lie beyond its ends.
/// @throws Error ("render") for a range that is not increasing.
ColourKey make_colour_key(const Scene& scene, const ColourField& field, const ColourOptions& options,
                          const RenderContext& context);

}  // namespace scarp
