// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "solver/core/aligned_array.hpp"
#include "solver/core/total_body.hpp"
#include "solver/kernels/nodal.hpp"

namespace scarp {

/// A run of eight nodes along x.
struct NodeBlock {
  std::int32_t x = 0, y = 0, z = 0;  ///< lattice index of the first
};

/// A row of nodes that a slab shares with one before it: the slab adds to a copy, which is added to the row's sums.
struct SharedRow {
  std::uint32_t node = 0;   ///< first node
  std::uint32_t count = 0;  ///< nodes, whole blocks
  std::uint32_t copy = 0;   ///< first place of the copy in the array of sums
};

/// Segments that one thread sweeps, of which `runs` are of one law's kernel each.
struct Slab {
  struct Run {
    std::uint32_t begin = 0, end = 0;
    kernels::LawKind law{};
  };
  std::uint32_t begin = 0, end = 0;  ///< segments
  std::vector<Run> runs;
};

/// Where everything of a total-Lagrangian body stands for the kernels. Built once; depends on the model alone, not on
/// threads or processor, so that results do not either.
///
/// Nodes stand in blocks of eight along x, only those near occupied cells, rows after rows. Slabs are runs of whole
/// rows of cells; rows of nodes that two slabs touch belong to the first, and the second adds to a copy.
struct NodalLayout {
  static constexpr std::uint32_t kEmpty = 0xffffffffu;  ///< a slot without a particle

  int dimension = 3;
  double cell = 0;
  Vec3 origin{0, 0, 0};
  std::vector<NodeBlock> blocks;
  std::size_t sums = 0;  ///< places in the array of sums: nodes and copies
  std::vector<kernels::Segment> segments;
  std::vector<Slab> slabs;
  std::vector<SharedRow> shared;
  AlignedArray points;                    ///< see kernels::Segment
  std::size_t history = 0;                ///< doubles
  std::vector<std::uint32_t> slots;       ///< [segment][place][lane]: index into Model::particles, or kEmpty
  std::vector<std::uint64_t> slot_begin;  ///< per segment
  std::vector<std::uint32_t> first;       ///< per segment: the first particle of its cells; it rises
  std::vector<std::uint32_t> node_of;     ///< per node of the ReferenceGrid: its place here

  std::size_t nodes() const { return blocks.size() * kernels::kSegment; }
};

/// @param laws  per material of the model its kernel's parameters; all that the body's particles have must be there
NodalLayout lay_out(const Model& model, const TotalBody& body,
                    const std::vector<std::optional<kernels::LawParameters>>& laws);

/// Place of a particle in its cell, 0 to 1, as the kernels take it.
Vec3 place_in_cell(const NodalLayout& layout, const kernels::Segment& segment, int place, int lane);

}  // namespace scarp
