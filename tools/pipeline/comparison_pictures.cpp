// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/comparison_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "tools/compare/raster_grid.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/render/chart_picture.hpp"
#include "tools/render/map_picture.hpp"
#include "tools/render/write_picture.hpp"

namespace scarp {
namespace {

const Heightfield* find_raster(const Comparison& result, const std::string& name) {
  for (const NamedRaster& raster : result.rasters)
    if (raster.name == name) return &raster.raster;
  return nullptr;
}

/// A scalar of a cloud as a raster, means of the points in each cell.
Heightfield as_raster(const PointCloud& cloud, const PointScalar& scalar, const RasterGrid& grid) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (std::isfinite(scalar.values[i]))
      points.push_back({cloud.positions[i][0], cloud.positions[i][1], scalar.values[i]});
  Heightfield raster = grid_points(points, cloud.site, grid, CellPolicy::mean, nullptr);
  raster.site.origin[2] = 0;
  return raster;
}

/// So large that most cells between the points hold one.
RasterGrid grid_of_points(const PointCloud& cloud) {
  const Box3 box = bounds(cloud.positions);
  const double area = std::max(1e-12, (box.max[0] - box.min[0]) * (box.max[1] - box.min[1]));
  return covering_grid(cloud.positions, 1.5 * std::sqrt(area / static_cast<double>(cloud.size())));
}

double mean_of(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (double v : values)
    if (std::isfinite(v)) sum += v, count += 1;
  return count > 0 ? sum / count : 0;
}

class Album {
 public:
  Album(const std::filesystem::path& stem) : stem_(stem.string()) {}
  void add(const std::string& name, const Picture& picture) {
    files.emplace_back(stem_ + "_" + name + ".png");
    write_png(files.back(), picture);
  }
  std::vector<std::filesystem::path> files;

 private:
  std::string stem_;
};

/// What the report says in one line, without the comparison's name, as it is printed.
std::string remarks_of(const ComparisonReport& report) {
  const std::string line = in_one_line(report);
  std::string text = line.substr(std::min(line.size(), report.name.size() + 2));
  const auto replace_all = [&](const std::string& plain, const std::string& printed) {
    for (std::size_t at = 0; (at = text.find(plain, at)) != std::string::npos; at += printed.size())
      text.replace(at, plain.size(), printed);
  };
  replace_all(" m3", " m³");
  replace_all(" -", " −");
  return text;
}

void add_points(const Comparison& result, const std::string& title, Album& album) {
  const PointScalar* distance = find_scalar(result.cloud, "distance");
  if (!distance || std::none_of(distance->values.begin(), distance->values.end(), [](double d) { return d == d; }))
    return;
  const PointScalar* lod = find_scalar(result.cloud, "lod");
  const RasterGrid grid = grid_of_points(result.cloud);
  const Heightfield distances = as_raster(result.cloud, *distance, grid);
  Heightfield levels;
  if (lod) levels = as_raster(result.cloud, *lod, grid);
  const std::string label = "distance, mean of the points in a cell";
  album.add("difference", draw_difference_map(
                              {&distances, lod ? &levels : nullptr, nullptr, title, label, remarks_of(result.report)}));
  album.add("histogram", draw_histogram({distance->values, lod ? mean_of(lod->values) : 0, title, "distance", ""}));
}

/// The plan part of three scalars; empty if there are none.
std::vector<Vec2> plan_vectors(const PointCloud& cloud, const std::string& x, const std::string& y) {
  const PointScalar *dx = find_scalar(cloud, x), *dy = find_scalar(cloud, y);
  std::vector<Vec2> vectors;
  for (std::size_t i = 0; dx && dy && i < cloud.size(); ++i) vectors.push_back({dx->values[i], dy->values[i]});
  return vectors;
}

std::string title_of(const ComparisonReport& report) {
  return report.name + ": " + report.sides.observed + " against " + report.sides.simulated + " (" + report.method + ")";
}

}  // namespace

std::vector<std::filesystem::path> write_vector_pictures(const std::filesystem::path& stem, const Comparison& result,
                                                         const Heightfield& ground) {
  Album album(stem);
  const SideNames& sides = result.report.sides;
  VectorMap map{&ground,
                {},
                plan_vectors(result.cloud, "dx", "dy"),
                plan_vectors(result.cloud, "simulated_dx", "simulated_dy"),
                title_of(result.report),
                remarks_of(result.report)};
  for (const Vec3& p : result.cloud.positions) map.at.push_back({p[0], p[1]});
  map.simulated_name = sides.simulated;
  map.observed_name = map.simulated.empty() ? sides.simulated + " to " + sides.observed : sides.observed;
  album.add("vectors", draw_vector_map(map));
  const PointScalar* distance = find_scalar(result.cloud, "distance");
  if (std::any_of(distance->values.begin(), distance->values.end(), [](double d) { return d == d; }))
    album.add("histogram",
              draw_histogram({distance->values, 0, map.title,
                              map.simulated.empty() ? "length of vectors" : "length of observed − simulated", ""}));
  return album.files;
}

std::vector<std::filesystem::path> write_pictures(const std::filesystem::path& stem, const Comparison& result,
                                                  const Heightfield* ground, const Section* section) {
  Album album(stem);
  const SideNames& sides = result.report.sides;
  const std::string title = title_of(result.report);
  const std::string label = sides.observed + " − " + sides.simulated;
  if (!result.cloud.empty()) add_points(result, title, album);
  const Heightfield* difference = find_raster(result, "difference");
  const Heightfield* level = find_raster(result, "level_of_detection");
  if (difference) {
    album.add("difference", draw_difference_map({difference, level, ground, title, label, remarks_of(result.report)}));
    album.add("histogram", draw_histogram({difference->z, level ? mean_of(level->z) : 0, title, label, ""}));
  }
  if (const Heightfield* cells = find_raster(result, "footprint"))
    album.add("footprint",
              draw_footprint_map({cells, ground, title, remarks_of(result.report), sides.simulated, sides.observed}));
  if (section) {
    SectionChart chart{section->s, section->simulated, section->observed, title, sides.simulated, sides.observed};
    for (std::vector<double>* z : {&chart.simulated, &chart.observed})
      for (double& v : *z) v += section->site.origin[2];
    album.add("section", draw_section(chart));
  }
  return album.files;
}

}  // namespace scarp
