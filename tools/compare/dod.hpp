// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/model/dod_options.hpp"
#include "solver/model/heightfield.hpp"
#include "tools/compare/stable_ground.hpp"
#include "tools/compare/volume_uncertainty.hpp"

namespace scarp {

/// A volume of difference over the cells that it counts.
struct DodVolume {
  double volume = 0;  ///< m3; `removed` is negative
  double area = 0;    ///< m2
  std::size_t cells = 0;
  VolumeSigma sigma;
};

struct DodVolumes {
  DodVolume added;    ///< cells where the observed surface is above the simulated one
  DodVolume removed;  ///< below
  DodVolume net;      ///< both and those that are equal
};

/// Of the differences of all cells compared, m.
struct DodStatistics {
  double mean = 0, median = 0, standard_deviation = 0, nmad = 0, root_mean_square = 0;
  double smallest = 0, percentile_5 = 0, percentile_95 = 0, largest = 0;
};

struct DodReport {
  std::string name;
  RasterGrid grid;
  std::size_t cells_compared = 0, only_simulated = 0, only_observed = 0;
  double average_neighbours = 0;  ///< of the 8 around a compared cell, those that are compared too
  DodStatistics statistics;       ///< after removal of the bias, if it was removed
  std::optional<StableReport> stable;
  bool bias_removed = false;
  double sigma_simulated = 0, sigma_observed = 0;  ///< root mean squares over the cells compared, m
  std::string sigma_simulated_from, sigma_observed_from;
  double shared_sigma = 0;  ///< of the vertical shift that all cells share: registration error and removed bias, m
  double confidence = 0, factor = 0;
  double level_of_detection = 0;  ///< mean over the cells compared, m
  double correlation_range = 0;   ///< m; 0: not known
  DodVolumes all;                 ///< every cell compared
  DodVolumes significant;         ///< cells whose difference exceeds their level of detection
  /// Root mean square of what noise does not explain: sqrt(max(0, rms^2 - mean of sigma^2 - shared_sigma^2)), m.
  double misfit_beyond_noise = 0;
};

struct DodResult {
  Heightfield difference;                 ///< observed - simulated, m, without the bias if it was removed
  Heightfield level_of_detection;         ///< m
  std::vector<std::uint8_t> significant;  ///< |difference| > level of detection
  DodReport report;
};

/// Two surfaces on the same cells.
struct DodInput {
  const Heightfield& simulated;
  const Heightfield& observed;
  /// Standard deviation of each simulated height, m; empty: options.uncertainty_simulated or 0.
  const std::vector<double>& sigma_simulated;
  const Heightfield* stable_mask = nullptr;  ///< for options.stable.ground = mask
  double registration_error = 0;             ///< standard deviation of a vertical shift that all cells share, m
};

/// DEM of difference: observed - simulated in every cell where both have data, its level of detection
/// z (sqrt(sigma_simulated^2 + sigma_observed^2) + shared sigma) with the two-sided normal factor z of the confidence
/// (the registration error outside of the root, as in M3C2: Lague et al. 2013, eq. 1), and volumes.
/// @throws Error when the grids differ or no cell has both heights; as find_stable
DodResult dem_of_difference(const DodInput& input, const DodOptions& options);

}  // namespace scarp
