// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/make_frame.hpp"

#include <cmath>
#include <string>

#include "solver/core/pore_water.hpp"
#include "solver/core/stress_measures.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

/// A float field whose entry for particle p is made by `value(p)`, an array of doubles.
template <class F>
FrameField field_of(OutputField which, const char* unit, std::size_t count, F&& value) {
  constexpr int components = static_cast<int>(std::tuple_size_v<decltype(value(0))>);
  std::vector<float> values(count * components);
  float* next = values.data();
  for (std::size_t p = 0; p < count; ++p)
    for (double v : value(p)) *next++ = static_cast<float>(v);
  return {std::string(name_of(which)), unit, components, std::move(values)};
}

using Scalar = std::array<double, 1>;

FrameField make_field(const Model& model, const Particles& P, OutputField which, const Vec3& shift,
                      const Vec3& velocity) {
  const std::size_t n = P.size();
  const auto J = [&P](std::size_t p) { return determinant(P.deformation_gradient[p]); };
  switch (which) {
    case OutputField::displacement:
      return field_of(which, "m", n, [&](std::size_t p) { return P.position[p] - P.reference_position[p] + shift; });
    case OutputField::velocity:
      return field_of(which, "m/s", n, [&](std::size_t p) { return P.velocity[p] + velocity; });
    case OutputField::stress:
      return field_of(which, "Pa", n, [&](std::size_t p) { return P.stress[p]; });
    case OutputField::equivalent_plastic_strain:
      return field_of(which, "1", n, [&](std::size_t p) { return Scalar{P.equivalent_plastic_strain[p]}; });
    case OutputField::mean_stress:
      return field_of(which, "Pa", n, [&](std::size_t p) { return Scalar{mean_stress(P.stress[p])}; });
    case OutputField::von_mises_stress:
      return field_of(which, "Pa", n, [&](std::size_t p) { return Scalar{von_mises_stress(P.stress[p])}; });
    case OutputField::volume_ratio:
      return field_of(which, "1", n, [&](std::size_t p) { return Scalar{J(p)}; });
    case OutputField::deformation_gradient:
      return field_of(which, "1", n, [&](std::size_t p) { return P.deformation_gradient[p]; });
    case OutputField::density:
      return field_of(which, "kg/m3", n,
                      [&](std::size_t p) { return Scalar{P.mass[p] / (P.reference_volume[p] * J(p))}; });
    case OutputField::pore_pressure:
      return field_of(which, "Pa", n, [&](std::size_t p) {
        return Scalar{model.water ? pore_pressure(*model.water, P.position[p], model.domain.dimension) : 0};
      });
  }
  return {};
}

std::vector<std::uint8_t> flatten(const std::vector<Rgb8>& colours) {
  std::vector<std::uint8_t> values;
  values.reserve(3 * colours.size());
  for (const Rgb8& c : colours) values.insert(values.end(), c.begin(), c.end());
  return values;
}

/// Current volumes: with them a surface can be laid around the points.
FrameField volumes(const Particles& particles, int dimension) {
  std::vector<float> values(particles.size());
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = static_cast<float>(particles.reference_volume[p] * determinant(particles.deformation_gradient[p]));
  return {"volume", dimension == 2 ? "m3/m" : "m3", 1, std::move(values)};
}

}  // namespace

Frame make_frame(const Model& model, const std::vector<OutputField>& fields, double time, std::int64_t step,
                 bool absolute) {
  return make_frame(model, model.particles, fields, time, step, absolute);
}

Frame make_frame(const Model& model, const Particles& particles, const std::vector<OutputField>& fields, double time,
                 std::int64_t step, bool absolute) {
  const Vec3 none{0, 0, 0}, shift = absolute ? base_displacement(model.shaking, time) : none,
                            velocity = absolute ? base_velocity(model.shaking, time) : none;
  Frame frame{.time = time, .step = step, .positions = particles.position, .fields = {}, .site = model.site};
  for (Vec3& x : frame.positions) x = x + shift;
  frame.fields.push_back({"id", "1", 1, particles.id});
  frame.fields.push_back({"body", "1", 1, particles.body});
  frame.fields.push_back({"material", "1", 1, particles.material});
  frame.fields.push_back({"surface", "1", 1, particles.surface});
  frame.fields.push_back({"colour", "1", 3, flatten(particles.colour)});
  frame.fields.push_back(volumes(particles, model.domain.dimension));
  for (OutputField field : fields)
    if (!find_field(frame, std::string(name_of(field))))
      frame.fields.push_back(make_field(model, particles, field, shift, velocity));
  return frame;
}

}  // namespace scarp
