// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/read_scenario.hpp"

#include <algorithm>
#include <functional>

#include "tests/unit/scenario/scenario_texts.hpp"

namespace scarp {
namespace {

using test::kDisks;
using test::kHillside;
using test::with;
class ReadScenario : public test::ScenarioFolder {};

TEST_F(ReadScenario, ReadsTheTextbookProblem) {
  const Scenario s = parse(kDisks);
  EXPECT_EQ(s.title, "Two elastic disks");
  EXPECT_EQ(s.domain.dimension, 2);
  EXPECT_EQ(s.domain.max, (Vec3{1, 1, 0}));
  EXPECT_EQ(std::get<NeoHookean>(s.materials.at("elastic")).youngs_modulus, 1000);
  ASSERT_EQ(s.bodies.size(), 2u);
  EXPECT_EQ(std::get<DiskVolume>(s.bodies[1].volume).disk.centre, (Vec3{0.8, 0.8, 0}));
  EXPECT_EQ(s.bodies[1].velocity, (Vec3{-0.1, -0.1, 0}));
  EXPECT_EQ(s.solver.gravity, (Vec3{0, 0, 0}));
  EXPECT_EQ(s.output.history_every, 0.005);
}

TEST_F(ReadScenario, ReadsEveryKindOfKey) {
  const Scenario s = parse(kHillside);
  EXPECT_EQ(s.title, "Hillside \"A\"");
  EXPECT_EQ(s.scans[0].file->path, (folder_.path() / "before.las").string());
  EXPECT_EQ(s.scans[0].height_unit, HeightUnit::foot);
  ASSERT_EQ(s.scans[0].clean.size(), 3u);
  EXPECT_EQ(std::get<Crop>(s.scans[0].clean[0]).max, (Vec3{200, 120, 90}));
  EXPECT_EQ(std::get<VoxelThin>(s.scans[0].clean[2]).size, 0.25);
  EXPECT_EQ(s.scans[1].synthetic->slide->travel, 30);
  EXPECT_EQ(s.scans[1].synthetic->scanner, (Vec3{50, -30, 25}));
  EXPECT_EQ(s.domain.boundary.x_min, Condition::roller);
  const auto& soil = std::get<MohrCoulomb>(s.materials.at("colluvium"));
  EXPECT_EQ(soil.density, 1900);
  EXPECT_EQ(soil.cohesion, 2000);
  EXPECT_EQ(soil.friction_angle, 28);
  const auto& slide = std::get<ScanVolume>(s.bodies[0].volume);
  EXPECT_EQ(slide.close, Closing::depth);
  EXPECT_EQ(slide.outline, (std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}}));
  EXPECT_EQ(std::get<ClassRule>(s.bodies[0].materials[1]).asprs_class, 6);
  EXPECT_EQ(std::get<PrismRule>(s.bodies[0].materials[3]).use, "old wall");
  EXPECT_EQ(std::get<MeshVolume>(s.bodies[1].volume).mesh.path, (folder_.path() / "wall.ply").string());
  EXPECT_NEAR(s.bodies[2].velocity[2], -1, 1e-15);
  EXPECT_EQ(std::get<SphereVolume>(s.bodies[3].volume).sphere.radius, 1);
  EXPECT_EQ(std::get<ScanVolume>(s.bodies[4].volume).base_elevation, 395.5);
  EXPECT_EQ(s.output.fields.size(), 3u);
  EXPECT_EQ(s.render[0].colour.range, (Vec2{0, 10}));
  EXPECT_EQ(s.render[0].camera.view, View::top);
  EXPECT_NEAR(s.render[0].camera.azimuth, 28.6478897565, 1e-9);
  EXPECT_EQ(s.compare[0].tolerance.percentile_95, 1);
  EXPECT_FALSE(s.compare[0].tolerance.median.has_value());
}

TEST_F(ReadScenario, AcceptsByteOrderMarkAndWindowsLineEnds) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : kDisks) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse(text).bodies.size(), 2u);
  EXPECT_EQ(error_of(with(text, "cell = 0.025", "cell = -1")).substr(0, 44),
            "a.toml:4:8: domain.cell is out of range: fou");
}

/// One mistake: what is replaced by what, and the beginning of what is said about it. "@@" marks the place that the
/// error must name; without it the whole beginning is given.
struct Mistake {
  const char* from;
  const char* to;
  const char* says;
};

/// Takes the first "@@" out of `text` and returns "a.toml:LINE:COL: " of where it was, or nothing.
std::string take_mark(std::string& text) {
  const std::size_t at = text.find("@@");
  if (at == std::string::npos) return "";
  text.erase(at, 2);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  const std::size_t start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  return "a.toml:" + std::to_string(line) + ":" + std::to_string(at - start + 1) + ": ";
}

void expect_errors(const std::function<std::string(const std::string&)>& error_of, const std::string& text,
                   const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes) {
    std::string wrong = with(text, mistake.from, mistake.to);
    const std::string says = take_mark(wrong) + mistake.says;
    const std::string said = error_of(wrong);
    EXPECT_EQ(said.substr(0, says.size()), says) << "whole: " << said;
  }
}

TEST_F(ReadScenario, NamesWrongKeysAndValues) {
  expect_errors(
      [&](const std::string& text) { return error_of(text); }, kDisks,
      {{"cell = 0.025", "@@cel = 0.025",
        "unknown key \"cel\" in domain (did you mean \"cell\"?); allowed: \"dimension\", \"cell\", \"min\", "
        "\"max\", \"boundary\""},
       {"[output]", "@@[outputs]",
        "unknown key \"outputs\" in the scenario (did you mean \"output\"?); allowed: \"title\", \"scans\""},
       {"density = 1000", "density = 1000\n@@cohesion = 3",
        "unknown key \"cohesion\" in materials.elastic (model = \"neo-hookean\"); allowed: \"model\", "
        "\"density\""},
       {"radius = 0.2 }", "radius = 0.2, @@colour = 1 }",
        "unknown key \"colour\" in bodies.left.volume.disk; allowed: \"centre\", \"radius\""},
       {"[domain]\ndimension = 2\ncell = 0.025\n", "@@[domain]\ndimension = 2\n",
        "domain lacks the required key \"cell\" (edge of a grid cell, above 0 m)"},
       {"[solver]\ngravity = [0, 0]\ncourant = 0.2\nend_time = 3.5", "@@[solver]\ngravity = [0, 0]\ncourant = 0.2\n",
        "solver lacks the required key \"end_time\" (simulated time, above 0 s)"},
       {"title = \"Two elastic disks\"", "@@", "the scenario lacks the required key \"title\" ("},
       {"[materials.elastic]\nmodel = \"neo-hookean\"", "@@[materials.elastic]\n",
        "materials.elastic lacks the required key \"model\" (one of \"linear-elastic\", \"neo-hookean\""},
       {"cell = 0.025", "cell = @@true",
        "domain.cell must be a number: found true; allowed: a number above 0 m, or text with a unit such as "
        "\"1 m\""},
       {"cell = 0.025", "cell = @@-0.5", "domain.cell is out of range: found -0.5; allowed: above 0 m"},
       {"cell = 0.025", "cell = @@0", "domain.cell is out of range: found 0; allowed: above 0 m"},
       {"cell = 0.025", "cell = @@nan", "domain.cell must be a finite number: found nan; allowed: a number"},
       {"cell = 0.025", "cell = @@+inf", "domain.cell must be a finite number: found +inf; allowed: a number"},
       {"cell = 0.025", "cell = @@1e400", "domain.cell must be a finite number: found 1e400; allowed: "},
       {"cell = 0.025", "cell = @@\"10 kg\"",
        "domain.cell must be a length, not a mass: found \"10 kg\"; allowed: a number above 0 m"},
       {"cell = 0.025", "cell = @@\"10 parsec\"", "domain.cell has an unknown unit \"parsec\": found \"10 pars"},
       {"cell = 0.025", "cell = @@\"fine\"", "domain.cell must be a number, or a number and a unit: found \"fi"},
       {"cell = 0.025", "cell = @@2024-01-01", "domain.cell must be a number: found 2024-01-01; allowed"},
       {"poissons_ratio = 0.3", "poissons_ratio = @@0.5",
        "materials.elastic.poissons_ratio is out of range: found 0.5; allowed: above -1 and below 0.5"},
       {"courant = 0.2", "courant = @@1.5",
        "solver.courant is out of range: found 1.5; allowed: above 0 and at most 1"},
       {"points_per_cell = 4", "points_per_cell = @@4.0",
        "bodies.left.points_per_cell must be a whole number: found 4.0; allowed: a whole number from 0 to"},
       {"points_per_cell = 4", "points_per_cell = @@99999999999999999999",
        "bodies.left.points_per_cell must be a whole number: found 99999999999999999999"},
       {"dimension = 2", "dimension = @@4", "domain.dimension is out of range: found 4; allowed: from 2 to 3"},
       {"dimension = 2", "dimension = @@\"2\"", "domain.dimension must be a whole number: found \"2\""},
       {"max = [1, 1]", "max = @@[1, 1, 1]",
        "domain.max has 3 entries: found [1, 1, 1]; allowed: a list of 2 numbers in m"},
       {"max = [1, 1]", "max = [1, @@\"2 s\"]", "domain.max.1 must be a length, not a time: found \"2 s\""},
       {"max = [1, 1]", "max = @@1", "domain.max must be a list of numbers: found 1; allowed: a list of 2"},
       {"model = \"neo-hookean\"", "model = @@\"neo-hokean\"",
        "materials.elastic.model is unknown (did you mean \"neo-hookean\"?): found \"neo-hokean\"; allowed: "
        "\"linear-elastic\", \"neo-hookean\""},
       {"model = \"neo-hookean\"", "model = @@3", "materials.elastic.model must be text: found 3; allowed: \"l"},
       {"formulation = \"total-lagrangian\"", "formulation = @@\"total_lagrangian\"",
        "bodies.left.formulation is unknown (did you mean \"total-lagrangian\"?): found \"total_lag"},
       {"title = \"Two elastic disks\"", "title = @@3", "title must be text: found 3; allowed: text in quotes"},
       {"volume = { disk =", "volume = { @@dsik =",
        "unknown key \"dsik\" in bodies.left.volume (did you mean \"disk\"?); allowed: one of \"scan\", "
        "\"box\", \"disk\""},
       {"volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }", "volume = @@{}",
        "bodies.left.volume does not say which kind it is; allowed: one of \"scan\", \"box\""},
       {"volume = { disk =", "volume = { box = 3, @@disk =",
        "bodies.left.volume has both \"box\" and \"disk\"; allowed: one of \"scan\", \"box\""},
       {"volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }", "volume = @@\"all\"",
        "bodies.left.volume must be a table: found \"all\""},
       {"every = 0.05", "every = 0.05\nfields = @@\"stress\"", "output.fields must be a list: found \"stress\""},
       {"every = 0.05", "every = 0.05\nfields = [@@\"stres\"]",
        "output.fields.0 is unknown (did you mean \"stress\"?): found \"stres\"; allowed: \"displacement\""},
       {"[domain]", "scans = @@{ name = \"x\" }\n[domain]", "scans must be a list, not a single table; allowed: [[s"},
       {"[domain]", "render = [ @@3 ]\n[domain]", "render.0 must be a table: found 3"}});
}

TEST_F(ReadScenario, PutsSyntaxErrorsOnOneLine) {
  expect_errors(
      [&](const std::string& text) { return error_of(text); }, kDisks,
      {{"cell = 0.025", "cell = @@", "not valid TOML: missing value after key-value separator '='; expected v"},
       {"cell = 0.025", "cell = 10 @@MPa", "not valid TOML: invalid line format; expected newline, but got 'M'"},
       {"min = [0, 0]", "cell = @@1", "\"cell\" is set twice; first on line 4"},
       {"[output]", "@@[domain]", "\"domain\" is set twice; first on line 2"},
       {"min = [0, 0]\nmax", "min = [0, 0\n@@max",
        "not valid TOML: missing array separator `,` after a value; array sta"},
       {"cell = 0.025", "cell = @@\"a", "not valid TOML: the next token is not a valid string"},
       {"cell = 0.025", "cell@@ 0.025", "not valid TOML: missing key-value separator `=`; should be `=`"},
       {"Two", "Tw@@\xff", "not valid TOML: invalid utf8 sequence found"}});
}

TEST_F(ReadScenario, RefusesWhatWouldChokeTheParser) {
  const auto deep = [](const std::string& open, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += open;
    return text;
  };
  const auto starts = [&](const std::string& text, const std::string& says) {
    EXPECT_EQ(error_of(text).substr(0, says.size()), says);
  };
  starts("a = " + deep("[", 65), "a.toml:1:69: brackets are nested deeper than 64");
  starts("a = " + deep("[", 900000), "a.toml:1:69: brackets are nested deeper than 64");
  starts("a = " + deep("{a=", 100), "a.toml:1:197: brackets are nested deeper than 64");
  starts("a" + deep(".a", 70) + " = 1", "a.toml:1:130: a dotted key has more than 64 parts");
  starts("[a" + deep(".a", 70) + "]", "a.toml:1:131: a dotted key has more than 64 parts");
  starts(std::string(1'000'001, '#'),
         "a.toml: a scenario of this size is refused: found 1000001 bytes; allowed: at most");
  starts("a = [" + deep("1,", 10000) + "]", "a.toml:1:4098: a line is longer than 4096 characters");
  starts(std::string("a = 1\n\0", 7), "a.toml:2:1: a control character (code 0) does not belong in a text file");
  starts("title = \"[[[" + deep("[", 100) + "\"\n", "a.toml:1:1: the scenario lacks the required key \"domain\"");
  starts("title = '''\n" + deep("[{", 100) + "'''\n#" + deep("[", 100),
         "a.toml:1:1: the scenario lacks the required key \"domain\"");
  starts("", "a.toml:1:1: the scenario lacks the required key \"title\"");
}

TEST_F(ReadScenario, ChecksTheTextbookProblemAcrossKeys) {
  expect_errors(
      [&](const std::string& text) { return error_of(text); }, kDisks,
      {{"max = [1, 1]", "max = @@[1, 0]", "domain.max must lie above min in y: found [1, 0]; allowed: above 0"},
       {"max = [1, 1]", "boundary.z_min = @@\"fixed\"", "plane strain (domain.dimension = 2) has no faces in z"},
       {"name = \"right\"", "name = @@\"left\"",
        "two entries of bodies are named \"left\": found \"left\"; allowed: names that differ"},
       {"name = \"left\"", "name = @@\"a/b\"", "bodies.0.name cannot name a file: found \"a/b\"; allowed: 1 to"},
       {"material = \"elastic\"", "material = @@\"elastik\"",
        "bodies.left.material: there is no material of this name (did you mean \"elastic\"?): found "
        "\"elastik\"; allowed: \"elastic\""},
       {"points_per_cell = 4", "points_per_cell = @@8",
        "bodies.left.points_per_cell must be a square in 2D: found 8; allowed: 1, 4, 9, 16"},
       {"volume = { disk = {", "volume = { sphere = @@{",
        "bodies.left.volume: \"sphere\" is for 3D only, and domain.dimension is 2"},
       {"volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }", "volume = { polygon = @@[[0, 0], [1, 0]] }",
        "bodies.left.volume.polygon is not a polygon: found [[0, 0], [1, 0]]; allowed: at least 3 corners"},
       {"volume = { disk = { centre = [0.2, 0.2], radius = 0.2 } }", "volume.box = { min = [0, 0], max = @@[1, -1] }",
        "bodies.left.volume.box.max must lie above min in y: found [1, -1]; allowed: above 0"},
       {"every = 0.05", "every = 0.05\nfields = [\"stress\", @@\"stress\"]",
        "output.fields names a field twice: found \"stress\""},
       {"[output]", "@@materials_x = 1\n[output]", "unknown key \"materials_x\" in solver"}});
  const std::string bodiless = kDisks.substr(0, kDisks.find("[[bodies]]")) + "[solver]\nend_time = 1\n";
  EXPECT_EQ(error_of(bodiless), "a.toml:1:1: the scenario lacks the required key \"bodies\" (what is simulated)");
  EXPECT_EQ(error_of("bodies = []\n" + bodiless),
            "a.toml:1:10: a scenario needs at least one body, or comparisons of two scans only: found []; allowed: "
            "[[bodies]]");
}

TEST_F(ReadScenario, ChecksTheHillsideAcrossKeys) {
  expect_errors(
      [&](const std::string& text) { return error_of(text); }, kHillside,
      {{"file = \"before.las\"", "file = @@\"gone.las\"", "scans.before.file: there is no file /"},
       {"file = \"before.las\"", "file = @@\".\"", "scans.before.file is a folder: /"},
       {"file = \"before.las\"", "file = @@\"a\\u0000b\"", "scans.before.file is not the name of a file: found"},
       {"[[scans]]\nname = \"before\"\nfile = \"before.las\"\n", "@@[[scans]]\nname = \"before\"\n",
        "scans.before needs a \"file\", or \"synthetic\" to make one; allowed: one"},
       {"file = \"before.las\"", "file = \"before.las\"\nsynthetic = @@{}",
        "scans.before has both \"file\" and \"synthetic\"; allowed: one of them"},
       {"max = [\"0.2 km\", 120, 90]", "max = @@[1, 0, 1]",
        "scans.before.clean.0.max must lie above min in y: found [1, 0, 1]; allowed: above 0"},
       {"max = [\"0.2 km\", 120, 90]", "max = @@[1, 0]", "scans.before.clean.0.max has 2 entries: found [1, 0]"},
       {"filter = \"voxel-thin\"", "filter = @@\"voxel\"",
        "scans.before.clean.2.filter is unknown (did you mean \"voxel-thin\"?): found \"voxel\""},
       {"observed = \"after\"", "observed = @@\"later\"", "compare.0.observed: there is no scan of this name"},
       {"friction_angle = 28", "friction_angle = 28\ndilatancy_angle = @@30",
        "materials.colluvium.dilatancy_angle must not exceed the friction angle: found 30; allowed: at mo"},
       {"scan = \"before\", close", "scan = @@\"befor\", close",
        "bodies.slide.volume.scan: there is no scan of this name (did you mean \"before\"?): found \"befor\""},
       {"volume = { scan = \"before\", close = \"depth\", depth = 6.0, ",
        "volume = @@{ scan = \"before\", close = \"depth\", ",
        "bodies.slide.volume: close = \"depth\" needs the key \"depth\""},
       {"volume = { scan = \"before\", close = \"depth\", depth = 6.0, ", "volume = @@{ scan = \"before\", ",
        "bodies.slide.volume: close = \"plane\" needs the key \"base_elevation\""},
       {"depth = 6.0, ", "depth = 6.0, base_elevation = @@3, ",
        "bodies.slide.volume.base_elevation is for close = \"plane\": found 3"},
       {"base_elevation = 395.5", "base_elevation = 395.5, depth = @@3",
        "bodies.base.volume.depth is for close = \"depth\": found 3"},
       {"volume = { scan = \"before\", base_elevation = 395.5", "volume = @@{ scan = \"before\", close = \"surface\"",
        "bodies.base.volume: close = \"surface\" needs the key \"base_scan\""},
       {"base_elevation = 395.5", "close = \"surface\", base_scan = @@\"aftr\"",
        "bodies.base.volume.base_scan: there is no scan of this name (did you mean \"after\"?): found \"aftr\""},
       {"base_elevation = 395.5", "base_elevation = 395.5, base_scan = @@\"after\"",
        "bodies.base.volume.base_scan is for close = \"surface\": found \"after\""},
       {"[scans.synthetic]", "shift = @@[1, 0, 0]\n[scans.synthetic]",
        "scans.after.shift is for a \"file\": found [1, 0, 0]; allowed: synthetic.site_offset"},
       {"outline = [[0, 0], [10, 0], [10, 10]]", "outline = @@[[0, 0], [10, 0]]",
        "bodies.slide.volume.outline is not a polygon: found [[0, 0], [1"},
       {"use = \"old wall\" },\n  { class", "use = @@\"old\" },\n  { class",
        "bodies.slide.materials.0.use: there is no material of this name (did you mean \"old wall\"?)"},
       {"below = \"bedrock.asc\"", "below = @@\"rock.asc\"", "bodies.slide.materials.0.below: there is no file /"},
       {"points_per_cell = 27", "points_per_cell = @@9",
        "bodies.wall.points_per_cell must be a cube in 3D: found 9; allowed: 1, 8, 27"},
       {"volume.sphere = ", "volume.disk = @@",
        "bodies.ball.volume: \"disk\" is for 2D only, and domain.dimension is 3"},
       {"material = \"old wall\"\nvelocity",
        "material = \"old wall\"\nmaterials = [{ class = @@2, use = \"old wall\" }]\nvelocity",
        "bodies.block.materials.0: classes come from scan points, and this body has no scan: found 2"},
       {"field = \"velocity.z\"", "field = @@\"stress\"",
        "render.overview.colour.field: the field \"stress\" is not in output.fields: found \"stress\""},
       {"field = \"velocity.z\"", "field = @@\"speed\"", "render.overview.colour.field is unknown: found \"sp"},
       {"field = \"velocity.z\"", "field = @@\"velocity.q\"",
        "render.overview.colour.field: \"velocity\" has no component \"q\": found \"velocity.q\"; allowed: \"x\""},
       {"field = \"velocity.z\"", "field = @@\"deformation_gradient\"",
        "render.overview.colour.field needs a component of the tensor"},
       {"range = [0, 10]", "range = @@[10, 0]", "render.overview.colour.range must rise: found [10, 0]"},
       {"camera =", "width = @@1281\ncamera =", "render.overview.width must be even"},
       {"[output]\n", "[output]\nevery = @@1e-9\n", "output.every asks for more than 100000 outputs: found 1e-9"},
       {"[output]\n", "[output]\nhistory_every = @@1e-12\n", "output.history_every asks for more than 10000000"},
       {"observed = \"after\"", "observed = \"after\"\nm3c2 = { orientation = @@\"towards\" }",
        "compare.0.m3c2.orientation needs the key \"viewpoint\""},
       {"[[compare]]", "[[compare]]\nobserved = \"after\"\n@@[[compare]]",
        "two entries of compare are named \"last_after\""}});
}

TEST_F(ReadScenario, AsksTheLawsWhetherTheirParametersGoTogether) {
  std::string text = with(kHillside, "cohesion = \"2 kPa\"\nfriction_angle = 28", "cohesion = 0\nfriction_angle = 0");
  try {
    parse(with(text, "[materials.colluvium]", "  [materials.colluvium]"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 12), "a.toml:23:3:") << error.what();
  }
}

TEST_F(ReadScenario, ReadsFilesAndSaysWhatIsNotOne) {
  const auto path = folder_.path() / "s.toml";
  std::ofstream(path) << kHillside;
  EXPECT_EQ(read_scenario(path).scans[0].file->path, (folder_.path() / "before.las").string());
  const auto says = [&](const std::filesystem::path& file) -> std::string {
    try {
      read_scenario(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string gone = (folder_.path() / "gone.toml").string();
  EXPECT_EQ(says(gone), gone + ": there is no such scenario file");
  EXPECT_EQ(says(folder_.path()),
            folder_.path().string() + ": this is not a scenario file: found a folder; allowed: a TOML file");
  std::ofstream(path) << std::string(2'000'000, '#');
  EXPECT_EQ(says(path), path.string() + ": a scenario of this size is refused; allowed: at most 1000000 bytes");
}

}  // namespace
}  // namespace scarp
