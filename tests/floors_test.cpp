// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Holds the includes of every source file against the house: includes point down, siblings on a floor do not know
// each other, each heavy library stays in the one room that owns it, and below the command line nothing prints,
// exits, reads the clock, the environment or chance.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Source {
  std::string path;  // relative to the project
  std::string room;
  std::string text;  // without comments
  std::string raw;
};

const std::map<std::string, int> kFloors{
    {"solver/model", 0},   {"solver/materials", 0},  {"solver/shapes", 0}, {"solver/kernels", 0},
    {"solver/core", 1},    {"ingest/neighbours", 1}, {"ingest", 2},        {"discretize", 2},
    {"solver/store", 2},   {"tools/render", 2},      {"tools/compare", 2}, {"tools/synth", 2},
    {"tools/pipeline", 3}, {"tools/scenario", 3},    {"tools/report", 3},  {"tools/cli", 4}};

/// Which rooms may include what starts so.
const std::vector<std::pair<std::string, std::set<std::string>>> kOwners{
    {"pcl/", {"ingest"}},
    {"gdal", {"ingest"}},
    {"cpl_", {"ingest"}},
    {"ogr_", {"ingest"}},
    {"CGAL/", {"discretize"}},
    {"opencv2/", {"tools/render"}},
    {"hdf5", {"solver/store"}},
    {"isa-l", {"solver/store"}},
    {"H5", {"solver/store"}},
    {"toml", {"tools/scenario"}},
    {"muParser", {"tools/scenario"}},
    {"nlohmann/", {"tools/pipeline", "tools/report"}},
    {"openssl/", {"tools/pipeline"}},
    {"CLI/", {"tools/cli"}},
    {"nanoflann", {"ingest/neighbours"}},
    {"Eigen/", {"solver/materials", "solver/core", "tools/compare"}},
    {"tbb/", {"solver/model"}},
    {"chrono", {"tools/cli", "tools/pipeline"}}};

std::string without_comments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

std::string room_of(const std::string& path) {
  std::string best;
  for (const auto& [room, floor] : kFloors)
    if (path.rfind(room + "/", 0) == 0 && room.size() > best.size()) best = room;
  return best;
}

std::vector<Source> sources() {
  std::vector<Source> found;
  const fs::path root = SCARP_SOURCE_DIR;
  for (const char* top : {"solver", "ingest", "discretize", "tools", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      if (entry.path().string().find("node_modules") != std::string::npos) continue;
      std::ifstream in(entry.path());
      std::stringstream text;
      text << in.rdbuf();
      const std::string path = fs::relative(entry.path(), root);
      found.push_back({path, room_of(path), without_comments(text.str()), text.str()});
    }
  return found;
}

std::vector<std::string> includes(const std::string& text) {
  static const std::regex pattern(R"re(#include\s*[<"]([^>"]+)[>"])re");
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    names.push_back((*match)[1]);
  return names;
}

bool allowed(const std::string& from, const std::string& to) {
  if (from == to) return true;
  const int here = kFloors.at(from), there = kFloors.at(to);
  if (there < here || (here == 0 && there == 0)) return true;
  return from == "tools/pipeline" && (to == "tools/scenario" || to == "tools/report");
}

TEST(Floors, IncludesPointDown) {
  std::size_t checked = 0;
  for (const Source& source : sources()) {
    if (source.path.rfind("tests/", 0) == 0) continue;
    ASSERT_FALSE(source.room.empty()) << source.path << " is in no room of the house";
    for (const std::string& name : includes(source.text)) {
      const std::string target = room_of(name);
      if (target.empty()) continue;
      EXPECT_TRUE(allowed(source.room, target)) << source.path << " includes " << name;
      ++checked;
    }
  }
  EXPECT_GT(checked, 50u);
}

TEST(Floors, HeavyLibrariesStayInTheirRoomAndOutOfHeaders) {
  for (const Source& source : sources()) {
    if (source.path.rfind("tests/", 0) == 0) continue;
    for (const std::string& name : includes(source.text))
      for (const auto& [prefix, rooms] : kOwners) {
        if (name.rfind(prefix, 0) != 0) continue;
        EXPECT_TRUE(rooms.count(source.room)) << source.path << " includes " << name;
        const bool light = prefix == "Eigen/" || prefix == "chrono" || name == "nlohmann/json_fwd.hpp";
        EXPECT_TRUE(light || source.path.ends_with(".cpp") || source.path.find("_hdf5") != std::string::npos ||
                    source.path.find("hdf5_") != std::string::npos)
            << source.path << " is a header and includes " << name;
      }
  }
}

TEST(Floors, OnlyTheCommandLinePrintsExitsOrAsksTheSystem) {
  const std::vector<std::regex> forbidden{std::regex(R"(std::c(out|err|log)\b)"),
                                          std::regex(R"((^|[^a-z_])f?printf\s*\()"),
                                          std::regex(R"(\bputs\s*\()"),
                                          std::regex(R"((^|[^a-z_:.>])(std::)?(exit|abort|_Exit|quick_exit)\s*\()"),
                                          std::regex(R"(\bgetenv\b)"),
                                          std::regex(R"(\brandom_device\b)"),
                                          std::regex(R"(\bsrand\b|\brand\s*\()"),
                                          std::regex(R"(catch\s*\([^)]*\)\s*\{\s*\})")};
  for (const Source& source : sources()) {
    if (source.path.rfind("tests/", 0) == 0 || source.room == "tools/cli") continue;
    for (const std::regex& pattern : forbidden) {
      std::smatch match;
      // What is not TOML is a string, by design: the one place where a failure to parse is an answer.
      if (source.path == "tools/scenario/overrides.cpp") continue;
      EXPECT_FALSE(std::regex_search(source.text, match, pattern)) << source.path << " has " << match.str();
    }
  }
}

TEST(Floors, FilesAreOpenedOnlyWhereTheNameSaysSo) {
  // Provenance hashes inputs, the summary and info read artefacts, and a result must not replace an input: the
  // pipeline's own business.
  const std::set<std::string> also{"tools/pipeline/provenance.cpp", "tools/pipeline/refuse_to_overwrite.cpp",
                                   "tools/pipeline/summary.cpp", "tools/pipeline/info.cpp"};
  for (const Source& source : sources()) {
    if (source.path.rfind("tests/", 0) == 0 || source.room == "tools/cli") continue;
    const std::string name = fs::path(source.path).filename();
    const bool named = name.rfind("read_", 0) == 0 || name.rfind("write_", 0) == 0 ||
                       name.find("_store.") != std::string::npos || also.count(source.path);
    for (const std::string& include : includes(source.text))
      if (include == "fstream" || include == "fcntl.h") EXPECT_TRUE(named) << source.path << " includes " << include;
  }
}

TEST(Floors, EveryFileCarriesItsLicence) {
  for (const Source& source : sources()) {
    EXPECT_EQ(source.raw.rfind(
                  "// SPDX-FileCopyrightText: The scarp developers\n// SPDX-License-Identifier: GPL-3.0-or-later\n", 0),
              0u)
        << source.path;
  }
}

}  // namespace
