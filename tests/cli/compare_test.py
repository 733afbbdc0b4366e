# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two files held against each other from the command line."""
import csv
import json
import math
import random
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import BLOCK, DATA, SCARP, Run

BMX = DATA / "multi_epoch" / "bmx"


def without_fonts(command):
    """The command in a namespace of its own, where the fonts' folder is empty."""
    return ["unshare", "--mount", "sh", "-c", 'mount -t tmpfs none /usr/share/fonts/truetype/dejavu && exec "$@"', "sh",
            *map(str, command)]


def can_hide_fonts():
    try:
        return subprocess.run(without_fonts(["true"]), capture_output=True).returncode == 0
    except OSError:
        return False


def las_points(file):
    """x, y, z of every point of a LAS file, in the file's units."""
    data = file.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    length, = struct.unpack_from("<H", data, 105)
    scale = struct.unpack_from("<3d", data, 131)
    shift = struct.unpack_from("<3d", data, 155)
    count, = struct.unpack_from("<Q", data, 247)
    return [tuple(v * s + o for v, s, o in zip(struct.unpack_from("<3i", data, offset + i * length), scale, shift))
            for i in range(count)]


def las_fields(file):
    """The names of the extra bytes of a LAS 1.4 file."""
    data = file.read_bytes()
    at, = struct.unpack_from("<H", data, 94)
    records, = struct.unpack_from("<I", data, 100)
    for _ in range(records):
        number, size = struct.unpack_from("<2H", data, at + 18)
        if number == 4:
            return [data[at + 54 + k + 4:at + 54 + k + 36].rstrip(b"\0").decode() for k in range(0, size, 192)]
        at += 54 + size
    return []


class Compare(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def write_cloud(self, name, points):
        file = self.folder / name
        file.write_text("x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points))
        return file

    def compare(self, *arguments, code=0):
        done = Run("compare", *arguments, "-o", self.folder, "--name", "n")
        self.assertEqual(done.code, code, str(done))
        if code not in (0, 4):
            return done
        with open(self.folder / "n.csv") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        return done, json.loads((self.folder / "n.json").read_text()), rows

    def bumpy(self, lift=0.0):
        return [(500000 + 0.25 * i, 4100000 + 0.25 * j, lift + 0.1 * math.sin(i) * math.cos(0.7 * j))
                for i in range(40) for j in range(40)]

    @unittest.skipUnless(BMX.is_dir(), "no real data")
    def test_reference_values_of_an_earthwork(self):
        # Published with filters.m3c2 of PDAL; its heights are feet among metres, so the files are handed over bare.
        before = self.write_cloud("2010.csv", las_points(BMX / "autzen-bmx-2010.las"))
        after = self.write_cloud("2023.csv", las_points(BMX / "autzen-bmx-2023.las"))
        _, report, rows = self.compare(before, after, "--method", "m3c2", "--convention", "pdal", "--core-points",
                                       BMX / "autzen-bmx-cores.txt", "--normal-radii", "5.24414",
                                       "--cylinder-radius", "10.4882815", "--max-distance", "2.763006")
        print("| core | distance | published | level of detection | published |\n|---|---|---|---|---|")
        for k, (row, distance, detection) in enumerate(zip(rows, (1.396, 0.670, 1.246), (0.275, 0.140, 0.226))):
            print(f"| {k} | {row['distance']:.4f} | {distance} | {row['lod']:.4f} | {detection} |")
            self.assertAlmostEqual(row["distance"], distance, delta=0.001)
            self.assertAlmostEqual(row["lod"], detection, delta=0.001)
        self.assertEqual((rows[0]["count_simulated"], rows[0]["count_observed"]), (118, 166))
        self.assertAlmostEqual(rows[0]["spread_simulated"], 0.732, delta=0.001)
        self.assertAlmostEqual(rows[0]["spread_observed"], 1.582, delta=0.001)
        self.assertEqual(report["m3c2"]["cylinder_radius_m"], 10.4882815)

    @unittest.skipUnless(BMX.is_dir(), "no real data")
    def test_heights_in_feet_are_not_taken_for_metres(self):
        files = (BMX / "autzen-bmx-2010.las", BMX / "autzen-bmx-2023.las", "--max-distance", "3")
        self.assertIn("us-ft", self.compare(*files, code=2).err)
        _, report, _ = self.compare(*files, "--height-unit", "us-ft")
        self.assertLess(report["distances"]["largest_m"], 3)

    def test_every_format_says_that_there_is_no_data(self):
        cores = self.write_cloud("cores.csv", [(500002, 4100002, 0), (500300, 4100300, 0)])
        _, report, rows = self.compare(self.write_cloud("a.csv", self.bumpy()), self.write_cloud("b.csv", self.bumpy(0.5)),
                                       "--method", "m3c2", "--core-points", cores, "--normal-radii", "0.5,1",
                                       "--cylinder-radius", "0.6", "--max-distance", "2", "--registration-error", "0.01")
        self.assertEqual(list(rows[0])[:5], ["x", "y", "z", "distance", "lod"])
        self.assertAlmostEqual(rows[0]["distance"], 0.5, delta=0.05)
        self.assertEqual(rows[0]["significant"], 1)
        for name in ("distance", "lod", "significant", "nx"):
            self.assertTrue(math.isnan(rows[1][name]), name)
        self.assertEqual((rows[1]["count_simulated"], rows[1]["count_observed"], rows[1]["flags"]), (0, 0, 15))
        self.assertEqual((report["distances"]["points"], report["distances"]["matched"]), (2, 1))
        self.assertEqual(report["detection"]["significant"], 1)
        self.assertEqual(report["m3c2"]["registration_error_m"], 0.01)
        for name in ("distance", "lod", "flags", "NormalX"):
            self.assertIn(name, las_fields(self.folder / "n.las"))
        las = (self.folder / "n.las").read_bytes()
        self.assertTrue(math.isnan(struct.unpack_from("<d", las[-12 * 8:], 3 * 8)[0]), "after three normals the distance")

    def test_methods_agree_on_parallel_surfaces(self):
        below = self.write_cloud("a.csv", [(0.5 * i, 0.5 * j, 0) for i in range(30) for j in range(30)])
        above = self.write_cloud("b.csv", [(0.5 * i, 0.5 * j, 0.25) for i in range(30) for j in range(30)])
        for method, expected in (("c2c", 0.25), ("m3c2", 0.25), ("c2m", -0.25)):
            _, report, _ = self.compare(below, above, "--method", method, "--max-distance", "2")
            self.assertAlmostEqual(report["distances"]["mean_m"], expected, delta=1e-12, msg=method)
            self.assertEqual(report["method"], method)
        _, _, rows = self.compare(below, above, "--method", "m3c2", "--core-spacing", "3", "--max-distance", "2")
        self.assertEqual(len(rows), 25)
        mesh = self.folder / "roof.obj"
        mesh.write_text("v 0 0 1\nv 20 0 1\nv 20 20 1\nv 0 20 1\nf 1 2 3\nf 1 3 4\n")
        _, report, _ = self.compare(below, mesh, "--method", "c2m", "--max-distance", "2")
        self.assertEqual(report["distances"]["mean_m"], -1, "below the side of the normals")
        self.assertEqual(report["mesh"]["border_edges"], 4)

    def test_levels_of_detection_by_propagated_errors(self):
        first, second = self.write_cloud("a.csv", self.bumpy()), self.write_cloud("b.csv", self.bumpy(0.5))
        arguments = [first, second, "--method", "m3c2", "--max-distance", "2", "--cylinder-radius", "1", "--normals",
                     "vertical", "--detection", "errors", "--scanner-simulated-positions", "499990,4100005,0",
                     "--scanner-simulated-sigma-range", "0.01", "--scanner-observed-positions", "499990,4100005,0",
                     "--scanner-observed-sigma-elevation", "0.1"]
        _, report, rows = self.compare(*arguments)
        middle = rows[20 * 40 + 20]  # 15 m from the scanner, level with it: range errors are level, elevation's upright
        count = middle["count_observed"]
        self.assertAlmostEqual(middle["sigma_observed"], 15 * math.radians(0.1) / math.sqrt(count), delta=2e-4)
        self.assertLess(middle["sigma_simulated"], 1e-3)
        self.assertAlmostEqual(middle["lod"], 1.96 * math.hypot(middle["sigma_observed"], middle["sigma_simulated"]),
                               delta=1e-12)
        self.assertIn("Winiwarter", report["m3c2"]["convention"])
        _, _, shared = self.compare(*arguments, "--alignment-sigma-translation", "0.03")
        self.assertAlmostEqual(shared[20 * 40 + 20]["sigma_alignment"], 0.03, delta=1e-12)
        self.assertIn("scanner_observed.positions", self.compare(*arguments[:-4], code=2).err)

    def test_displacement_vectors(self):
        def ground(x, y):
            return 0.3 * math.sin(0.9 * x) * math.cos(0.7 * y) + 0.2 * x + 0.1 * math.sin(2.1 * y - x)

        def survey(name, east, north, seed):
            random.seed(seed)
            places = [(random.uniform(-1, 21), random.uniform(-1, 21)) for _ in range(12000)]
            return self.write_cloud(name, [(500000 + x + east, 4100000 + y + north, ground(x, y) + random.gauss(0, 0.005))
                                           for x, y in places])
        before, after = survey("before.csv", 0, 0, 1), survey("after.csv", 0.4, -0.25, 2)
        _, report, rows = self.compare(before, after, "--method", "displacement", "--block", "5", "--max-distance", "1.5")
        known = [row for row in rows if row["flags"] == 0]
        whole = [row for row in known if 500000 < row["x"] < 500020 and 4100000 < row["y"] < 4100020]
        self.assertEqual(len(whole), 16, "beyond them there are strips of blocks only")
        for row in whole:
            self.assertAlmostEqual(row["dx"], 0.4, delta=0.01, msg="twice the noise of a point")
            self.assertAlmostEqual(row["dy"], -0.25, delta=0.01)
        self.assertEqual(report["names_of_sides"], {"simulated": "before", "observed": "after"})
        self.assertEqual(report["vectors"]["known"], len(known))
        self.assertTrue((self.folder / "n_vectors.png").exists())
        for name in ("dx", "sigma_z", "flags"):
            self.assertIn(name, las_fields(self.folder / "n.las"))
        targets = self.folder / "targets.csv"
        targets.write_text("x,y,z\n" + f"500010,4100010,{ground(10, 10)!r}\n500300,4100300,0\n")
        _, report, rows = self.compare(before, after, "--method", "displacement", "--block", "5", "--max-distance", "1.5",
                                       "--targets", targets)
        self.assertAlmostEqual(rows[0]["dx"], 0.4, delta=0.01)
        self.assertEqual((math.isnan(rows[1]["dx"]), rows[1]["flags"]), (True, 1))
        done = self.compare(before, after, "--method", "displacement", "--max-distance", "1.5", code=2)
        self.assertIn("displacement.block (--block)", done.err)

    def test_two_surveys_are_compared_by_a_scenario_without_bodies(self):
        self.write_cloud("a.csv", self.bumpy())
        self.write_cloud("b.csv", self.bumpy(0.5))
        scenario = self.folder / "surveys.toml"
        text = """title = "Two surveys"
[[scans]]
name = "2004"
file = "a.csv"
[[scans]]
name = "2012"
file = "b.csv"
[[compare]]
simulated = "2004"
observed = "2012"
max_distance = 2
[[compare]]
simulated = "2004"
observed = "2012"
method = "dod"
dod = { cell = 1 }
tolerance = { net_volume = 1 }
"""
        scenario.write_text(text)
        out = self.folder / "out"
        facts = Run("check", scenario)
        self.assertEqual(facts.code, 0, facts)
        self.assertIn("scan 2012: 1600 points read", facts.out)
        for given in (scenario, out / "scenario.toml"):  # what is resolved can be read again
            done = Run("run", given, "-o", out)
            self.assertEqual(done.code, 4, done)
            self.assertIn("2004_2012_dod: net volume, m3, is 50", done.err)
            self.assertIn("warning: No uncertainty of the heights is known", done.err)
        report = json.loads((out / "compare/2004_2012_dod.json").read_text())
        self.assertEqual(report["names_of_sides"], {"simulated": "2004", "observed": "2012"})
        self.assertAlmostEqual(report["difference"]["median_m"], 0.5, delta=1e-4, msg="LAS files hold tenths of mm")
        self.assertEqual(json.loads((out / "compare/2004_2012.json").read_text())["distances"]["matched"], 1600)
        self.assertFalse((out / "model.hdf").exists())
        for change, complaint in ((text.replace("max_distance = 2", ""), "needs the key \"max_distance\""),
                                  (text.replace('simulated = "2004"', 'simulated = "2008"', 1), "nor a frame"),
                                  (text.replace('simulated = "2004"', "", 1), "lacks the required key \"domain\""),
                                  (text + "[domain]\ncell = 1\n", "has no bodies")):
            scenario.write_text(change)
            done = Run("check", scenario)
            self.assertEqual(done.code, 2, done)
            self.assertIn(complaint, done.err)
        done = Run("discretize", out / "scenario.toml", "-o", out)
        self.assertEqual(done.code, 2, done)
        self.assertIn("no bodies to discretize", done.err)

    @unittest.skipUnless(can_hide_fonts(), "needs the right to hide a folder from a process")
    def test_numbers_come_without_fonts(self):
        files = self.write_cloud("a.csv", self.bumpy()), self.write_cloud("b.csv", self.bumpy(0.5))
        command = [SCARP, "compare", *files, "--max-distance", "2", "-o", self.folder, "--name", "n"]
        done = subprocess.run(without_fonts(command), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("warning: No pictures were drawn: the font", done.stderr)
        report = json.loads((self.folder / "n.json").read_text())
        self.assertIn("fonts-dejavu-core", report["warnings"][0])
        self.assertFalse((self.folder / "n_difference.png").exists())
        scenario = self.folder / "block.toml"
        scenario.write_text(BLOCK)
        done = subprocess.run(without_fonts([SCARP, "run", scenario, "-o", self.folder / "out"]), capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 2, done)
        self.assertIn("install the package fonts-dejavu-core", done.stderr)
        self.assertFalse((self.folder / "out").exists(), "said before the work, not after it")

    def test_tolerance_and_wrong_requests(self):
        a, b = self.write_cloud("a.csv", self.bumpy()), self.write_cloud("b.csv", self.bumpy(0.5))
        done, _, _ = self.compare(a, b, "--max-distance", "2", "--tolerance-mean", "0.1", code=4)
        self.assertIn("outside tolerance", done.err)
        for wrong in (["--method", "icp"], ["--max-distance", "-1"], ["--max-distance", "2", "--method", "m3c2", "--normal-radii", "1,0"],
                      ["--max-distance", "2", "--method", "m3c2", "--orientation", "towards"],
                      ["--max-distance", "2", "--method", "m3c2", "--normals", "core"],
                      ["--max-distance", "2", "--method", "m3c2", "--core-points", "nowhere.txt"]):
            done = self.compare(a, b, *wrong, code=2)
            self.assertTrue(done.err.startswith("scarp: error: "), done.err)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
