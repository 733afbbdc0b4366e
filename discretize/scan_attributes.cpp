// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/scan_attributes.hpp"

#include "ingest/neighbours/neighbours.hpp"

namespace scarp {

std::vector<std::uint32_t> find_scan_points(const SubLattice& grid, const Columns& columns, const PointCloud& scan,
                                            std::size_t begin, std::size_t end, int threads,
                                            const Particles& particles) {
  const Neighbours neighbours(scan.positions);
  const auto nearest = [&](const Vec3& p) {
    const auto found = neighbours.closest(p);
    return found ? static_cast<std::uint32_t>(found->index) : 0u;
  };
  std::vector<std::uint32_t> over_column(grid.columns(), 0);
  parallel_for(grid.columns(), threads, [&](std::size_t c) {
    if (columns.first[c] == columns.first[c + 1]) return;
    const auto i = static_cast<std::int32_t>(c % grid.x.count), j = static_cast<std::int32_t>(c / grid.x.count);
    over_column[c] = nearest({grid.x.at(i), grid.y.at(j), columns.top[c]});
  });
  std::vector<std::uint32_t> scan_points(end - begin);
  parallel_for(end - begin, threads, [&](std::size_t n) {
    const Vec3& p = particles.reference_position[begin + n];
    const std::size_t c = grid.column(grid.x.nearest(p[0]), grid.y.nearest(p[1]));
    const bool highest = grid.up.nearest(p[2]) + 1 == columns.spans[columns.first[c + 1] - 1].end;
    scan_points[n] = particles.surface[begin + n] && !highest ? nearest(p) : over_column[c];
  });
  return scan_points;
}

void paint(const PointCloud& scan, const std::vector<std::uint32_t>& scan_points, std::size_t begin, int threads,
           Particles& particles) {
  parallel_for(scan_points.size(), threads, [&](std::size_t n) {
    const Rgb16& colour = scan.colour[scan_points[n]];
    for (int a = 0; a < 3; ++a) particles.colour[begin + n][a] = static_cast<std::uint8_t>((colour[a] + 128) / 257);
  });
}

}  // namespace scarp
