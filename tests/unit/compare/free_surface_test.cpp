// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/free_surface.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"
#include "tools/compare/material_points.hpp"

namespace scarp {
namespace {

Vec3 times(const Mat3& A, const Vec3& v) {
  return {A[0] * v[0] + A[1] * v[1] + A[2] * v[2], A[3] * v[0] + A[4] * v[1] + A[5] * v[2],
          A[6] * v[0] + A[7] * v[1] + A[8] * v[2]};
}

Mat3 inverse(const Mat3& F) {
  Mat3 G = transpose(cofactor(F));
  for (double& v : G) v /= determinant(F);
  return G;
}

/// A body as discretize makes it: material points at the centres, inside, of a lattice; then deformed alike everywhere.
struct Solid {
  std::function<double(double, double)> top;
  double base = -1, half_width = 0.8, spacing = 0.05;
  Vec3 shift{0.013, 0.021, 0.017};  ///< of the lattice, m: no layer lies in the surface
  Mat3 F = kIdentity;
  bool with_gradient = true;

  /// Marks the points whose upper neighbour is outside.
  Frame frame() const {
    Frame frame;
    std::vector<float> volume, gradient;
    std::vector<std::uint8_t> surface;
    const int n = static_cast<int>(half_width / spacing);
    const int low = static_cast<int>(std::floor(base / spacing)), high = static_cast<int>(std::ceil(2 / spacing));
    for (int i = -n; i < n; ++i)
      for (int j = -n; j < n; ++j)
        for (int k = low; k < high; ++k) {
          const Vec3 X{(i + 0.5) * spacing + shift[0], (j + 0.5) * spacing + shift[1], (k + 0.5) * spacing + shift[2]};
          if (X[2] < base || X[2] > top(X[0], X[1])) continue;
          frame.positions.push_back(times(F, X));
          volume.push_back(static_cast<float>(std::pow(spacing, 3) * determinant(F)));
          for (double v : F) gradient.push_back(static_cast<float>(v));
          surface.push_back(X[2] + spacing > top(X[0], X[1]));
        }
    frame.fields = {{"surface", "1", 1, surface}, {"volume", "m3", 1, volume}};
    if (with_gradient) frame.fields.push_back({"deformation_gradient", "1", 9, gradient});
    return frame;
  }
};

/// Distances of the surface found above the true one, along its normal, once taken back to where the body was made; in
/// spacings.
struct Errors {
  double sum = 0, squares = 0, largest = 0, stated = 0;
  std::size_t count = 0;

  void add(double error, double uncertainty) {
    sum += error;
    squares += error * error;
    largest = std::max(largest, std::abs(error));
    stated += uncertainty;
    ++count;
  }
  double bias() const { return sum / static_cast<double>(count); }
  double spread() const { return std::sqrt(squares / static_cast<double>(count) - bias() * bias()); }
};

double distance(const Solid& solid, const Vec3& X) {
  const double e = 1e-5;
  const double slope_x = (solid.top(X[0] + e, X[1]) - solid.top(X[0] - e, X[1])) / (2 * e);
  const double slope_y = (solid.top(X[0], X[1] + e) - solid.top(X[0], X[1] - e)) / (2 * e);
  return (X[2] - solid.top(X[0], X[1])) / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
}

bool within(const Solid& solid, const Vec3& X, double margin) {
  return std::abs(X[0] - solid.shift[0]) < solid.half_width - margin &&
         std::abs(X[1] - solid.shift[1]) < solid.half_width - margin;
}

void add_errors(const Solid& solid, double margin, Errors& errors) {
  const FreeSurface surface = free_surface(solid.frame(), 2);
  const Mat3 back = inverse(solid.F);
  for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
    const Vec3 X = times(back, surface.cloud.positions[i]);
    if (!within(solid, X, margin)) continue;
    errors.add(distance(solid, X) / solid.spacing, surface.cloud.scalars[0].values[i] / solid.spacing);
  }
}

const Mat3 kSettled{1.1, 0, 0, 0, 1.05, 0, 0, 0, 0.8};
const Mat3 kSheared{1.05, 0.1, 0.4, -0.1, 1.0, 0.1, 0.05, 0.02, 0.9};

struct Shape {
  const char* name;
  std::function<double(double, double)> top;
  double along = 0;  ///< share of its area that lies along layers of the lattice
};

/// Where a surface lies along layers of the lattice, a distance d apart, nothing says where between two of them it is:
/// the error is even over d, its standard deviation d / sqrt(12). A surface with curvature 1 / R is within half a layer
/// of one for sqrt(d R) to either side of where it touches it; of the cap (R = 30 h, a square of 24 h) that is
/// pi 30 / 24^2 = 0.16 of the area, of the dune (R = 9.5 h at crests and troughs, 20 h apart) 2 sqrt(9.5) / 20 = 0.31.
std::vector<Shape> shapes() {
  return {
      {"plane of 18 deg", [](double x, double y) { return 0.31 * x + 0.11 * y; }},
      {"plane of 35 deg", [](double x, double y) { return 0.62 * x - 0.33 * y; }},
      {"plane of 50 deg", [](double x, double y) { return 1.13 * x + 0.39 * y; }},
      {"cap of a sphere", [](double x, double y) { return std::sqrt(std::max(0.0, 2.25 - x * x - y * y)) - 1.2; },
       0.16},
      {"dune", [](double x, double y) { return 0.22 * std::cos(3.1 * x + 0.4 * std::sin(2 * y)) + 0.07 * y; }, 0.31}};
}

/// What the spread can be, in spacings: 1 / sqrt(12) along layers, elsewhere that of the mean of as many columns of the
/// lattice as the kernel sees, 1 / integral(w^2) = 8.2 of them: on other slopes their heights between two layers are
/// spread evenly.
double largest_spread(const Shape& shape) {
  constexpr double kColumns = 8.16;
  return std::sqrt((shape.along + (1 - shape.along) / kColumns) / 12);
}

/// How the lattice lies to the surface is chance; a bias is what does not average out over it. These fill a cell evenly
/// (Roberts' sequence in three dimensions).
std::vector<Vec3> shifts(int count) {
  std::vector<Vec3> found;
  for (int k = 1; k <= count; ++k)
    found.push_back(
        {0.05 * std::fmod(0.8191725 * k, 1), 0.05 * std::fmod(0.6710436 * k, 1), 0.05 * std::fmod(0.5497005 * k, 1)});
  return found;
}

TEST(FreeSurface, HasNoBias) {
  std::printf("| shape | body | F known | points | bias / h | spread / h | largest / h | stated / h |\n");
  for (const Shape& shape : shapes())
    for (const auto& [body, F, known] :
         {std::tuple{"as made", kIdentity, true}, {"settled", kSettled, true}, {"sheared", kSheared, false}}) {
      Errors errors;
      for (const Vec3& shift : shifts(4))
        add_errors({.top = shape.top, .shift = shift, .F = F, .with_gradient = known}, 0.2, errors);
      const double stated = errors.stated / static_cast<double>(errors.count);
      std::printf("| %s | %s | %s | %zu | %+.4f | %.3f | %.2f | %.3f |\n", shape.name, body, known ? "yes" : "no",
                  errors.count, errors.bias(), errors.spread(), errors.largest, stated);
      EXPECT_LT(std::abs(errors.bias()), 0.02) << shape.name << ", " << body;
      EXPECT_LT(errors.spread(), largest_spread(shape)) << shape.name << ", " << body;
      // Half a layer at most, where it touches one; and a tenth for the quadric, which may overshoot a step.
      EXPECT_LT(errors.largest, 0.6) << shape.name << ", " << body;
      EXPECT_GT(stated, errors.spread()) << "what the surface says of itself";
      EXPECT_GT(errors.count, 1800u);
    }
}

TEST(FreeSurface, HasNoBiasAlongDiagonalsOfTheLattice) {
  // All of such a plane lies between the same two layers, 1 / sqrt(2) or 1 / sqrt(3) apart: where, the shifts decide.
  const std::vector<std::pair<Shape, double>> planes{
      {{"plane along a face's diagonal", [](double x, double) { return x; }}, std::sqrt(0.5)},
      {{"plane along the body's diagonal", [](double x, double y) { return x + y; }}, std::sqrt(1 / 3.0)}};
  for (const auto& [plane, apart] : planes) {
    Errors errors;
    constexpr int kShifts = 16;
    for (int k = 0; k < kShifts; ++k)
      add_errors({.top = plane.top, .half_width = 0.5, .shift = {0.013, 0.021, (k + 0.5) / kShifts * 0.05}}, 0.2,
                 errors);
    std::printf("| %s | as made | yes | %zu | %+.4f | %.3f | %.2f |\n", plane.name, errors.count, errors.bias(),
                errors.spread(), errors.largest);
    EXPECT_LT(std::abs(errors.bias()), 0.02) << plane.name;
    // All errors between half a layer above and below are as frequent.
    EXPECT_NEAR(errors.spread(), apart / std::sqrt(12.0), 0.02) << plane.name;
    EXPECT_LT(errors.largest, apart / 2 + 0.1) << plane.name;
  }
}

TEST(FreeSurface, ReachesTheEdgeOfTheBody) {
  Errors errors;
  for (const Vec3& shift : shifts(4)) add_errors({.top = shapes()[0].top, .shift = shift}, -1, errors);
  EXPECT_LT(std::abs(errors.bias()), 0.02);
  // Of who is no deeper than 1.25 spacings below what its column says, so that no place is farther than that above the
  // surface, below which all material is; the tilt of a normal that is taken of one side only adds to it.
  EXPECT_LT(errors.largest, 1.5) << "beside the skirt too";
}

TEST(FreeSurface, NormalsPointOut) {
  const Solid solid{.top = shapes()[1].top};
  const FreeSurface surface = free_surface(solid.frame(), 1);
  const double length = std::sqrt(1 + 0.62 * 0.62 + 0.33 * 0.33);
  for (std::size_t i = 0; i < surface.cloud.size(); ++i)
    if (within(solid, surface.cloud.positions[i], 0.3)) {
      EXPECT_GT(dot(surface.cloud.normals[i], {-0.62 / length, 0.33 / length, 1 / length}), 0.99);
    }
}

/// A box of particles with a uint8 mark for all, of one spacing.
void add_box(Frame& frame, const Vec3& low, const Vec3& high, double spacing, std::uint8_t mark,
             std::int32_t body = 0) {
  if (frame.fields.empty())
    frame.fields = {{"surface", "1", 1, std::vector<std::uint8_t>{}},
                    {"volume", "m3", 1, std::vector<float>{}},
                    {"body", "1", 1, std::vector<std::int32_t>{}}};
  for (double x = low[0] + spacing / 2; x < high[0]; x += spacing)
    for (double y = low[1] + spacing / 2; y < high[1]; y += spacing)
      for (double z = low[2] + spacing / 2; z < high[2]; z += spacing) {
        frame.positions.push_back({x, y, z});
        std::get<std::vector<std::uint8_t>>(frame.fields[0].values).push_back(mark);
        std::get<std::vector<float>>(frame.fields[1].values).push_back(static_cast<float>(std::pow(spacing, 3)));
        std::get<std::vector<std::int32_t>>(frame.fields[2].values).push_back(body);
      }
}

TEST(FreeSurface, OfThinLayers) {
  for (int layers : {1, 2, 3}) {
    Frame frame;
    add_box(frame, {0, 0, 0}, {2, 2, 0.1 * layers}, 0.1, 0);
    for (const Vec3& p : free_surface(frame, 1).cloud.positions)
      EXPECT_NEAR(p[2], 0.1 * layers, 0.012) << layers << " layers, at " << p[0] << ", " << p[1];
  }
}

TEST(FreeSurface, OfAWallThatWasMarkedAsOne) {
  // A face x = 1 of a block, 2 m high: seen from above it is an edge.
  Frame frame;
  add_box(frame, {0, 0, 0}, {1, 2, 2}, 0.1, 0);
  auto& marked = std::get<std::vector<std::uint8_t>>(frame.fields[0].values);
  for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = frame.positions[i][0] > 0.9;
  const FreeSurface surface = free_surface(frame, 1);
  std::size_t on_face = 0;
  for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
    const Vec3 &p = surface.cloud.positions[i], &n = surface.cloud.normals[i];
    if (p[2] > 1.6 || n[0] < 0.9) continue;
    EXPECT_NEAR(p[0], 1, 0.01);
    ++on_face;
  }
  EXPECT_EQ(on_face, 16u * 20u);
}

TEST(FreeSurface, LeavesOutParticlesOnTheirOwn) {
  Frame frame;
  add_box(frame, {0, 0, 0}, {2, 2, 0.5}, 0.1, 0);
  const std::size_t body = frame.positions.size();
  add_box(frame, {0.95, 0.95, 1.45}, {1.05, 1.05, 1.55}, 0.1, 1);
  add_box(frame, {4, 1, 0}, {4.2, 1.1, 0.1}, 0.1, 1);
  ASSERT_EQ(frame.positions.size(), body + 3);
  const FreeSurface surface = free_surface(frame, 1);
  EXPECT_EQ(surface.alone, 3u);
  for (const Vec3& p : surface.cloud.positions) EXPECT_NEAR(p[2], 0.5, 0.01);
  const SurfaceRaster raster = surface_raster(surface, covering_grid(frame.positions, 0.1), CellPolicy::mean, 1);
  EXPECT_NEAR(height_at(raster.field, 1.3, 1.1), 0.5, 0.002);
  EXPECT_TRUE(std::isnan(height_at(raster.field, 4.1, 1.05))) << "no surface there";
}

TEST(FreeSurface, OfTwoBodiesOneOnTheOther) {
  // The finer one covers half of the coarser one; what is between them is no surface.
  Frame frame;
  add_box(frame, {0, 0, 0}, {2, 2, 0.6}, 0.1, 1, 0);
  add_box(frame, {0, 0, 0.6}, {1, 2, 0.8}, 0.05, 1, 1);
  const FreeSurface surface = free_surface(frame, 1);
  EXPECT_NEAR(surface.spacing, 0.1, 1e-6) << "of the coarser body";
  for (const Vec3& p : surface.cloud.positions) {
    if (p[0] > 0.3 && p[0] < 0.7 && p[1] > 0.4 && p[1] < 1.6 && p[2] > 0.3) {
      EXPECT_NEAR(p[2], 0.8, 0.01);
    }
    if (p[0] > 1.4 && p[0] < 1.6 && p[1] > 0.4 && p[1] < 1.6 && p[2] > 0.3) {
      EXPECT_NEAR(p[2], 0.6, 0.012);
    }
  }
}

/// Of a raster against the means of the true heights over its cells.
void add_raster_errors(const Solid& solid, const FreeSurface& surface, double cell, Errors& errors) {
  const RasterGrid grid = covering_grid({{-0.5, -0.5, 0}, {0.5, 0.5, 0}}, cell);
  const SurfaceRaster raster = surface_raster(surface, grid, CellPolicy::mean, 2);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column), y = grid.y(row);
      double truth = 0;
      for (int k = 0; k < 16; ++k) truth += solid.top(x + (k % 4 - 1.5) / 4 * cell, y + (k / 4 - 1.5) / 4 * cell) / 16;
      const double height = raster.field.at(column, row);
      ASSERT_FALSE(std::isnan(height));
      errors.add(distance(solid, {x, y, height - truth + solid.top(x, y)}) / solid.spacing,
                 raster.sigma[static_cast<std::size_t>(row * grid.columns + column)] / solid.spacing);
    }
}

TEST(FreeSurface, AsARasterHasNoBias) {
  constexpr std::array<double, 2> kCells{0.04, 0.1};
  std::printf("| shape | raster | cells | bias / h | spread / h | largest / h |\n");
  for (const Shape& shape : shapes()) {
    std::array<Errors, 2> errors;
    for (const Vec3& shift : shifts(8)) {
      const Solid solid{.top = shape.top, .shift = shift};
      const FreeSurface surface = free_surface(solid.frame(), 2);
      for (std::size_t k = 0; k < kCells.size(); ++k) add_raster_errors(solid, surface, kCells[k], errors[k]);
    }
    for (std::size_t k = 0; k < kCells.size(); ++k) {
      std::printf("| %s | of %.1f h | %zu | %+.4f | %.3f | %.2f |\n", shape.name, kCells[k] / 0.05, errors[k].count,
                  errors[k].bias(), errors[k].spread(), errors[k].largest);
      EXPECT_LT(std::abs(errors[k].bias()), 0.02) << shape.name;
      EXPECT_LT(errors[k].spread(), largest_spread(shape)) << shape.name;
    }
  }
}

TEST(FreeSurface, IsEmptyOverAHole) {
  Frame frame;
  add_box(frame, {0, 0, 0}, {2, 0.8, 0.5}, 0.1, 0);
  add_box(frame, {0, 1.3, 0}, {2, 2, 0.5}, 0.1, 0);
  const FreeSurface surface = free_surface(frame, 1);
  const SurfaceRaster raster = surface_raster(surface, covering_grid(frame.positions, 0.1), CellPolicy::mean, 1);
  EXPECT_TRUE(std::isnan(height_at(raster.field, 1.05, 1.05)));
  EXPECT_NEAR(height_at(raster.field, 1.05, 0.55), 0.5, 0.02);
}

/// A disk of radius 1 in plane strain: its edge is the surface, marked all around.
Frame disk(const Vec3& shift, double h) {
  Frame frame;
  std::vector<std::uint8_t> surface;
  std::vector<float> volume;
  const int n = static_cast<int>(1.2 / h);
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      const Vec3 x{(i + 0.5) * h + shift[0], (j + 0.5) * h + shift[1], 0};
      if (norm(x) > 1) continue;
      frame.positions.push_back(x);
      surface.push_back(norm(x) > 1 - 2 * h);
      volume.push_back(static_cast<float>(h * h));
    }
  frame.fields = {{"surface", "1", 1, surface}, {"volume", "m3/m", 1, volume}};
  return frame;
}

TEST(FreeSurface, OfPlaneStrain) {
  // Where the lattice happens to reach out, more points are near the surface: each piece of the edge counts alike.
  const double h = 0.05;
  constexpr int kPieces = 60;
  Errors pieces;
  for (int k = 1; k <= 12; ++k) {
    const Vec3 shift{std::fmod(0.7549 * k, 1.0) * h, std::fmod(0.5698 * k, 1.0) * h, 0};
    const Frame frame = disk(shift, h);
    const FreeSurface found = free_surface(frame, 1);
    EXPECT_NEAR(found.spacing, h, 1e-6);
    std::array<Errors, kPieces> piece{};
    for (std::size_t i = 0; i < found.cloud.size(); ++i) {
      const Vec3& p = found.cloud.positions[i];
      EXPECT_EQ(p[2], 0);
      EXPECT_GT(dot(p, found.cloud.normals[i]), 0.9);
      EXPECT_NEAR(norm(p), 1, 0.6 * h);
      const double angle = std::atan2(p[1], p[0]) / (2 * std::numbers::pi) + 0.5;
      piece[std::min(kPieces - 1, static_cast<int>(angle * kPieces))].add((norm(p) - 1) / h, 0);
    }
    for (const Errors& e : piece) pieces.add(e.bias(), 0);
    EXPECT_THROW(surface_raster(found, covering_grid(frame.positions, 0.1), CellPolicy::mean, 1), Error);
  }
  std::printf("| disk in plane strain | bias %+.4f h | spread %.3f h |\n", pieces.bias(), pieces.spread());
  EXPECT_LT(std::abs(pieces.bias()), 0.02) << "as in space";
  // The steps of the lattice run along the whole slab and do not average out: at most one layer's error all around.
  EXPECT_LT(pieces.spread(), 1 / std::sqrt(12.0));
}

TEST(FreeSurface, TheSameBitsForAnyThreads) {
  const Frame frame = Solid{.top = shapes()[4].top}.frame();
  const FreeSurface one = free_surface(frame, 1), three = free_surface(frame, 3);
  EXPECT_EQ(one.cloud.positions, three.cloud.positions);
  EXPECT_EQ(one.cloud.normals, three.cloud.normals);
}

Frame column() {
  Frame frame;
  frame.positions = {{0, 0, 0}, {0, 0, 1}, {0.25, 0, 2}};
  frame.site = {{500000, 5400000, 0}, "EPSG:25832"};
  frame.fields = {{"displacement", "m", 3, std::vector<float>{9, 9, 9, 0, 3, 4, 1, 2, 2}},
                  {"surface", "1", 1, std::vector<std::uint8_t>{0, 1, 1}}};
  return frame;
}

TEST(FreeSurface, WithoutVolumesIsTheMarkedCentres) {
  const FreeSurface surface = free_surface(column(), 1);
  EXPECT_EQ(surface.cloud.positions, (std::vector<Vec3>{{0, 0, 1}, {0.25, 0, 2}}));
  EXPECT_EQ(surface.cloud.site.origin, (Vec3{500000, 5400000, 0}));
  EXPECT_EQ(surface.cloud.site.crs, "EPSG:25832");
  ASSERT_EQ(surface.cloud.scalars.size(), 1u);
  EXPECT_EQ(surface.cloud.scalars[0].name, "displacement");
  EXPECT_EQ(surface.cloud.scalars[0].values, (std::vector<double>{5, 3}));
  EXPECT_EQ(surface.spacing, 0);
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_NE(surface.warnings[0].find("no field \"volume\""), std::string::npos);
}

TEST(FreeSurface, CarriesDisplacements) {
  Frame frame;
  add_box(frame, {0, 0, 0}, {1, 1, 0.5}, 0.1, 1);
  std::vector<float> displacement;
  for (std::size_t i = 0; i < frame.positions.size(); ++i) displacement.insert(displacement.end(), {0, 3, 4});
  frame.fields.push_back({"displacement", "m", 3, displacement});
  const FreeSurface surface = free_surface(frame, 1);
  ASSERT_EQ(surface.cloud.scalars.size(), 2u);
  EXPECT_EQ(surface.cloud.scalars[1].values, std::vector<double>(surface.cloud.size(), 5));
}

TEST(FreeSurface, RefusesFramesWithoutOne) {
  Frame frame = column();
  frame.fields[1].values = std::vector<std::uint8_t>{0, 0, 0};
  EXPECT_THROW(free_surface(frame, 1), Error) << "none marked";
  frame.fields[1].values = std::vector<std::uint8_t>{1, 1};
  EXPECT_THROW(free_surface(frame, 1), Error) << "too short";
  frame.fields[1].values = std::vector<std::int32_t>{1, 1, 1};
  EXPECT_THROW(free_surface(frame, 1), Error) << "wrong type";
  frame.fields[1].name = "other";
  EXPECT_THROW(free_surface(frame, 1), Error) << "no such field";
  frame = column();
  frame.fields[0].values = std::vector<float>{1, 2, 3};
  EXPECT_THROW(free_surface(frame, 1), Error) << "displacement too short";
  EXPECT_THROW(free_surface(Frame{}, 1), Error);
  frame = column();
  frame.fields.push_back({"volume", "m3", 1, std::vector<float>{1, -1, 1}});
  EXPECT_THROW(free_surface(frame, 1), Error) << "negative volume";
}

}  // namespace
}  // namespace scarp
