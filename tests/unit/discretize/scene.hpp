// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "discretize/discretize.hpp"
#include "solver/model/error.hpp"

namespace scarp::test {

/// A scenario with its loaded inputs, put together in a few lines.
struct Scene {
  Scenario scenario;
  std::map<std::string, PointCloud> scans;
  std::map<std::string, TriangleMesh> meshes;
  std::map<std::string, Heightfield> surfaces;
  SiteFrame site;

  Scene(int dimension, double cell) {
    scenario.domain.dimension = dimension;
    scenario.domain.cell = cell;
    material("soil", 2000);
  }
  void material(const std::string& name, double density) {
    LinearElastic law;
    law.density = density;
    law.youngs_modulus = 1e6;
    law.poissons_ratio = 0.3;
    scenario.materials[name] = law;
  }
  BodyOptions& body(const std::string& name, Volume volume) {
    BodyOptions body;
    body.name = name;
    body.volume = std::move(volume);
    body.material = "soil";
    scenario.bodies.push_back(body);
    return scenario.bodies.back();
  }
  Model build(int threads = 1) const { return discretize({scenario, scans, meshes, surfaces, site, threads}); }
};

/// The text of the Error that building the scene throws; empty if it throws none.
inline std::string refusal(const Scene& scene) {
  try {
    scene.build();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline BoxVolume box(Vec3 low, Vec3 high) { return {{low, high}}; }

/// (n + 1) x (n + 1) points of z(x, y) on [x0, x0 + size]^2.
template <class F>
PointCloud grid_scan(int n, double x0, double size, F&& z) {
  PointCloud cloud;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = x0 + size * i / n, y = x0 + size * j / n;
      cloud.positions.push_back({x, y, z(x, y)});
    }
  return cloud;
}

/// Scattered points of z(x, y) on [0, size]^2 with its four corners.
template <class F>
PointCloud random_scan(int count, double size, unsigned seed, F&& z) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return size * static_cast<double>(random() >> 11) * 0x1p-53; };
  PointCloud cloud;
  for (double x : {0.0, size})
    for (double y : {0.0, size}) cloud.positions.push_back({x, y, z(x, y)});
  for (int i = 4; i < count; ++i) {
    const double x = uniform(), y = uniform();
    cloud.positions.push_back({x, y, z(x, y)});
  }
  return cloud;
}

inline ScanVolume above_plane(double elevation) {
  ScanVolume volume;
  volume.scan = "scan";
  volume.base_elevation = elevation;
  return volume;
}
inline ScanVolume sunk_by(double depth) {
  ScanVolume volume;
  volume.scan = "scan";
  volume.close = Closing::depth;
  volume.depth = depth;
  return volume;
}

/// Bit equality of everything that discretize makes.
inline void expect_same_bits(const Model& a, const Model& b) {
  ASSERT_EQ(a.particles.size(), b.particles.size());
  std::vector<std::vector<unsigned char>> bytes;
  for (const Model* m : {&a, &b})
    for_each_field(m->particles, [&](const char*, const char*, const auto& v, const auto&) {
      const auto* raw = reinterpret_cast<const unsigned char*>(v.data());
      bytes.emplace_back(raw, raw + v.size() * sizeof(v[0]));
    });
  const std::size_t fields = bytes.size() / 2;
  for (std::size_t f = 0; f < fields; ++f) EXPECT_TRUE(bytes[f] == bytes[fields + f]) << "field " << f;
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].lattice.origin, b.bodies[i].lattice.origin);
    EXPECT_EQ(a.bodies[i].lattice.cells, b.bodies[i].lattice.cells);
    EXPECT_EQ(a.volumes[i].input_volume, b.volumes[i].input_volume);
    ASSERT_EQ(a.bodies[i].held.size(), b.bodies[i].held.size());
    for (std::size_t s = 0; s < a.bodies[i].held.size(); ++s)
      EXPECT_EQ(a.bodies[i].held[s].nodes, b.bodies[i].held[s].nodes);
  }
}

}  // namespace scarp::test
