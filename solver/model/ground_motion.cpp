// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/ground_motion.hpp"

#include <algorithm>

namespace scarp {

GroundMotion::GroundMotion(const AccelerationRecord& record, double start) : acceleration_(record.acceleration) {
  for (double t : record.time) time_.push_back(start + (t - record.time.front()));
  velocity_.assign(time_.size(), 0);
  displacement_.assign(time_.size(), 0);
  for (std::size_t i = 1; i < time_.size(); ++i) {
    const double dt = time_[i] - time_[i - 1], a = acceleration_[i - 1], b = acceleration_[i];
    velocity_[i] = velocity_[i - 1] + dt * (a + b) / 2;
    displacement_[i] = displacement_[i - 1] + dt * (velocity_[i - 1] + dt * (2 * a + b) / 6);
  }
}

GroundMotion::Place GroundMotion::place(double time) const {
  const auto next = std::upper_bound(time_.begin(), time_.end(), time);
  const std::size_t sample = next == time_.begin() ? 0 : static_cast<std::size_t>(next - time_.begin()) - 1;
  return {sample, time - time_[sample]};
}

double GroundMotion::acceleration(double time) const {
  if (time_.empty() || time < time_.front() || time > time_.back()) return 0;
  const auto [i, since] = place(time);
  if (i + 1 == time_.size()) return acceleration_[i];
  return acceleration_[i] + (acceleration_[i + 1] - acceleration_[i]) * since / (time_[i + 1] - time_[i]);
}

double GroundMotion::velocity(double time) const {
  if (time_.empty() || time <= time_.front()) return 0;
  const auto [i, since] = place(time);
  if (i + 1 == time_.size()) return velocity_[i];
  const double jerk = (acceleration_[i + 1] - acceleration_[i]) / (time_[i + 1] - time_[i]);
  return velocity_[i] + since * (acceleration_[i] + since * jerk / 2);
}

double GroundMotion::displacement(double time) const {
  if (time_.empty() || time <= time_.front()) return 0;
  const auto [i, since] = place(time);
  if (i + 1 == time_.size()) return displacement_[i] + since * velocity_[i];
  const double jerk = (acceleration_[i + 1] - acceleration_[i]) / (time_[i + 1] - time_[i]);
  return displacement_[i] + since * (velocity_[i] + since * (acceleration_[i] / 2 + since * jerk / 6));
}

Vec3 base_velocity(const std::vector<GroundMotion>& shaking, double time) {
  Vec3 sum{0, 0, 0};
  for (const GroundMotion& motion : shaking)
    if (motion.base == ShakenBase::rigid) sum = sum + motion.velocity(time) * motion.direction;
  return sum;
}

Vec3 base_displacement(const std::vector<GroundMotion>& shaking, double time) {
  Vec3 sum{0, 0, 0};
  for (const GroundMotion& motion : shaking)
    if (motion.base == ShakenBase::rigid) sum = sum + motion.displacement(time) * motion.direction;
  return sum;
}

}  // namespace scarp
