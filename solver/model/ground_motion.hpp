// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// How a base is shaken: its nodes have the motion, or it is transparent and the motion is a wave's.
enum class ShakenBase { rigid, compliant };

/// Acceleration over time as it was recorded.
struct AccelerationRecord {
  std::vector<double> time;          ///< s, rising
  std::vector<double> acceleration;  ///< m/s2
};

/// A record, linear between its samples, with the velocity and the displacement that are its exact integrals; at rest
/// before the first sample, and without acceleration after the last.
class GroundMotion {
 public:
  GroundMotion() = default;
  /// @param record  at least two samples at rising times
  /// @param start   time of the first sample, s
  GroundMotion(const AccelerationRecord& record, double start);

  double acceleration(double time) const;  ///< m/s2
  double velocity(double time) const;      ///< m/s
  double displacement(double time) const;  ///< m

  const std::vector<double>& times() const { return time_; }

  Vec3 direction{1, 0, 0};  ///< unit vector
  ShakenBase base = ShakenBase::rigid;
  int side = 0;      ///< compliant: of Domain::faces
  double share = 1;  ///< compliant: incoming wave / record

 private:
  struct Place {
    std::size_t sample;
    double since;  ///< s after the sample
  };
  Place place(double time) const;

  std::vector<double> time_, acceleration_, velocity_, displacement_;
};

/// What a model that is shaken at a rigid base is told: the sum of its motions, of the given order.
Vec3 base_velocity(const std::vector<GroundMotion>& shaking, double time);
Vec3 base_displacement(const std::vector<GroundMotion>& shaking, double time);

}  // namespace scarp
