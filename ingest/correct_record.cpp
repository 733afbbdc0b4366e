// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/correct_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// y'' + ... of a second-order section, direct form II transposed; starts from rest.
void filter(std::vector<double>& x, const double (&b)[3], const double (&a)[2]) {
  double s0 = 0, s1 = 0;
  for (double& value : x) {
    const double in = value, out = b[0] * in + s0;
    s0 = b[1] * in - a[0] * out + s1;
    s1 = b[2] * in - a[1] * out;
    value = out;
  }
}

void filter_out_below(AccelerationRecord& record, double frequency) {
  const std::size_t n = record.time.size();
  const double dt = (record.time.back() - record.time.front()) / static_cast<double>(n - 1);
  for (std::size_t i = 1; i < n; ++i)
    if (std::abs(record.time[i] - record.time[i - 1] - dt) > 1e-3 * dt)
      throw Error("ingest", "intervals of a record to be filtered",
                  shortest(record.time[i] - record.time[i - 1]) + " s after " + shortest(record.time[i - 1]) + " s",
                  "all of " + shortest(dt) + " s");
  if (!(frequency > 0 && frequency < 0.5 / dt))
    throw Error("ingest", "high_pass of a record", shortest(frequency) + " Hz",
                "above 0, below half of its sampling rate, " + shortest(0.5 / dt) + " Hz");
  const double k = std::tan(std::numbers::pi * frequency * dt), norm = 1 / (1 + std::numbers::sqrt2 * k + k * k);
  const double b[3]{norm, -2 * norm, norm};
  const double a[2]{2 * (k * k - 1) * norm, (1 - std::numbers::sqrt2 * k + k * k) * norm};
  // The filter rings for about a period of the corner: what it rings past the ends belongs to the backward run.
  const auto rest = static_cast<std::size_t>(std::ceil(3 / (frequency * dt)));
  std::vector<double> x(rest, 0.0);
  x.insert(x.end(), record.acceleration.begin(), record.acceleration.end());
  x.resize(x.size() + rest, 0.0);
  filter(x, b, a);
  std::reverse(x.begin(), x.end());
  filter(x, b, a);
  std::reverse(x.begin(), x.end());
  std::copy(x.begin() + static_cast<std::ptrdiff_t>(rest), x.begin() + static_cast<std::ptrdiff_t>(rest + n),
            record.acceleration.begin());
}

/// Coefficients of s, s^2, ... (s from 0 to 1) that fit the values best: normal equations of at most three unknowns.
std::vector<double> fit(const std::vector<double>& s, const std::vector<double>& values, int terms) {
  double A[3][4]{};
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double p[3]{s[i], s[i] * s[i], s[i] * s[i] * s[i]};
    for (int r = 0; r < terms; ++r) {
      for (int c = 0; c < terms; ++c) A[r][c] += p[r] * p[c];
      A[r][3] += p[r] * values[i];
    }
  }
  for (int c = 0; c < terms; ++c) {  // Gauss-Jordan; the matrix is positive definite
    for (int r = 0; r < terms; ++r) {
      if (r == c) continue;
      const double factor = A[r][c] / A[c][c];
      for (int k = c; k < terms; ++k) A[r][k] -= factor * A[c][k];
      A[r][3] -= factor * A[c][3];
    }
  }
  std::vector<double> coefficients;
  for (int c = 0; c < terms; ++c) coefficients.push_back(A[c][3] / A[c][c]);
  return coefficients;
}

void take_out_drift(AccelerationRecord& record, int terms) {
  const GroundMotion motion(record, 0);
  const double duration = motion.times().back();
  std::vector<double> s, velocity;
  for (double t : motion.times()) {
    s.push_back(t / duration);
    velocity.push_back(motion.velocity(t));
  }
  // With fewer samples than unknowns there is nothing to fit.
  const std::vector<double> c = fit(s, velocity, std::min<int>(terms, static_cast<int>(s.size()) - 1));
  for (std::size_t i = 0; i < s.size(); ++i) {
    double drift = 0;
    for (std::size_t k = c.size(); k > 0; --k) drift = drift * s[i] + static_cast<double>(k) * c[k - 1];
    record.acceleration[i] -= drift / duration;
  }
}

}  // namespace

void correct(AccelerationRecord& record, Baseline baseline, std::optional<double> high_pass) {
  if (high_pass) filter_out_below(record, *high_pass);
  if (baseline != Baseline::none) take_out_drift(record, static_cast<int>(baseline));
}

RecordReport report_of(const GroundMotion& motion) {
  RecordReport report;
  const double first = motion.times().front(), last = motion.times().back();
  report.duration = last - first;
  for (double t : motion.times()) {
    report.peak_acceleration = std::max(report.peak_acceleration, std::abs(motion.acceleration(t)));
    report.peak_velocity = std::max(report.peak_velocity, std::abs(motion.velocity(t)));
    report.peak_displacement = std::max(report.peak_displacement, std::abs(motion.displacement(t)));
  }
  report.end_velocity = motion.velocity(last);
  report.end_displacement = motion.displacement(last);
  return report;
}

}  // namespace scarp
