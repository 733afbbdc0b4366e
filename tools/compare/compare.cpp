// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/compare.hpp"

#include <array>
#include <string>

#include "solver/model/error.hpp"
#include "tools/compare/c2c.hpp"
#include "tools/compare/c2m.hpp"
#include "tools/compare/m3c2.hpp"

namespace scarp {
namespace {

constexpr std::array<const char*, 3> kSideNames{"a point cloud", "a raster", "a mesh"};

/// What the method needs a side to be. `which`: "simulated", "observed".
template <class Geometry, class Side>
auto& need(Side& side, const std::string& which, const CompareOptions& options) {
  if (auto* geometry = std::get_if<Geometry>(&side)) return *geometry;
  throw Error("compare", "method \"" + std::string(name_of(options.method)) + "\" and the " + which + " side",
              kSideNames[side.index()], kSideNames[ComparedSide(Geometry{}).index()]);
}

}  // namespace

Comparison compare(ComparedSide simulated, const ComparedSide& observed, const PointCloud* cores,
                   const CompareOptions& options, int threads) {
  switch (options.method) {
    case CompareMethod::c2c:
      return compare_c2c(std::move(need<PointCloud>(simulated, "simulated", options)),
                         need<PointCloud>(observed, "observed", options), options, threads);
    case CompareMethod::m3c2:
      return compare_m3c2(need<PointCloud>(simulated, "simulated", options),
                          need<PointCloud>(observed, "observed", options), cores, options, threads);
    case CompareMethod::c2m:
      return compare_c2m(std::move(need<PointCloud>(simulated, "simulated", options)),
                         need<TriangleMesh>(observed, "observed", options), options, threads);
    case CompareMethod::dod:
    case CompareMethod::footprint:
    case CompareMethod::displacement:
      throw Error("compare", "method \"" + std::string(name_of(options.method)) + "\" and two sides as they are");
  }
  return {};
}

}  // namespace scarp
