// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/same_crs.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "ingest/crs_text.hpp"

#ifdef SCARP_WITH_GDAL
#include <cpl_conv.h>
#include <cpl_error.h>
#include <ogr_spatialref.h>
#endif

namespace scarp {
namespace {

std::string without_blanks(const std::string& text) {
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
               [](unsigned char c) { return !std::isspace(c) && c != '\0'; });
  return result;
}

#ifdef SCARP_WITH_GDAL

/// ESRI's text knows no order of axes: what is "northing, easting" in the register comes back as east, north, the order
/// in which files hold coordinates. Not every system has such a text.
bool read_back_as_esri(OGRSpatialReference& system) {
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  char* text = nullptr;
  const bool written = system.exportToWkt(&text, options) == OGRERR_NONE;
  const bool read = written && system.importFromWkt(text) == OGRERR_NONE;
  CPLFree(text);
  return read;
}

bool equivalent(const std::string& a, const std::string& b) {
  OGRSpatialReference first, second;
  if (first.SetFromUserInput(a.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS) != OGRERR_NONE ||
      second.SetFromUserInput(b.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS) != OGRERR_NONE)
    return false;
  const bool with_heights = first.IsCompound() && second.IsCompound();
  if (!with_heights) first.StripVertical(), second.StripVertical();
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  if (first.IsSame(&second, options)) return true;
  return !with_heights && read_back_as_esri(first) && read_back_as_esri(second) && first.IsSame(&second, options);
}

bool same_in_database(const std::string& a, const std::string& b) {
  CPLPushErrorHandler(CPLQuietErrorHandler);  // what PROJ cannot read is no error here
  const bool same = equivalent(a, b);
  CPLPopErrorHandler();
  CPLErrorReset();
  return same;
}

#else

bool same_in_database(const std::string&, const std::string&) { return false; }

#endif

}  // namespace

bool same_crs(const std::string& a, const std::string& b) {
  if (without_blanks(a) == without_blanks(b)) return true;
  const int code = read_crs(a).epsg;
  if (code > 0 && code == read_crs(b).epsg) return true;
  return same_in_database(a, b);
}

}  // namespace scarp
