// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/checked_positions.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "solver/model/error.hpp"

namespace scarp {

void check_positions(const std::vector<Vec3>& positions) {
  constexpr double kLargestCoordinate = 1e100;  // m; its square is still finite
  if (positions.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error("neighbours", "too many points for a search tree", std::to_string(positions.size()), "below 2^32");
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (double c : positions[i])
      if (!(std::abs(c) <= kLargestCoordinate))
        throw Error("neighbours", "a coordinate of point " + std::to_string(i) + " cannot be searched", shortest(c),
                    "finite numbers");
}

}  // namespace scarp
