// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a probe sees of a model at an instant, as rows of a table. Sums run over the particles in the order of the
// model: the same bits for any number of threads.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/probe_options.hpp"

namespace scarp {

/// Columns (units at the end of each name, as in "displacement_x_m"; stress and strain in the order xx, yy, zz, xy, yz,
/// xz, tension positive; positions in the site's coordinates, plane strain per metre):
/// point  time, place, displacement, velocity, Cauchy stress, logarithmic strain ln(F F^T) / 2, equivalent plastic
///        strain of one material point
/// line   time, distance of the bin's middle from the start, particles in it and their means
/// plane  time, force and moment about the plane's point that the side which the normal points to exerts on the other,
///        force along the normal, area. The stress of each particle enters with a hat a cell wide on either side,
///        F = sum V sigma n w(d / h) / h: exact where stress varies linearly across two cells; in strong bending the
///        shear is off by some percent
/// box    time, particles, mass, volume, centre of mass, means; largest displacement, speed, von Mises stress and
///        equivalent plastic strain, least and largest mean stress
/// What has no particles is NaN.
class Probe {
 public:
  /// @param options  in local coordinates
  /// @throws Error ("solve") where the shape is none: no length, no normal, corners out of order.
  Probe(const ProbeOptions& options, const Model& model);

  const std::vector<std::string>& columns() const { return columns_; }

  /// Appends a row (of a line one per bin) to `table`, columns().size() values each.
  void measure(const Model& model, double time, std::vector<double>& table);

  /// Of a watch point: its material point now, index into Model::particles; else -1.
  std::int64_t watched(const Particles& particles);

 private:
  ProbeShape shape_;
  std::vector<std::string> columns_;
  std::int64_t id_ = -1;   ///< of the watched particle, which may be sorted anew
  std::size_t place_ = 0;  ///< where it stood last
};

}  // namespace scarp
