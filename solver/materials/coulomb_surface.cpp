// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/coulomb_surface.hpp"

#include <algorithm>
#include <numbers>

namespace scarp {

CoulombSurface::CoulombSurface(double G, double K, double cohesion, double friction_angle, double dilatancy_angle,
                               double tension)
    : cohesion_(cohesion), tension_(tension), stiff_(K + 4 * G / 3), across_(K - 2 * G / 3) {
  constexpr double per_degree = std::numbers::pi / 180;
  sin_phi_ = std::sin(friction_angle * per_degree);
  cos_phi_ = std::cos(friction_angle * per_degree);
  sin_psi_ = std::sin(dilatancy_angle * per_degree);
  fall_ = 2 * G * (1 + sin_psi_ / 3) + 2 * K * sin_psi_;
  middle_ = (4 * G / 3 - 2 * K) * sin_psi_;
  rise_ = 2 * G * (1 - sin_psi_ / 3) - 2 * K * sin_psi_;
  const double product = sin_phi_ * sin_psi_, volumetric = 4 * K * product;
  a_ = 4 * G * (1 + product / 3) + volumetric;
  b_right_ = 2 * G * (1 + sin_phi_ + sin_psi_ - product / 3) + volumetric;
  b_left_ = 2 * G * (1 - sin_phi_ - sin_psi_ - product / 3) + volumetric;
}

void CoulombSurface::return_map(Vec3& s, double J) const {
  const Vec3 trial = s;
  const double c_cos = J * cohesion_ * cos_phi_;
  if (plane(s[0], s[2], c_cos) > 0) return_to_planes(s, c_cos);
  if (s[0] > J * tension_) s = return_to_cut_off(trial, c_cos, J * tension_);
}

void CoulombSurface::return_to_planes(Vec3& s, double c_cos) const {
  const double f = plane(s[0], s[2], c_cos);
  const double gamma = f / a_;
  const Vec3 main{s[0] - fall_ * gamma, s[1] + middle_ * gamma, s[2] + rise_ * gamma};
  if (main[0] >= main[1] && main[1] >= main[2]) {
    s = main;
    return;
  }
  // The plane of the hydrostatic axis and the main plane's direction of return separates the two edges.
  const bool right = (1 - sin_psi_) * s[0] - 2 * s[1] + (1 + sin_psi_) * s[2] > 0;
  const double b = right ? b_right_ : b_left_;
  const double other = right ? plane(s[0], s[1], c_cos) : plane(s[1], s[2], c_cos);
  const double per_determinant = 1 / (a_ * a_ - b * b);
  const double ga = (a_ * f - b * other) * per_determinant, gb = (a_ * other - b * f) * per_determinant;
  if (right)
    s = {s[0] - fall_ * (ga + gb), s[1] + middle_ * ga + rise_ * gb, s[2] + rise_ * ga + middle_ * gb};
  else
    s = {s[0] - fall_ * ga + middle_ * gb, s[1] + middle_ * ga - fall_ * gb, s[2] + rise_ * (ga + gb)};
  if (sin_phi_ > 0 && s[0] + s[1] + s[2] > 3 * c_cos / sin_phi_) s.fill(c_cos / sin_phi_);
}

/// For a trial stress whose return to Mohr-Coulomb's planes alone violates s1 <= tension. Where the cut-off alone does
/// it (one, two or three of its planes), that is the answer; else both are active, and the stress lies on the line
/// s1 = tension, s3 = low, or at an end of it. Koiter's conditions hold there: the multipliers of the line are
/// positive exactly where neither return alone suffices.
Vec3 CoulombSurface::return_to_cut_off(const Vec3& s, double c_cos, double tension) const {
  const double beyond = s[0] - tension, share = across_ / stiff_;
  Vec3 cut{tension, s[1] - share * beyond, s[2] - share * beyond};
  if (cut[1] > tension) {
    const double multipliers = (beyond + s[1] - tension) / (stiff_ + across_);
    cut = {tension, tension, std::min(tension, s[2] - across_ * multipliers)};
  }
  const double low = std::min(tension, (tension * (1 + sin_phi_) - 2 * c_cos) / (1 - sin_phi_));
  if (cut[2] >= low) return cut;
  const double f = plane(s[0], s[2], c_cos);
  const double coupling = (1 + sin_phi_) * stiff_ - (1 - sin_phi_) * across_;
  const double determinant = (1 - sin_phi_) * (1 - sin_psi_) * (stiff_ - across_) * (stiff_ + across_);
  const double on_plane = (stiff_ * f - coupling * beyond) / determinant;
  const double on_cut = (a_ * beyond - fall_ * f) / determinant;
  return {tension, std::clamp(s[1] + middle_ * on_plane - across_ * on_cut, low, tension), low};
}

}  // namespace scarp
