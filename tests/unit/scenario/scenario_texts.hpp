// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"
#include "tools/scenario/read_scenario.hpp"

namespace scarp::test {

/// The textbook problem of the design page, with the features that are there.
inline const std::string kDisks = R"(title = "Two elastic disks"
[domain]
dimension = 2
cell = 0.025
min = [0, 0]
max = [1, 1]
[materials.elastic]
model = "neo-hookean"
density = 1000
youngs_modulus = 1000
poissons_ratio = 0.3
[[bodies]]
name = "left"
volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }
points_per_cell = 4
material = "elastic"
velocity = [0.1, 0.1]
formulation = "total-lagrangian"
[[bodies]]
name = "right"
volume = { disk = { centre = [0.8, 0.8], radius = 0.2 } }
points_per_cell = 4
material = "elastic"
velocity = [-0.1, -0.1]
[solver]
gravity = [0, 0]
courant = 0.2
end_time = 3.5
[output]
every = 0.05
history_every = 0.005
)";

/// A hillside with everything that a 3D scenario can say. `before.las`, `bedrock.asc` and `wall.ply` must exist.
inline const std::string kHillside = R"(title = "Hillside \"A\""

[[scans]]
name = "before"
file = "before.las"
height_unit = "ft"
clean = [
  { filter = "crop", min = [0, 0, -50], max = ["0.2 km", 120, 90] },
  { filter = "statistical-outlier", neighbours = 12, deviations = 1.5 },
  { filter = "voxel-thin", size = "25 cm" },
]
[[scans]]
name = "after"
[scans.synthetic]
seed = 7
site_offset = [600000, 200000, 400]
slide = { scar_centre = [50, 60], scar_radius = 12, depth = 3, travel = 30 }

[domain]
cell = 0.5
boundary = { z_min = "fixed", x_min = "roller" }

[materials.colluvium]
model = "mohr-coulomb"
density = "1.9 t/m3"
youngs_modulus = "20 MPa"
poissons_ratio = 0.3
cohesion = "2 kPa"
friction_angle = 28
[materials."old wall"]
model = "linear-elastic"
density = 2200
youngs_modulus = 1e9
poissons_ratio = 0.2

[[bodies]]
name = "slide"
volume = { scan = "before", close = "depth", depth = 6.0, outline = [[0, 0], [10, 0], [10, 10]] }
material = "colluvium"
cell = 0.4
materials = [
  { below = "bedrock.asc", use = "old wall" },
  { class = 6, use = "old wall" },
  { box = { min = [0, 0, 0], max = [1, 1, 1] }, use = "colluvium" },
  { prism = [[0, 0], [4, 0], [4, 4]], use = "old wall" },
]
[[bodies]]
name = "wall"
volume = { mesh = "wall.ply" }
points_per_cell = 27
material = "old wall"
[[bodies]]
name = "block"
volume.box = { min = [1, 2, 3], max = [4, 5, 6] }
material = "old wall"
velocity = [0, 0, "-3.6 km/h"]
[[bodies]]
name = "ball"
volume.sphere = { centre = [1, 2, 3], radius = 1 }
material = "old wall"
[[bodies]]
name = "base"
volume = { scan = "before", base_elevation = 395.5 }
material = "old wall"

[solver]
flip = 0.99
end_time = 20

[output]
fields = ["displacement", "velocity", "deformation_gradient"]

[[render]]
name = "overview"
colour = { field = "velocity.z", map = "viridis", range = [0, 10], bands = 5 }
camera = { view = "top", azimuth = "0.5 rad" }

[[compare]]
observed = "after"
tolerance = { mean = 0.3, percentile_95 = 1 }
)";

class ScenarioFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"before.las", "bedrock.asc", "wall.ply"}) std::ofstream(folder_.path() / name) << "x";
  }
  Scenario parse(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_scenario(text, "a.toml", folder_.path(), overrides);
  }
  /// The text of the error that reading gives.
  std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    try {
      parse(text, overrides);
    } catch (const Error& error) {
      EXPECT_EQ(error.stage(), "scenario");
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
};

/// `text` with its first `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace scarp::test
