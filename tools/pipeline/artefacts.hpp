// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace scarp {

/// Names of everything below an output folder; they are a contract with the user's scripts.
struct Artefacts {
  std::filesystem::path root;

  std::filesystem::path scenario() const { return root / "scenario.toml"; }
  std::filesystem::path cloud(const std::string& scan) const { return root / "clouds" / (scan + ".las"); }
  std::filesystem::path ingest_report() const { return root / "clouds" / "ingest.json"; }
  std::filesystem::path model() const { return root / "model.hdf"; }
  std::filesystem::path frames() const { return root / "frames"; }
  std::filesystem::path frame(std::int64_t index) const { return frames() / numbered("frame", index, ".hdf"); }
  std::filesystem::path series() const { return root / "frames.hdf.series"; }
  std::filesystem::path history() const { return root / "history.csv"; }
  std::filesystem::path probes() const { return root / "probes"; }
  std::filesystem::path probe(const std::string& name) const { return probes() / (name + ".csv"); }
  std::filesystem::path shaking(std::size_t index) const {
    return root / ("shaking_" + std::to_string(index) + ".csv");
  }
  std::filesystem::path images() const { return root / "images"; }
  std::filesystem::path image(const std::string& name, std::int64_t index) const {
    return images() / numbered(name, index, ".png");
  }
  std::filesystem::path compared(const std::string& name, const std::string& extension) const {
    return root / "compare" / (name + extension);
  }
  std::filesystem::path summary() const { return root / "summary.json"; }

 private:
  static std::string numbered(const std::string& stem, std::int64_t index, const char* extension) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "_%06lld", static_cast<long long>(index));
    return stem + digits + extension;
  }
};

}  // namespace scarp
