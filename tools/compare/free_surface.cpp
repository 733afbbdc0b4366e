// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/free_surface.hpp"

#include <cmath>
#include <unordered_map>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/frame_values.hpp"
#include "tools/compare/local_surface.hpp"
#include "tools/compare/normals.hpp"
#include "tools/compare/surface_column.hpp"

namespace scarp {
namespace {

constexpr double kBuried = 1.25;    ///< spacings of material above a particle that hide it
constexpr double kTopmost = 1.5;    ///< spacings below the highest particle in plan that may still be on the surface
constexpr double kFacesUp = 0.25;   ///< vertical part of the normal from which a place is seen from above
constexpr double kOneSided = 0.05;  ///< of SurfaceColumns::outwards, from which it tells the sides apart
constexpr std::size_t kFewest = 8;  ///< neighbours of a quadric, with the point itself

/// The highest particle over every square of plan, edge `cell`.
class Skyline {
 public:
  Skyline(const MaterialPoints& points, double cell) : cell_(cell), flat_(points.plane_strain) {
    for (const Vec3& x : points.positions) {
      const auto [entry, first] = highest_.try_emplace(square(x), height(x));
      if (!first) entry->second = std::max(entry->second, height(x));
    }
  }
  bool is_topmost(const Vec3& x, double margin) const { return height(x) >= highest_.at(square(x)) - margin; }

 private:
  double height(const Vec3& x) const { return x[flat_ ? 1 : 2]; }
  std::uint64_t square(const Vec3& x) const {
    const auto i = static_cast<std::int64_t>(std::floor(x[0] / cell_));
    const auto j = static_cast<std::int64_t>(std::floor(x[flat_ ? 2 : 1] / cell_));
    return static_cast<std::uint64_t>(i) << 32 ^ (static_cast<std::uint64_t>(j) & 0xffffffffu);
  }
  double cell_;
  bool flat_;
  std::unordered_map<std::uint64_t, double> highest_;
};

/// Indices of the points that may be on the surface.
std::vector<std::size_t> candidates(const MaterialPoints& points, double spacing) {
  const Skyline skyline(points, spacing);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.marked[i] || skyline.is_topmost(points.positions[i], kTopmost * points.spacing(i))) found.push_back(i);
  return found;
}

/// Normals of planes through a candidate's neighbours among the candidates, out of the body.
class SurfaceNormals {
 public:
  SurfaceNormals(const MaterialPoints& points, const SurfaceColumns& columns, const std::vector<std::size_t>& which)
      : points_(points), columns_(columns), near_(at(points.positions, which)) {
    for (std::size_t i : which) positions_.push_back(points.positions[i]);
  }

  Vec3 of(std::size_t point) const {
    const Vec3& x = points_.positions[point];
    std::vector<Vec3> offsets;
    for (const Neighbour& n : near_.within(x, kSurfaceReach * points_.spacing(point)))
      offsets.push_back(positions_[n.index] - x);
    const Vec3 out = columns_.outwards(point);
    const std::optional<Vec3> plane = plane_normal(offsets);
    if (!plane) return norm(out) > kOneSided ? (1 / norm(out)) * out : points_.up;
    // In the middle of a thin layer both sides are out; a scanner stands above.
    const double across = dot(*plane, out);
    const double side = std::abs(across) > kOneSided ? across : dot(*plane, points_.up);
    return side < 0 ? -1.0 * *plane : *plane;
  }

 private:
  static std::vector<Vec3> at(const std::vector<Vec3>& positions, const std::vector<std::size_t>& which) {
    std::vector<Vec3> chosen;
    for (std::size_t i : which) chosen.push_back(positions[i]);
    return chosen;
  }
  const MaterialPoints& points_;
  const SurfaceColumns& columns_;
  Neighbours near_;
  std::vector<Vec3> positions_;
};

/// A place on the surface, and the point that it belongs to.
struct Place {
  std::size_t point;
  SurfacePiece piece;
};

struct Places {
  std::vector<Place> places;
  std::size_t alone = 0;
};

Places find_places(const MaterialPoints& points, double spacing, int threads) {
  const PointTree tree(points.positions);
  const SurfaceColumns columns(points, tree);
  const std::vector<std::size_t> which = candidates(points, spacing);
  const SurfaceNormals normals(points, columns, which);
  std::vector<std::optional<SurfacePiece>> pieces(which.size());
  parallel_for(which.size(), threads, [&](std::size_t k) { pieces[k] = columns.at(which[k], normals.of(which[k])); });
  Places found;
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::size_t i = which[k];
    if (!pieces[k]) {
      found.alone += points.own[i];
      continue;
    }
    const bool seen = points.marked[i] || dot(pieces[k]->normal, points.up) > kFacesUp;
    if (seen && pieces[k]->height <= kBuried) found.places.push_back({i, *pieces[k]});
  }
  return found;
}

struct SurfacePoint {
  Vec3 position, normal;
  double uncertainty;  ///< m
};

/// The places laid on quadrics.
class Smoothing {
 public:
  Smoothing(const MaterialPoints& points, const std::vector<Place>& places)
      : points_(points), places_(places), near_(positions_of(places)) {}

  SurfacePoint of(std::size_t k) const {
    const SurfacePiece& piece = places_[k].piece;
    const double spacing = points_.spacing(places_[k].point);
    std::vector<Vec3> around;
    for (const Neighbour& n : near_.within(piece.position, kSurfaceReach * spacing)) {
      const SurfacePiece& other = places_[n.index].piece;
      // The far side of a thin body or of an edge is another surface.
      if (dot(other.normal, piece.normal) > 0.5) around.push_back(other.position);
    }
    const double floor = spacing / std::sqrt(12.0);
    const auto quadric = around.size() < kFewest ? std::nullopt : LocalSurface::fit(around, true);
    if (!quadric) return {piece.position, piece.normal, std::max(floor, spacing / 2)};
    const LocalSurface::Foot foot = quadric->foot(piece.position);
    const Vec3 normal = dot(foot.normal, piece.normal) < 0 ? -1.0 * foot.normal : foot.normal;
    const double squared = spacing * spacing, bulge = dot(normal, foot.normal) * foot.curvature;
    double sum = 0;
    for (const Vec3& p : around) sum += quadric->distance(p) * quadric->distance(p);
    return {foot.position - 0.5 * kKernelMoment * squared * bulge * normal, normal,
            std::max(floor, std::sqrt(sum / static_cast<double>(around.size())))};
  }

 private:
  static std::vector<Vec3> positions_of(const std::vector<Place>& places) {
    std::vector<Vec3> positions;
    for (const Place& place : places) positions.push_back(place.piece.position);
    return positions;
  }
  const MaterialPoints& points_;
  const std::vector<Place>& places_;
  Neighbours near_;
};

double magnitude(const std::vector<float>& rows, std::size_t components, std::size_t row) {
  double squared = 0;
  for (std::size_t c = 0; c < components; ++c)
    squared += double(rows[row * components + c]) * rows[row * components + c];
  return std::sqrt(squared);
}

/// Without volumes: who was marked, where its centre is.
FreeSurface marked_centres(const Frame& frame) {
  const auto* surface = values_of<std::uint8_t>(frame, "surface", "uint8, 1 on the free surface");
  if (!surface || surface->size() != frame.positions.size())
    throw Error("compare", "the frame does not say which particles form the free surface",
                surface ? "a vector field" : "no field", "a uint8 field \"surface\" with one value per particle");
  const auto* displacement = values_of<float>(frame, "displacement", "float32");
  FreeSurface result;
  result.words = "centres of the particles marked as surface";
  result.warnings.push_back(
      "The frame has no field \"volume\": its surface is that of the centres of its particles, half a spacing below "
      "the "
      "surface of the body, and its spacing is not known.");
  PointScalar moved{"displacement", "m", {}};
  for (std::size_t p = 0; p < frame.positions.size(); ++p) {
    if ((*surface)[p] != 1) continue;
    result.cloud.positions.push_back(frame.positions[p]);
    if (displacement)
      moved.values.push_back(magnitude(*displacement, displacement->size() / frame.positions.size(), p));
  }
  if (displacement) result.cloud.scalars.push_back(std::move(moved));
  return result;
}

FreeSurface reconstructed(const Frame& frame, int threads) {
  const MaterialPoints points = material_points(frame);
  FreeSurface result;
  result.spacing = spacing_of(frame);
  result.plane_strain = points.plane_strain;
  const Places found = find_places(points, result.spacing, threads);
  const Smoothing smoothing(points, found.places);
  std::vector<SurfacePoint> surface(found.places.size());
  parallel_for(surface.size(), threads, [&](std::size_t k) {
    if (points.own[found.places[k].point]) surface[k] = smoothing.of(k);
  });
  const auto* displacement = values_of<float>(frame, "displacement", "float32");
  PointScalar uncertainty{"uncertainty", "m", {}}, moved{"displacement", "m", {}};
  for (std::size_t k = 0; k < surface.size(); ++k) {
    const std::size_t point = found.places[k].point, p = points.particle[point];
    if (!points.own[point]) continue;
    Vec3 position = surface[k].position;
    if (points.plane_strain) position[2] = points.positions[point][2];  // alike all along the slab
    result.cloud.positions.push_back(position);
    result.cloud.normals.push_back(surface[k].normal);
    uncertainty.values.push_back(surface[k].uncertainty);
    if (displacement)
      moved.values.push_back(magnitude(*displacement, displacement->size() / frame.positions.size(), p));
  }
  result.alone = found.alone;
  result.cloud.scalars.push_back(std::move(uncertainty));
  if (displacement) result.cloud.scalars.push_back(std::move(moved));
  result.words = "free surface from the volumes of the material points, " + shortest(result.spacing) + " m apart";
  if (found.alone > 0) result.words += "; " + std::to_string(found.alone) + " particles on their own left out";
  return result;
}

}  // namespace

FreeSurface free_surface(const Frame& frame, int threads) {
  FreeSurface result = find_field(frame, "volume") ? reconstructed(frame, threads) : marked_centres(frame);
  result.cloud.site = frame.site;
  if (result.cloud.empty())
    throw Error("compare", "the frame has no free surface",
                "0 of " + std::to_string(frame.positions.size()) + " particles", "at least 1 particle on the surface");
  return result;
}

}  // namespace scarp
