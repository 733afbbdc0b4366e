# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong requests: exit code 2, one helpful line, at once, without a large allocation, and nothing is written."""
import struct
import sys
import tempfile
import unittest
from pathlib import Path

from support import BLOCK, HILL, limited

SCANNED = """
title = "Scanned"
[[scans]]
name = "before"
file = "{file}"
[domain]
cell = 1.0
[materials.soil]
model = "neo-hookean"
density = 1800
youngs_modulus = 1e6
poissons_ratio = 0.3
[[bodies]]
name = "slope"
volume = {{ scan = "before", close = "depth", depth = 3 }}
material = "soil"
[solver]
end_time = 0.1
"""

GEOGRAPHIC = 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'


def las(points, wkt="", promised=None, scale=1e-7):
    """A LAS 1.4 file, point format 6, from x, y, z tuples."""
    wkt_record = b""
    if wkt:
        text = wkt.encode() + b"\0"
        wkt_record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 2112, len(text), b"") + text
    low = [min((p[a] for p in points), default=0) for a in range(3)]
    high = [max((p[a] for p in points), default=0) for a in range(3)]
    offset = [round(v) for v in low]
    count = promised if promised is not None else len(points)
    header = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 16, 0, 0, 0, b"", 1, 4, b"", b"test", 1, 2026,
                         375, 375 + len(wkt_record), 1 if wkt else 0, 6, 30, 0, 0, 0, 0, 0, 0)
    header += struct.pack("<12d", *(scale,) * 3, *offset, high[0], low[0], high[1], low[1], high[2], low[2])
    header += struct.pack("<QQIQ15Q", 0, 0, 0, count, count, *(0,) * 14)
    body = b"".join(struct.pack("<iii", *(round((p[a] - offset[a]) / scale) for a in range(3))) + b"\0" * 18 for p in points)
    return header + wkt_record + body


class Errors(unittest.TestCase):
    def check_refused(self, scenario, *words, files=()):
        """`scarp check` must refuse with all `words` in its one line."""
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            for name, content in files:
                (folder / name).write_bytes(content)
            (folder / "scenario.toml").write_text(scenario)
            before = sorted(folder.iterdir())
            done = limited(4 << 30, "check", folder / "scenario.toml")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("scarp: error: "), done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
            self.assertEqual(before, sorted(folder.iterdir()), "something was written")
            # Generous, because the machine may be busy: an idle one needs a fifth of it.
            self.assertLess(done.seconds, 5)
            print(f"{done.seconds:.2f} s  {done.stderr.strip()}".replace(str(folder) + "/", ""))

    def test_misspelt_key(self):
        self.check_refused(BLOCK.replace("poissons_ratio", "poisson_ratio"), "scenario.toml:12:1", "poisson_ratio", "poissons_ratio")

    def test_negative_density(self):
        self.check_refused(BLOCK.replace("1800", "-1800"), "scenario.toml:10:11", "density", "-1800", "kg/m3")

    def test_unit_of_another_dimension(self):
        self.check_refused(BLOCK.replace('"2 MPa"', '"2 kg"'), "scenario.toml:11", "2 kg", "Pa")

    def test_missing_file(self):
        self.check_refused(SCANNED.format(file="nowhere.las"), "scenario.toml:5:8", "nowhere.las")

    def test_cloud_in_degrees(self):
        points = [(7.5 + 1e-5 * (i % 40), 46.1 + 1e-5 * (i // 40), 1200 + 0.1 * (i % 7)) for i in range(1600)]
        self.check_refused(SCANNED.format(file="a.las"), "a.las", "degrees", files=[("a.las", las(points, GEOGRAPHIC))])

    def test_empty_cloud(self):
        self.check_refused(SCANNED.format(file="a.las"), "a.las", "no points", files=[("a.las", las([]))])

    def test_truncated_las(self):
        points = [(i, i % 17, i % 5) for i in range(1000)]
        whole = las(points, scale=1e-3)
        self.check_refused(SCANNED.format(file="a.las"), "a.las", "1000", files=[("a.las", whole[:-5000])])

    def test_las_that_promises_too_much(self):
        whole = las([(i, i % 17, i % 5) for i in range(1000)], promised=1 << 60, scale=1e-3)
        self.check_refused(SCANNED.format(file="a.las"), "a.las", files=[("a.las", whole)])

    def test_pcd_that_claims_four_billion_points(self):
        header = ("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\n"
                  "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4000000000\nDATA binary\n").encode()
        self.check_refused(SCANNED.format(file="a.pcd"), "a.pcd", "4000000000", files=[("a.pcd", header + b"\0" * 1200)])

    def test_not_a_cloud(self):
        self.check_refused(SCANNED.format(file="a.las"), "a.las", files=[("a.las", b"hello")])

    def test_unknown_scan(self):
        self.check_refused(HILL.replace('scan = "before"', 'scan = "befor"'), "befor", "before")

    def test_wrong_usage(self):
        for arguments in (["fly"], [], ["run"], ["run", "a.toml", "--threads", "0"], ["compare", "a.las", "b.las"]):
            done = limited(4 << 30, *arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertTrue(done.stderr.startswith("scarp: error: "), done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
