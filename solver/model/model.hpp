// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/materials/material.hpp"
#include "solver/model/body_options.hpp"
#include "solver/model/contact_options.hpp"
#include "solver/model/domain.hpp"
#include "solver/model/ground_motion.hpp"
#include "solver/model/load_options.hpp"
#include "solver/model/mesh.hpp"
#include "solver/model/particles.hpp"
#include "solver/model/reports.hpp"
#include "solver/model/site.hpp"
#include "solver/model/water_table.hpp"

namespace scarp {

struct NamedMaterial {
  std::string name;
  Material law;
};

/// Lattice nodes that something outside the body holds, e.g. the ground below the base of a terrain solid.
struct NodeSet {
  std::string name;
  Condition condition = Condition::fixed;
  int axis = -1;  ///< for rollers: the axis along which the velocity is held at zero
  std::vector<std::array<std::int32_t, 3>> nodes;
};

struct Body {
  std::string name;
  Formulation formulation = Formulation::total_lagrangian;
  Lattice lattice;        ///< reference grid; nodes lie on domain.min + integer multiples of the cell
  std::size_t begin = 0;  ///< range in Model::particles
  std::size_t end = 0;
  std::vector<NodeSet> held;
  /// The surface that the particles were cut from, in the reference configuration; its site is not used. In two
  /// dimensions a prism, see `prism_mesh`. Empty where nobody knows one.
  TriangleMesh boundary;
  double ball_radius = 0;  ///< m; of a ball (2D: a disk) about the centre of its boundary, else 0
  /// Of the run, not stored with the model: motion and surface of a rigid body.
  RigidOptions rigid;
};

/// What discretize hands to the solver: material points with everything that the run needs.
struct Model {
  Domain domain;
  std::vector<NamedMaterial> materials;
  std::vector<Body> bodies;
  Particles particles;
  std::vector<VolumeReport> volumes;  ///< one per body
  SiteFrame site;
  // Of the run, not stored with the model:
  std::vector<LoadOptions> loads;  ///< local
  ContactOptions contact;
  std::vector<GroundMotion> shaking;
  std::optional<WaterTable> water;
  /// Acceleration beside gravity at the reference position X, m/s2.
  std::function<Vec3(const Vec3& X, double time)> body_force;
};

/// Whether HistorySample::contact_force says anything of a body: of rigid ones always, of others where there is
/// contact.
inline bool reports_contact_force(const Model& model, const Body& body) {
  return model.contact.method != ContactMethod::none || body.formulation == Formulation::rigid;
}

}  // namespace scarp
