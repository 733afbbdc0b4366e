// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact on the grid (Bardenhagen, Brackbill, Sulsky 2000; method.md 1.3) between the fields of an UpdatedGrid.
//
// Where a place of the lattice has nodes of two fields a and b, their velocities may not bring the bodies nearer than
// what is between them. n, the normal of the pair, out of a: the volume of each field is smoothed over cells by
// quadratic B-splines, and g = - grad of this volume fraction at the node's place. Of the directions g_a, - g_b and
// g_a - g_b the pair takes the one along which the two are farthest apart (that of the separating axis): beside an
// edge that lies on a plane it is the plane's, where a mean would be tilted and plough.
//
// The gap is that between the particles themselves, as balls of half the edge of their volume, which end at the
// boundary that their body was cut from, or a round rim would have the facets of its lattice:
//   gap = min over b of (x_p . n - r_p) - max over a of (x_p . n + r_p),
// and the pair may approach by no more than it in a step. p are the particles with phi_Ip > 0 that a line along n
// through the node's place passes within h / 2 + r_p: what is farther to the side is the next node's, and counted here
// too it would make round bodies touch over the whole reach of the function, too early and too stiffly. No constant
// depends on the shape functions or on particles per cell. The usual test, a distance of mass-weighted positions below
// 0.8 h, stands for it where two particles per axis and linear functions meet on a line of nodes: the positions of
// surfaces that touch are 0.67 to 1 h apart as the line moves through the cell, farther with wider functions.
//
// The impulse along n stops the approach; that across it, at most mu times as large, stops the sliding (Coulomb). Both
// are equal and opposite for a pair: momentum is kept to rounding. Where more than two fields meet, the pairs are
// swept over until they agree (projected Gauss-Seidel, with impulses that add up and are limited as a whole).
//
// What the nodes' mapped velocities v_I have of approach when a step begins is taken from them without an impulse: like
// a node on a wall, they are bound, and what the particles carry goes into strain. So the impulses that particles
// get are reactions to forces alone, which do no work, where stopping v_I each step would take energy out at a rate
// that does not vanish with the step: lumped maps to and fro bring the approach back each time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/core/contact_laws.hpp"
#include "solver/core/updated_grid.hpp"

namespace scarp {

class GridContact {
 public:
  /// @throws Error ("solve") where pairs of materials leave open how two bodies rub.
  GridContact(const Model& model, const UpdatedGrid& grid);

  /// Finds normals and gaps of the particles as they are placed.
  void look(const Particles& particles, const UpdatedGrid& grid, int threads);

  /// Takes the approach from mapped velocities: before forces act; and after a step, for the velocity gradient.
  /// `grid.kept`: axes along which nodes do not move as their mass would have it.
  void hold(UpdatedGrid& grid, double dt, int threads);
  void hold_after(UpdatedGrid& grid, double dt, int threads);

  /// Stops v~_I. The energy lost, J.
  /// @param handed  how much of what hold has taken from v_I the transfer hands to the particles: 0 with FLIP
  double act(UpdatedGrid& grid, double dt, double handed, int threads);

  /// Impulse on each body of the model since the last call, N s.
  const std::vector<Vec3>& impulse() const { return impulse_; }
  /// Of the arrays that do not depend on where bodies meet.
  double memory_bytes() const {
    return 16.0 * static_cast<double>(radius_.size()) +
           4.0 * static_cast<double>(first_at_node_.size() + fields_at_block_.size());
  }
  void forget_impulse() { impulse_.assign(impulse_.size(), Vec3{0, 0, 0}); }

 private:
  /// A place of the lattice with nodes of several fields.
  struct Place {
    std::array<std::int32_t, 3> at{};
    std::uint32_t node_begin = 0, node_end = 0;  ///< range in place_nodes_
    std::uint32_t pair_begin = 0, pair_end = 0;  ///< range in pairs_
  };
  struct PlaceNode {
    std::uint32_t node = 0, field = 0;
    Vec3 outward{0, 0, 0};  ///< g, per cell
  };
  struct Pair {
    std::uint32_t a = 0, b = 0;  ///< which of place_nodes_
    Vec3 n{0, 0, 0};             ///< out of a; none: they do not touch
    double gap = 0;              ///< m
    ContactLaw law;
    double pull = 0;        ///< that adhesion bears, N
    Vec3 impulse{0, 0, 0};  ///< that hold, and then act, has given to b, N s
  };

  void fit_to_boundaries();
  void follow(const UpdatedGrid& grid);
  void find_near_nodes(const UpdatedGrid& grid);
  void list_places(const UpdatedGrid& grid);
  void want_cells(const UpdatedGrid& grid);
  void smooth_volumes(const Particles& particles, const UpdatedGrid& grid, int threads);
  double volume_fraction(const UpdatedGrid& grid, std::uint32_t field, std::array<std::int32_t, 3> cell) const;
  template <class Matters, class F>
  void each_in_reach(const UpdatedGrid& grid, const Place& place, std::uint32_t field,
                     const std::array<bool, 3>& from_above, Matters&& matters, F&& f) const;
  void find_outward(const UpdatedGrid& grid, const Place& place);
  double area_along(const UpdatedGrid& grid, const Place& place, std::uint32_t field, const Vec3& n) const;
  void find_gap(const Particles& particles, const UpdatedGrid& grid, const Place& place, Pair& pair) const;
  template <class Allowed>
  void bind(UpdatedGrid& grid, std::vector<Vec3>& velocity, bool rubs, double dt, int threads, Allowed&& allowed);

  const Model& model_;
  std::vector<ContactLaw> laws_;  ///< per pair of fields
  std::vector<Place> places_;
  std::vector<PlaceNode> place_nodes_;
  std::vector<Pair> pairs_;
  std::uint64_t followed_ = 0;                  ///< UpdatedGrid::placings
  std::vector<std::uint32_t> fields_at_block_;  ///< per block of the lattice: the one field there, kNone or kMany
  std::vector<std::uint32_t> first_at_node_;    ///< per node of the lattice: place_nodes_'s chain; kNone between calls
  std::vector<std::uint8_t> near_;              ///< per node
  std::vector<std::uint32_t> near_nodes_, next_;  ///< and the next of the chain
  std::vector<std::uint64_t> wanted_;             ///< per block: cells whose particles matter
  std::vector<std::uint32_t> tile_of_block_;      ///< per block: which of volume_tiles_, or kNone
  std::vector<std::uint32_t> wanted_blocks_;
  std::vector<double> volume_tiles_;  ///< per wanted block: volume fraction that it gives its cells and those around
  std::vector<double> fit_;           ///< per particle of the model: its radius in halves of its edge
  std::vector<double> radius_;        ///< per particle of the model, m; of wanted cells
  std::vector<double> largest_in_block_;  ///< of them, per wanted block, m
  double largest_radius_ = 0;             ///< m
  std::vector<Vec3> before_;              ///< per place node: velocity before act
  std::vector<Vec3> impulse_;             ///< per body of the model, N s
};

}  // namespace scarp
