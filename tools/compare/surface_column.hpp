// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the surface lies above one material point of it, from the volume that its neighbours fill.
#pragma once

#include <optional>
#include <vector>

#include "ingest/neighbours/point_tree.hpp"
#include "tools/compare/material_points.hpp"

namespace scarp {

/// A piece of surface as a column of material sees it.
struct SurfacePiece {
  Vec3 position{0, 0, 0};  ///< m
  Vec3 normal{0, 0, 1};    ///< out of the body
  double height = 0;       ///< from the particle's centre along the column, in spacings
  double coverage = 0;     ///< share of the kernel that material fills, 1 inside of a body
};

/// Columns along normals through material points.
///
/// Around the particle, neighbours are taken back by its deformation gradient, where the frame has it, onto the regular
/// lattice that they were made on (lengths in spacings); without it, or once it is bent beyond all lattices (condition
/// above 6), lengths are only divided by the spacing. The volume of each neighbour is spread across the column by a
/// smooth kernel w (Wendland's C2 in the plane, support 3 spacings, unit integral). What they fill above the foot of
/// the column, 2 spacings below the particle,
///   T = sum over neighbours of V w(distance from the axis) s(height above the foot),
/// is the mean height of the surface above that level, with no bias by the lattice: volume is conserved. The step s is
/// as smooth and 2 spacings wide. A sharp one would always cut the lattice at the same place between two of its layers,
/// since the foot goes with the particle: where layers are 1 / sqrt(2) apart, as across a diagonal, it would take half
/// a layer too much or too little everywhere. Of the smooth one a sum over layers up to a spacing apart is the integral
/// to 0.002. The axis stands up to half a spacing beside the particle, so that the axes of all particles fill the
/// surface evenly: were they to stand on lattice points, they would see the material that they stand on too often.
/// Beside an edge of the body the kernel is partly empty; T is then divided by the share that is filled one layer
/// below. In layers thinner than the column the surface is half a thickness above the middle of the material.
class SurfaceColumns {
 public:
  /// Both must outlive the columns; the tree holds points.positions.
  SurfaceColumns(const MaterialPoints& points, const PointTree& tree) : points_(points), tree_(tree) {}

  /// @returns nothing where hardly any material is about: a particle on its own, or two
  std::optional<SurfacePiece> at(std::size_t point, const Vec3& normal) const;

  /// The direction out of the body: against the gradient of the volume within 3 spacings, weighed by the same kernel.
  /// Its length is 0 in a place that has as much on either side, up to about 1.
  Vec3 outwards(std::size_t point) const;

 private:
  const MaterialPoints& points_;
  const PointTree& tree_;
};

/// Second moment of the kernel along one axis, in squared spacings: a curved surface s comes out as
/// s + 1/2 kKernelMoment (s_uu + s_vv).
inline constexpr double kKernelMoment = 0.625;

}  // namespace scarp
