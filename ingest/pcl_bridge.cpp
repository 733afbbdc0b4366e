// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/pcl_bridge.hpp"

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

#include "solver/model/error.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> to_pcl(const std::vector<Vec3>& positions, const std::string& purpose) {
  if (positions.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error("ingest", purpose + " takes fewer points", std::to_string(positions.size()), "below 2^31");
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!is_finite(positions[i])) throw Error("ingest", purpose + ": point " + std::to_string(i) + " is not finite");
  const Box3 box = bounds(positions);
  for (int a = 0; a < 3; ++a)
    if (box.max[a] - box.min[a] > kWidestForPcl)
      throw Error("ingest", purpose + " works in single precision and takes no cloud this wide",
                  shortest(box.max[a] - box.min[a]) + " m",
                  "at most " + shortest(kWidestForPcl) + " m (crop far outliers first)");
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(positions.size());
  const Vec3 centre = 0.5 * (box.min + box.max);
  for (const Vec3& p : positions) {
    const Vec3 d = p - centre;
    cloud->push_back({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])});
  }
  cloud->is_dense = true;
  return cloud;
}

}  // namespace scarp
