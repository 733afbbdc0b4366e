// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_cloud.hpp"

#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Files;
using test::message_of;

TEST(ReadCloud, ContentDecidesBeforeTheExtension) {
  Files files;
  EXPECT_EQ(read_cloud(files.put("a.txt", "ncols 1\nnrows 1\nxllcenter 1\nyllcenter 2\ncellsize 1\n3\n")).positions,
            (std::vector<Vec3>{{1, 2, 3}}));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 2 3\n";
  EXPECT_EQ(read_cloud(files.put("a.las", ply)).size(), 1u);
  const std::string pcd =
      "# any comment\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n"
      "DATA ascii\n1 2 3\n";
  EXPECT_EQ(read_cloud(files.put("a.xyz", pcd)).size(), 1u);
  EXPECT_EQ(read_cloud(files.put("a.CSV", "x,y,z\n1,2,3\n")).size(), 1u);
  EXPECT_EQ(read_cloud(files.put("a.asc", "1 2 3\n")).size(), 1u);
}

TEST(ReadCloud, SaysWhatItReadsAndWhatToDo) {
  Files files;
  const auto says = [&](const std::filesystem::path& path, const std::string& text) {
    const std::string message = message_of([&] { read_cloud(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const std::string formats = "LAS, LAZ, COPC, PLY, PCD, ESRI ASCII grid, GeoTIFF, XYZ/TXT/CSV/PTS";
  says(files.put("a.e57", "ASTM-E57 and more"), "a.e57: format is not read: found E57; allowed: " + formats);
  says(files.put("b.xyz", "ASTM-E57 and more"), "found E57");
  says(files.put("a.ptx", "15\n71\n"), "found '.ptx'; allowed: " + formats);
  says(files.put("a.tif", std::string("II*\0rest", 8)), "a.tif: cannot be read as a GeoTIFF");
  says(files.put("noextension", "1 2 3\n"), "format is not read: found ''");
  says(files.put("a.stl", "solid\n"), "is a surface mesh, not a cloud");
  says(files.put("a.las", "1 2 3\n"), "LAS");
  says(files.put("empty.xyz", ""), "empty.xyz: is empty");
  says(files.folder(), "is a folder, not a file");
  says(files.folder() / "none.las", "none.las: no such file");
}

TEST(ReadCloud, RealFiles) {
  SCARP_NEED_DATA();
  const auto folder = test::data_folder() / "als_truth_and_formats/formats";
  EXPECT_EQ(read_cloud(folder / "1.2-with-color.las").size(), 1065u);
  EXPECT_EQ(read_cloud(folder / "autzen-utm.pcd").size(), 1065u);
  EXPECT_EQ(read_cloud(test::data_folder() / "heifangtai_dc7/dc7_dem_1411slide.txt").size(), 60224u);
  // The compression bit sends a LAZ to the converter, which is not there.
  LazConverter missing;
  missing.script = folder / "no-such-converter.mjs";
  const std::string message = message_of([&] { read_cloud(folder / "simple.laz", missing); });
  EXPECT_NE(message.find("no-such-converter.mjs"), std::string::npos) << message;
}

}  // namespace
}  // namespace scarp
