# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs on small scenarios, from end to end."""
import csv
import filecmp
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import BLOCK, HILL, Run


class Pipeline(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        (self.folder / "block.toml").write_text(BLOCK)
        (self.folder / "hill.toml").write_text(HILL)

    def tearDown(self):
        self.temporary.cleanup()

    def run_well(self, *arguments):
        done = Run(*arguments)
        self.assertEqual(done.code, 0, str(done))
        return done

    def test_the_main_job(self):
        out = self.folder / "out"
        done = self.run_well("run", self.folder / "hill.toml", "-o", out)
        self.assertIn("solve 100 %", done.err)
        self.assertNotIn("\033", done.err, "a pipe sees no control characters")
        for name in ("scenario.toml", "model.hdf", "clouds/before.las", "frames/frame_000000.hdf", "frames/frame_000002.hdf",
                     "frames.hdf.series", "history.csv", "images/overview_000000.png", "images/overview.mp4",
                     "compare/last_before.json", "compare/last_before.las", "compare/last_before.csv", "summary.json"):
            self.assertGreater((out / name).stat().st_size, 0, name)
        self.assertEqual([], list(out.rglob("*.tmp*")))
        summary = json.loads((out / "summary.json").read_text())
        volume = summary["discretize"]["volumes"][0]
        self.assertLess(abs(volume["difference_percent"]), 1)
        self.assertEqual(summary["solver"]["status"], "completed")
        for key in ("steps", "particle_steps", "wall_ns_per_particle_step", "cpu_ns_per_particle_step", "instruction_set"):
            self.assertIn(key, summary["solver"])
        self.assertEqual(summary["ingest"]["origin_m"], [500000, 4099900, 0])
        with open(out / "history.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0])[:5], ["time", "step", "dt", "kinetic", "strain"])
        self.assertAlmostEqual(float(rows[-1]["time"]), 0.1, places=12)
        self.assertTrue(len(rows) > 10)
        frames = subprocess.run(["/usr/bin/python3", Path(__file__).parent / "frames_test.py", out], capture_output=True, text=True)
        self.assertEqual(frames.returncode, 0, frames.stdout + frames.stderr)

        # The resolved scenario gives the same again; so do the stages one by one, on another number of threads.
        again = self.folder / "again"
        for verb in ("ingest", "discretize", "solve", "render", "compare"):
            self.run_well(verb, out / "scenario.toml", "-o", again, "--threads", "1" if verb != "solve" else "3")
        for name in ("model.hdf", "frames/frame_000002.hdf", "history.csv", "compare/last_before.csv", "images/overview_000002.png"):
            self.assertTrue(filecmp.cmp(out / name, again / name, shallow=False), name)

        info = self.run_well("info", out / "clouds/before.las", out / "model.hdf", out / "frames/frame_000001.hdf")
        for word in ("LAS 1.", "points:", "particles:", "displacement", "origin: 500000 4099900 0"):
            self.assertIn(word, info.out)
        self.run_well("compare", out / "frames/frame_000002.hdf", out / "clouds/before.las", "--max-distance", "5", "-o", self.folder / "direct")
        self.assertTrue((self.folder / "direct/frame_000002_before.json").exists())

    def test_stages_say_what_they_miss(self):
        for verb, needed in (("discretize", "ingest"), ("solve", "discretize"), ("render", "discretize"), ("compare", "ingest")):
            done = Run(verb, self.folder / "hill.toml", "-o", self.folder / "nothing")
            self.assertEqual(done.code, 2, str(done))
            self.assertIn(f"scarp {needed}", done.err)

    def test_overrides_quiet_and_json_progress(self):
        done = self.run_well("run", self.folder / "block.toml", "-o", self.folder / "a", "--set", "solver.end_time=0.02",
                             "--set", "bodies.block.cell=1.0", "--quiet")
        self.assertEqual(done.err, "")
        self.assertIn("end_time = 0.02", (self.folder / "a/scenario.toml").read_text())
        self.assertEqual(json.loads((self.folder / "a/summary.json").read_text())["discretize"]["particles"], 4 * 8)
        done = self.run_well("solve", self.folder / "block.toml", "-o", self.folder / "a", "--progress", "json")
        for line in done.err.splitlines():
            self.assertIn("stage", json.loads(line))
        wrong = Run("check", self.folder / "block.toml", "--set", "solver.end_tim=1")
        self.assertEqual(wrong.code, 2)
        self.assertIn("end_time", wrong.err)

    def test_check_estimates_and_writes_nothing(self):
        before = sorted(self.folder.iterdir())
        done = self.run_well("check", self.folder / "hill.toml")
        for word in ("particles", "time step", "steps", "memory", "scan before"):
            self.assertIn(word, done.out)
        self.assertEqual(before, sorted(self.folder.iterdir()))

    def test_failed_simulation(self):
        done = Run("run", self.folder / "block.toml", "-o", self.folder / "f", "--set", "solver.max_steps=3")
        self.assertEqual(done.code, 3, str(done))
        for word in ("failed at step 3", "t = "):
            self.assertIn(word, done.err)
        self.assertEqual(json.loads((self.folder / "f/summary.json").read_text())["solver"]["status"], "failed")
        self.assertTrue((self.folder / "f/frames/frame_000000.hdf").exists())

    def test_inverted_particle_is_named(self):
        done = Run("run", self.folder / "block.toml", "-o", self.folder / "f", "--set", "solver.gravity=[0,0,-3e6]")
        self.assertEqual(done.code, 3, str(done))
        self.assertIn("particle", done.err)

    def test_tolerance(self):
        done = Run("run", self.folder / "hill.toml", "-o", self.folder / "t", "--set", "compare.0.tolerance.mean=1e-6", "--set", "render=[]")
        self.assertEqual(done.code, 4, str(done))
        self.assertIn("outside tolerance", done.err)

    def test_synth_and_describe(self):
        done = self.run_well("synth", self.folder / "hill.toml", "-o", self.folder / "s")
        self.assertTrue((self.folder / "s/before.las").exists() and (self.folder / "s/before_truth.asc").exists(), str(done))
        self.assertIn("500", self.run_well("info", self.folder / "s/before_truth.asc").out)
        everything = self.run_well("describe").out
        for key in ("courant", "friction_angle", "points_per_cell"):
            self.assertIn(key, everything)
        self.assertIn("courant", self.run_well("describe", "solver").out)
        self.assertEqual(Run("describe", "solvr").code, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
