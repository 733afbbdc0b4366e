// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_cloud.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "ingest/read_buffered.hpp"
#include "ingest/read_las.hpp"
#include "ingest/read_pcd.hpp"
#include "ingest/read_ply.hpp"
#include "ingest/read_raster.hpp"
#include "ingest/read_text.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

enum class Format { las, laz, ply, pcd, raster, text };

constexpr std::string_view kRead =
    "LAS, LAZ, COPC, PLY, PCD, ESRI ASCII grid, GeoTIFF, XYZ/TXT/CSV/PTS text; convert others to LAS or PLY, with "
    "CloudCompare for example (rasters: to GeoTIFF, with gdal_translate)";

/// First bytes of formats that are not read, under whatever name they come.
struct Foreign {
  std::string_view magic, name;
};
constexpr Foreign kForeign[] = {{"ASTM-E57", "E57"},
                                {"PK\x03\x04", "a zip archive"},
                                {"\x1f\x8b", "a gzip archive"},
                                {"\x89HDF", "HDF5"},
                                {"\x89PNG", "PNG"},
                                {"%PDF", "PDF"}};

/// A PCD begins with its version, with or without the comment that names the format.
bool is_pcd(std::string_view beginning) {
  while (!beginning.empty()) {
    const std::size_t stop = std::min(beginning.find('\n'), beginning.size());
    const std::string_view line = beginning.substr(0, stop);
    if (line.starts_with("# .PCD") || line.starts_with("VERSION ") || line.starts_with("FIELDS ")) return true;
    if (!is_blank(line) && !is_comment(line)) return false;
    beginning.remove_prefix(std::min(stop + 1, beginning.size()));
  }
  return false;
}

Format format_by_extension(const std::filesystem::path& path) {
  static constexpr std::array<std::pair<std::string_view, Format>, 12> known{{{".las", Format::las},
                                                                              {".laz", Format::las},
                                                                              {".ply", Format::ply},
                                                                              {".pcd", Format::pcd},
                                                                              {".xyz", Format::text},
                                                                              {".txt", Format::text},
                                                                              {".csv", Format::text},
                                                                              {".pts", Format::text},
                                                                              {".asc", Format::text},
                                                                              {".xyzn", Format::text},
                                                                              {".xyzrgb", Format::text},
                                                                              {".dat", Format::text}}};
  const std::string extension = lower_case(path.extension().string());
  for (const auto& [text, format] : known)
    if (text == extension) return format;
  if (extension == ".obj" || extension == ".stl")
    throw Error("ingest", "is a surface mesh, not a cloud", shown(extension),
                "a mesh as the volume of a body; or as a scan: " + std::string(kRead), {path.string()});
  throw Error("ingest", "format is not read", shown(extension), std::string(kRead), {path.string()});
}

Format format_of(const std::filesystem::path& path) {
  BufferedFile file(path);
  if (file.size() == 0) throw Error("ingest", "is empty", {}, {}, {path.string()});
  const std::string_view beginning = file.peek();
  if (beginning.starts_with("LASF")) {
    // The two high bits of the point format are set by compressors (LAZ specification, 2019).
    constexpr std::size_t kPointFormat = 104;
    return beginning.size() > kPointFormat && (beginning[kPointFormat] & 0xC0) ? Format::laz : Format::las;
  }
  if (beginning.starts_with("ply\n") || beginning.starts_with("ply\r") || beginning.starts_with("ply "))
    return Format::ply;
  if (is_pcd(beginning)) return Format::pcd;
  if (is_raster(beginning)) return Format::raster;
  for (const Foreign& foreign : kForeign)
    if (beginning.starts_with(foreign.magic))
      throw Error("ingest", "format is not read", std::string(foreign.name), std::string(kRead), {path.string()});
  return format_by_extension(path);
}

}  // namespace

PointCloud read_cloud(const std::filesystem::path& path, const std::optional<LazConverter>& laz) {
  switch (format_of(path)) {
    case Format::las:
      return read_las(path);
    case Format::laz:
      return read_laz(path, laz ? *laz : default_laz_converter());
    case Format::ply:
      return read_ply(path);
    case Format::pcd:
      return read_pcd(path);
    case Format::raster:
      return raster_to_cloud(read_raster(path));
    case Format::text:
      return read_text(path);
  }
  return {};
}

}  // namespace scarp
