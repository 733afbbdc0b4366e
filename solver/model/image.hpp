// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// A finished picture: 8-bit RGB, row 0 at the top, rows stored one after the other.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Rgb8> pixels;

  Rgb8& at(int column, int row) { return pixels[static_cast<std::size_t>(row) * width + column]; }
  const Rgb8& at(int column, int row) const { return pixels[static_cast<std::size_t>(row) * width + column]; }
};

}  // namespace scarp
