# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rasters against rasters: real surveys of a gully and two codes' run-out, against what is known of them."""
import json
import tempfile
import unittest
from pathlib import Path

from support import DATA, Run

BRAGG = DATA / "multi_epoch" / "ftbragg"
COULOMB = DATA / "isee_coulomb"


def grid(path, values, cell=1, x=0):
    rows = "\n".join(" ".join(str(v) for v in row) for row in values)
    path.write_text(f"ncols {len(values[0])}\nnrows {len(values)}\nxllcorner {x}\nyllcorner 0\ncellsize {cell}\n{rows}\n")
    return path


class Rasters(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def compare(self, *arguments):
        run = Run("compare", *arguments, "-o", self.out, "--name", "r")
        self.assertEqual(run.code, 0, run)
        return json.loads((self.out / "r.json").read_text())

    def test_step_between_two_small_grids(self):
        low = grid(self.out / "low.asc", [[1, 1, 1], [1, -9999, 1]], cell=2)
        high = grid(self.out / "high.asc", [[1.5, 1, 1], [1, 4, 0]], cell=2)
        report = self.compare(low, high, "--method", "dod", "--uncertainty-observed", 0.1)
        self.assertAlmostEqual(report["volumes"]["added_m3"], 2)
        self.assertAlmostEqual(report["volumes"]["removed_m3"], -4)
        self.assertEqual(report["cells"]["compared"], 5)
        self.assertEqual(report["cells"]["only_observed"], 1)
        self.assertIsNone(report["volumes"]["net_sigma_correlated_m3"])
        self.assertEqual(report["significance"]["significant_cells"], 2)
        self.assertIn("-9999", (self.out / "r_difference.asc").read_text())
        self.assertTrue((self.out / "r_difference.png").exists())
        (self.out / "r_difference.png").unlink()
        self.compare(low, high, "--method", "dod", "--pictures=false")
        self.assertFalse((self.out / "r_difference.png").exists())

    def test_tolerances(self):
        low = grid(self.out / "low.asc", [[1, 1], [1, 1]])
        high = grid(self.out / "high.asc", [[1.5, 1], [1, 1]])
        for limit, code in (("0.6", 0), ("0.4", 4)):
            run = Run("compare", low, high, "--method", "dod", "--tolerance-net-volume", limit, "-o", self.out / "t")
            self.assertEqual(run.code, code, run)
        self.assertIn("outside tolerance", run.err)
        run = Run("compare", low, high, "--method", "footprint", "--tolerance-iou", 0.9, "--threshold", 1.2, "-o",
                  self.out / "t")
        self.assertEqual(run.code, 4, run)
        self.assertIn("overlap of the footprints (IoU) is 0", run.err)

    def test_what_cannot_be_compared(self):
        a = grid(self.out / "a.asc", [[1, 1], [1, 1]])
        far = grid(self.out / "far.asc", [[1, 1], [1, 1]], x=1000)
        for arguments, text in (((a, far), "do not overlap"),
                                ((a, a, "--ground", "mask"), "no mask"),
                                ((a, a, "--ground", "automatic"), "stable ground: found 4; allowed: at least 30"),
                                ((a, a, "--section", "1,1"), "corners of a path")):
            run = Run("compare", *arguments, "--method", "dod", "-o", self.out / "x")
            self.assertEqual(run.code, 2, run)
            self.assertIn(text, run.err)

    @unittest.skipUnless(BRAGG.is_dir(), f"no real data in {BRAGG}")
    def test_gully_of_fort_bragg(self):
        # Datum biases and spreads as the data's description gives them for the whole rasters: 0.09 and 0.13 m, 0.019
        # and 0.059 m; stable ground leaves out what moved.
        for years, bias, spread in ((("2004", "2012"), 0.09, 0.13), (("2012", "2016"), 0.019, 0.059)):
            first, second = (BRAGG / f"elevation_{year}.tif" for year in years)
            report = self.compare(first, second, "--method", "dod", "--ground", "automatic", "--correlation-range", 20,
                                  "--section", "597200,150600,597640,151000")
            stable, volumes = report["stable_ground"], report["volumes"]
            self.assertAlmostEqual(stable["bias_m"], bias, delta=0.005)
            self.assertAlmostEqual(stable["nmad_m"], spread, delta=0.005)
            self.assertLess(volumes["net_sigma_independent_m3"], volumes["net_sigma_correlated_m3"])
            self.assertLess(volumes["net_sigma_correlated_m3"], volumes["net_sigma_fully_correlated_m3"])
            self.assertEqual(report["gridding"]["observed"], "raster, exact")
            removed = self.compare(first, second, "--method", "dod", "--ground", "automatic", "--remove-bias")
            self.assertAlmostEqual(removed["volumes"]["net_m3"], volumes["net_m3"] - 202500 * stable["bias_m"], delta=1)
        rows = (self.out / "r_section.csv").read_text().splitlines()
        for picture in ("difference", "histogram", "section"):
            self.assertTrue((self.out / f"r_{picture}.png").read_bytes().startswith(b"\x89PNG"), picture)
        self.assertEqual(rows[0], "s,x,y,simulated,observed,difference")
        self.assertEqual(len(rows), 1192)

    @unittest.skipUnless(BRAGG.is_dir(), f"no real data in {BRAGG}")
    def test_a_prj_and_a_geotiff_of_one_system(self):
        # The same heights twice: ESRI's text beside the grid and the GeoTIFF's name one system.
        same = self.compare(BRAGG / "elevation_2004.asc", BRAGG / "elevation_2004.tif", "--method", "dod")
        self.assertLess(abs(same["difference"]["largest_m"]), 0.00051, "the grid has three decimals")
        self.assertEqual(same["names_of_sides"], {"simulated": "elevation_2004.asc", "observed": "elevation_2004.tif"})
        other = self.out / "other.asc"
        other.write_text((BRAGG / "elevation_2004.asc").read_text())
        text = (BRAGG / "elevation_2004.prj").read_text()
        other.with_suffix(".prj").write_text(text.replace('"Central_Meridian",-79.0', '"Central_Meridian",-78.0'))
        run = Run("compare", other, BRAGG / "elevation_2004.tif", "--method", "dod", "-o", self.out / "x")
        self.assertEqual(run.code, 2, run)
        self.assertIn("another coordinate reference system", run.err)

    @unittest.skipUnless(COULOMB.is_dir(), f"no real data in {COULOMB}")
    def test_run_out_of_two_codes(self):
        # Areas and fronts above 0.1 m: references/isee_coulomb_13codes_summary.csv.
        report = self.compare(COULOMB / "release1HS_03CoulombOnly_null_MPM_pft",
                              COULOMB / "release1HS_03CoulombOnly_null_com1DFA_pft.asc", "--method", "footprint",
                              "--before", COULOMB / "DEM_CoulombOnly.asc", "--path", "1000,-4250,6000,-4250")
        self.assertEqual(report["footprint"]["simulated_area_m2"], 381975)
        self.assertEqual(report["footprint"]["observed_area_m2"], 378125)
        self.assertEqual(report["runout_simulated"]["front_m"][0], 4175)
        self.assertEqual(report["runout_observed"]["front_m"][0], 4165)
        self.assertEqual(report["runout_observed"]["s_start_m"], 45)


if __name__ == "__main__":
    unittest.main(argv=["rasters_test"])
