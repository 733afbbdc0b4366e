// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/core/cell_list.hpp"
#include "solver/core/total_body.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// Where a body of material points ends: at the boundary that it was cut from, if Body knows it. Otherwise its
/// particles are smeared, chi(X) = sum_p V0 S((X - X_p) / s) / s^D with the quadratic B-spline S and their spacing s;
/// the surface is chi = 1/2. That is exact for a face along the lattice and midway between layers for any other plane
/// of the lattice, so that the volume inside is the particles'; but round bodies keep the lattice's steps, over which
/// they will not roll where a slope is less than the steps'.
///
/// Each particle of the outermost layer carries one point of it, the boundary's nearest or that along the smoothed
/// gradient from its centre. Points
/// are fixed to the material: y = x(Y), with the shape functions of the particle's cell continued to Y, so that what
/// pushes at y does the work and has the moment that it should.
struct ContactSurface {
  double spacing = 0;                   ///< s, m
  int corners = 0;                      ///< nodes per point
  std::vector<std::uint32_t> particle;  ///< index into Model::particles, ascending
  std::vector<Vec3> Y;                  ///< m
  std::vector<Vec3> N;                  ///< outward normal in the reference configuration
  std::vector<double> area;             ///< of the surface that belongs to the point, m2 (2D: m)
  std::vector<std::uint32_t> cell;      ///< of the ReferenceGrid
  std::vector<std::uint32_t> nodes;     ///< `corners` per point: of the ReferenceGrid, or where its body keeps them
  std::vector<std::uint32_t> distinct;  ///< each of them once
  std::vector<double> weights;          ///< phi_I(Y)
  double cell_edge = 0;                 ///< of the ReferenceGrid, m
  std::vector<Vec3> xi;                 ///< place of X_p in its cell, where the normal's F is taken
  std::vector<double> mobility;         ///< 1/kg: at most so much acceleration at a point for its share of a unit force

  std::size_t size() const { return particle.size(); }
};

/// Edge of the mean volume of a body's particles, m.
double mean_spacing(const Model& model, const Body& body);

/// @param body  of which `total` was made; particles sorted by cell
ContactSurface find_contact_surface(const Model& model, const Body& body, const TotalBody& total);

}  // namespace scarp
