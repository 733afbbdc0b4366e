// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/probe.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/stress_measures.hpp"
#include "solver/materials/log_strain.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr const char* kComponents[] = {"xx", "yy", "zz", "xy", "yz", "xz"};

using Row = std::vector<double>;

class Columns {
 public:
  Columns& scalar(const std::string& name) {
    names.push_back(name);
    return *this;
  }
  Columns& vector(const std::string& name, const std::string& unit) {
    for (const char* axis : kAxes) names.push_back(name + "_" + axis + "_" + unit);
    return *this;
  }
  Columns& tensor(const std::string& name, const std::string& unit) {
    for (const char* component : kComponents) names.push_back(name + "_" + component + unit);
    return *this;
  }
  /// What Means gives.
  Columns& means() {
    return vector("displacement", "m")
        .vector("velocity", "m_s")
        .tensor("stress", "_Pa")
        .scalar("equivalent_plastic_strain");
  }
  std::vector<std::string> names;
};

template <class T>
void append(Row& row, const T& values) {
  row.insert(row.end(), values.begin(), values.end());
}

Vec3 displacement(const Particles& P, std::size_t p) { return P.position[p] - P.reference_position[p]; }

double volume_now(const Particles& P, std::size_t p) {
  return P.reference_volume[p] * determinant(P.deformation_gradient[p]);
}

/// ln(F F^T) / 2.
Sym6 logarithmic_strain(const Mat3& F) {
  const LogStrain strain = log_strain(push_forward(F, {1, 1, 1, 0, 0, 0}));
  return compose(strain.principal, strain.planes);
}

/// Means of material points, of motion by mass and of stress and strain by present volume.
struct Means {
  double count = 0, mass = 0, volume = 0, plastic = 0;
  Vec3 displacement{0, 0, 0}, velocity{0, 0, 0};
  Sym6 stress{0, 0, 0, 0, 0, 0};

  void add(const Particles& P, std::size_t p) {
    const double m = P.mass[p], V = volume_now(P, p);
    ++count;
    mass += m;
    volume += V;
    plastic += V * P.equivalent_plastic_strain[p];
    displacement = displacement + m * scarp::displacement(P, p);
    velocity = velocity + m * P.velocity[p];
    for (int i = 0; i < 6; ++i) stress[i] += V * P.stress[p][i];
  }
  /// 0 / 0 = NaN where there is nothing.
  void append_to(Row& row) const {
    append(row, (1 / mass) * displacement);
    append(row, (1 / mass) * velocity);
    for (double s : stress) row.push_back(s / volume);
    row.push_back(plastic / volume);
  }
};

Vec3 place_of(const Particles& P, std::size_t p, ProbePlace place) {
  return place == ProbePlace::current ? P.position[p] : P.reference_position[p];
}

bool inside(const BoxShape& box, const Vec3& x, int dimension) {
  for (int a = 0; a < dimension; ++a)
    if (!(x[a] >= box.min[a] && x[a] <= box.max[a])) return false;
  return true;
}

void check_box(const BoxShape& box, const std::string& name, int dimension) {
  for (int a = 0; a < dimension; ++a)
    if (!(box.min[a] < box.max[a]))
      throw Error("solve", "probe '" + name + "': the box has no extent in " + kAxes[a],
                  shortest(box.min[a]) + " to " + shortest(box.max[a]), "min below max");
}

std::vector<std::string> set_up(const PointProbe&, const std::string&, const Model&) {
  return Columns()
      .scalar("time_s")
      .vector("position", "m")
      .vector("displacement", "m")
      .vector("velocity", "m_s")
      .tensor("stress", "_Pa")
      .tensor("strain", "")
      .scalar("equivalent_plastic_strain")
      .names;
}
std::vector<std::string> set_up(LineProbe& probe, const std::string& name, const Model& model) {
  const double length = norm(probe.line.to - probe.line.from);
  if (!(length > 0) || !std::isfinite(length))
    throw Error("solve", "probe '" + name + "': its line has no length", shortest(length), "above 0 m");
  if (probe.line.bins < 1)
    throw Error("solve", "probe '" + name + "': bins", std::to_string(probe.line.bins), "at least 1");
  if (!probe.line.radius) probe.line.radius = model.domain.cell;
  return Columns().scalar("time_s").scalar("distance_m").scalar("particles").means().names;
}
std::vector<std::string> set_up(PlaneProbe& probe, const std::string& name, const Model& model) {
  const double length = norm(probe.plane.normal);
  if (!(length > 0) || !std::isfinite(length))
    throw Error("solve", "probe '" + name + "': its plane has no normal", shortest(length), "a length above 0");
  probe.plane.normal = (1 / length) * probe.plane.normal;
  if (probe.within) check_box(*probe.within, name, model.domain.dimension);
  return Columns()
      .scalar("time_s")
      .vector("force", "N")
      .scalar("normal_force_N")
      .vector("moment", "N_m")
      .scalar("area_m2")
      .names;
}
std::vector<std::string> set_up(const BoxProbe& probe, const std::string& name, const Model& model) {
  check_box(probe.box, name, model.domain.dimension);
  return Columns()
      .scalar("time_s")
      .scalar("particles")
      .scalar("mass_kg")
      .scalar("volume_m3")
      .vector("centre", "m")
      .means()
      .scalar("largest_displacement_m")
      .scalar("largest_speed_m_s")
      .scalar("largest_von_mises_stress_Pa")
      .scalar("largest_equivalent_plastic_strain")
      .scalar("least_mean_stress_Pa")
      .scalar("largest_mean_stress_Pa")
      .names;
}

void measure_point(const Model& model, std::size_t p, double time, Row& row) {
  const Particles& P = model.particles;
  row.push_back(time);
  append(row, P.position[p] + model.site.origin);
  append(row, displacement(P, p));
  append(row, P.velocity[p]);
  append(row, P.stress[p]);
  append(row, logarithmic_strain(P.deformation_gradient[p]));
  row.push_back(P.equivalent_plastic_strain[p]);
}

void measure_line(const LineProbe& probe, const Model& model, double time, Row& rows) {
  const LineShape& line = probe.line;
  const double length = norm(line.to - line.from);
  const Vec3 along = (1 / length) * (line.to - line.from);
  std::vector<Means> bins(static_cast<std::size_t>(line.bins));
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    const Vec3 from_start = place_of(model.particles, p, probe.place) - line.from;
    const double s = dot(from_start, along);
    if (!(s >= 0 && s <= length && norm(from_start - s * along) <= *line.radius)) continue;
    const auto bin = static_cast<std::size_t>(s / length * line.bins);
    bins[std::min(bin, bins.size() - 1)].add(model.particles, p);
  }
  for (std::size_t b = 0; b < bins.size(); ++b) {
    append(rows, std::array{time, (static_cast<double>(b) + 0.5) * length / line.bins, bins[b].count});
    bins[b].append_to(rows);
  }
}

void measure_plane(const PlaneProbe& probe, const Model& model, double time, Row& row) {
  const Particles& P = model.particles;
  const Vec3& n = probe.plane.normal;
  Vec3 force{0, 0, 0}, moment{0, 0, 0};
  double area = 0;
  for (std::size_t p = 0; p < P.size(); ++p) {
    const double h = model.bodies[P.body[p]].lattice.cell;
    const Vec3 arm = P.position[p] - probe.plane.point;
    const double weight = 1 - std::abs(dot(arm, n)) / h;
    if (!(weight > 0) || (probe.within && !inside(*probe.within, P.position[p], model.domain.dimension))) continue;
    const double share = volume_now(P, p) * weight / h;
    const Sym6& s = P.stress[p];
    const Vec3 traction{s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
                        s[5] * n[0] + s[4] * n[1] + s[2] * n[2]};
    force = force + share * traction;
    moment = moment + share * cross(arm, traction);
    area += share;
  }
  row.push_back(time);
  append(row, force);
  row.push_back(dot(force, n));
  append(row, moment);
  row.push_back(area);
}

void measure_box(const BoxProbe& probe, const Model& model, double time, Row& row) {
  const Particles& P = model.particles;
  Means means;
  Vec3 first_moment{0, 0, 0};
  double displaced = NAN, fastest = NAN, mises = NAN, plastic = NAN, least = NAN, most = NAN;
  for (std::size_t p = 0; p < P.size(); ++p) {
    if (!inside(probe.box, place_of(P, p, probe.place), model.domain.dimension)) continue;
    means.add(P, p);
    first_moment = first_moment + P.mass[p] * P.position[p];
    displaced = std::fmax(displaced, norm(displacement(P, p)));
    fastest = std::fmax(fastest, norm(P.velocity[p]));
    mises = std::fmax(mises, von_mises_stress(P.stress[p]));
    plastic = std::fmax(plastic, P.equivalent_plastic_strain[p]);
    least = std::fmin(least, mean_stress(P.stress[p]));
    most = std::fmax(most, mean_stress(P.stress[p]));
  }
  append(row, std::array{time, means.count, means.mass, means.volume});
  append(row, (1 / means.mass) * first_moment + model.site.origin);
  means.append_to(row);
  append(row, std::array{displaced, fastest, mises, plastic, least, most});
}

}  // namespace

Probe::Probe(const ProbeOptions& options, const Model& model)
    : shape_(options.where),
      columns_(std::visit([&](auto& shape) { return set_up(shape, options.name, model); }, shape_)) {
  const auto* watch = std::get_if<PointProbe>(&shape_);
  if (!watch) return;
  const Particles& P = model.particles;
  for (std::size_t p = 1; p < P.size(); ++p) {  // of equally near ones that of the lowest id: no sort changes it
    const double here = norm(P.reference_position[p] - watch->point);
    const double best = norm(P.reference_position[place_] - watch->point);
    if (here < best || (here == best && P.id[p] < P.id[place_])) place_ = p;
  }
  id_ = P.id[place_];
}

std::int64_t Probe::watched(const Particles& particles) {
  if (id_ < 0) return -1;
  if (particles.id[place_] != id_)
    place_ = static_cast<std::size_t>(std::find(particles.id.begin(), particles.id.end(), id_) - particles.id.begin());
  return static_cast<std::int64_t>(place_);
}

void Probe::measure(const Model& model, double time, std::vector<double>& table) {
  if (std::holds_alternative<PointProbe>(shape_))
    measure_point(model, static_cast<std::size_t>(watched(model.particles)), time, table);
  else if (const auto* line = std::get_if<LineProbe>(&shape_))
    measure_line(*line, model, time, table);
  else if (const auto* plane = std::get_if<PlaneProbe>(&shape_))
    measure_plane(*plane, model, time, table);
  else
    measure_box(std::get<BoxProbe>(shape_), model, time, table);
}

}  // namespace scarp
