// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/shaking.hpp"

#include <string>

#include "solver/model/error.hpp"
#include "solver/model/load_options.hpp"

namespace scarp {

Vec3 mean_base_acceleration(const std::vector<GroundMotion>& shaking, double time, double dt) {
  if (shaking.empty()) return {0, 0, 0};
  return (1 / dt) * (base_velocity(shaking, time + dt) - base_velocity(shaking, time));
}

void send_waves(NodeFaces& faces, const std::vector<GroundMotion>& shaking, double time, double dt) {
  for (int side = 0; side < 6; ++side) {
    Vec3 sum{0, 0, 0};
    bool any = false;
    for (const GroundMotion& motion : shaking) {
      if (motion.base != ShakenBase::compliant || motion.side != side) continue;
      any = true;
      const double mean = (motion.displacement(time + dt) - motion.displacement(time)) / dt;
      sum = sum + (motion.share * mean) * motion.direction;
    }
    if (any) faces.send_in(side, sum);
  }
}

void check_shaking(const Model& model) {
  const Domain& domain = model.domain;
  for (const GroundMotion& motion : model.shaking) {
    const double length = norm(motion.direction);
    if (!(std::abs(length - 1) < 1e-9) || (domain.dimension == 2 && motion.direction[2] != 0))
      throw Error("solve", "direction of a shaking", shortest(length) + " long",
                  domain.dimension == 2 ? "a unit vector in the plane" : "a unit vector");
    if (motion.base != model.shaking.front().base)
      throw Error("solve", "bases of several shakings", "rigid and compliant", "all rigid, or all compliant");
    if (motion.base == ShakenBase::rigid) continue;
    if (motion.side < 0 || motion.side >= 2 * domain.dimension)
      throw Error("solve", "face of a shaking", std::to_string(motion.side), "a face of the domain");
    if (domain.faces[motion.side].condition != FaceCondition::absorbing)
      throw Error("solve",
                  "a shaking comes through the face " +
                      std::string(enum_names<FaceName>::value[static_cast<std::size_t>(motion.side)].first),
                  std::string(name_of(domain.faces[motion.side].condition)),
                  "absorbing, for base = \"compliant\"; or base = \"rigid\"");
  }
}

}  // namespace scarp
