// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_geotiff.hpp"

#include <string>

#include "solver/model/error.hpp"

#ifdef SCARP_WITH_GDAL
#include <cpl_error.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "ingest/crs_text.hpp"
#include "ingest/text_scanner.hpp"
#endif

namespace scarp {

bool is_tiff(std::string_view beginning) {
  for (const std::string_view magic : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                       std::string_view("II+\0", 4), std::string_view("MM\0+", 4)})
    if (beginning.starts_with(magic)) return true;
  return false;
}

#ifndef SCARP_WITH_GDAL

Heightfield read_geotiff(const std::filesystem::path& path) {
  throw Error("ingest", "this build reads no GeoTIFF", "TIFF",
              "a build with GDAL (SCARP_WITH_GDAL), or an ESRI ASCII grid (gdal_translate -of AAIGrid)",
              {path.string()});
}

#else

namespace {

constexpr double kMostCells = 1 << 28;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what, const std::string& found,
                         const std::string& allowed) {
  throw Error("ingest", what, found, allowed, {path.string()});
}

/// GDAL would print its messages; they are kept for ours instead.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler), CPLErrorReset(); }
  ~QuietGdal() { CPLPopErrorHandler(), CPLErrorReset(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  static std::string message() { return shown(CPLGetLastErrorMsg()); }
};

struct Close {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, Close>;

Dataset open(const std::filesystem::path& path) {
  GDALRegister_GTiff();
  // No other driver, and no file beside this one: a TIFF is all that is asked for.
  const char* const drivers[] = {"GTiff", nullptr};
  const char* const siblings[] = {nullptr};
  Dataset dataset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr, siblings));
  if (!dataset) refuse(path, "cannot be read as a GeoTIFF", QuietGdal::message(), "a GeoTIFF of heights");
  return dataset;
}

void place(const std::filesystem::path& path, GDALDatasetH dataset, Heightfield& field) {
  std::array<double, 6> to_site{};
  if (GDALGetGeoTransform(dataset, to_site.data()) != CE_None)
    refuse(path, "TIFF without a georeference", "no pixel scale and tie point", "a GeoTIFF");
  const double width = to_site[1], height = -to_site[5];
  for (double v : to_site)
    if (!std::isfinite(v)) refuse(path, "georeference of a raster", shortest(v), "finite numbers");
  if (to_site[2] != 0 || to_site[4] != 0) refuse(path, "raster that is rotated", "", "rows along x");
  if (!(width > 0 && height > 0) || std::abs(width - height) > 1e-9 * width)
    refuse(path, "cells of a raster that are not squares, north up", shortest(width) + " x " + shortest(height),
           "equal sizes above 0; resample the raster (gdalwarp -tr)");
  field.cell = width;
  field.x0 = to_site[0] + 0.5 * width;
  field.y0 = to_site[3] - (field.rows - 0.5) * height;
}

/// The one band of a raster of heights.
GDALRasterBandH band_of(const std::filesystem::path& path, GDALDatasetH dataset) {
  const int bands = GDALGetRasterCount(dataset);
  if (bands != 1)
    refuse(path, "bands of a raster of heights", std::to_string(bands), "1 (gdal_translate -b 1 picks one)");
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  if (GDALDataTypeIsComplex(GDALGetRasterDataType(band))) refuse(path, "values of a raster", "complex", "real");
  const std::string unit = lower_case(GDALGetRasterUnitType(band));
  for (const char* metre : {"", "m", "metre", "meter", "metres", "meters"})
    if (unit == metre) return band;
  refuse(path, "unit of a raster's heights", shown(unit), "metres");
}

void read_band(const std::filesystem::path& path, GDALRasterBandH band, Heightfield& field) {
  const int columns = field.columns;
  const double scale = GDALGetRasterScale(band, nullptr), offset = GDALGetRasterOffset(band, nullptr);
  const bool masked = !(GDALGetMaskFlags(band) & GMF_ALL_VALID);
  std::vector<std::uint8_t> valid(static_cast<std::size_t>(columns), 1);
  for (int row = 0; row < field.rows; ++row) {
    double* values = field.z.data() + static_cast<std::size_t>(field.rows - 1 - row) * columns;
    const auto line = [&](GDALRasterBandH from, void* to, GDALDataType type) {
      if (GDALRasterIO(from, GF_Read, 0, row, columns, 1, to, columns, 1, type, 0, 0) != CE_None)
        refuse(path, "row " + std::to_string(row) + " of a raster cannot be read", QuietGdal::message(),
               "a whole file");
    };
    line(band, values, GDT_Float64);
    if (masked) line(GDALGetMaskBand(band), valid.data(), GDT_Byte);
    for (int c = 0; c < columns; ++c) {
      values[c] =
          valid[static_cast<std::size_t>(c)] ? values[c] * scale + offset : std::numeric_limits<double>::quiet_NaN();
      if (std::isinf(values[c])) refuse(path, "height in a raster", shortest(values[c]), "finite");
    }
  }
}

}  // namespace

Heightfield read_geotiff(const std::filesystem::path& path) {
  const QuietGdal quiet;
  const Dataset dataset = open(path);
  Heightfield field;
  field.columns = GDALGetRasterXSize(dataset.get());
  field.rows = GDALGetRasterYSize(dataset.get());
  const double cells = double(field.columns) * field.rows;
  if (!(cells >= 1 && cells <= kMostCells)) refuse(path, "cells of a raster", shortest(cells), "1 to 2^28");
  place(path, dataset.get(), field);
  const GDALRasterBandH band = band_of(path, dataset.get());
  field.z.resize(static_cast<std::size_t>(cells));
  read_band(path, band, field);
  field.site.crs = GDALGetProjectionRef(dataset.get());
  const CrsFacts facts = read_crs(field.site.crs);
  if (facts.vertical_unit > 0 && std::abs(facts.vertical_unit - 1) > 1e-9)
    refuse(path, "unit of a raster's heights", shortest(facts.vertical_unit) + " m", "metres");
  return field;
}

#endif

}  // namespace scarp
