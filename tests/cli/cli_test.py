# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs on small scenarios, from end to end."""
import csv
import filecmp
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py

from support import BLOCK, HILL, SCARP, Run


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

    def test_a_stage_refuses_artefacts_of_another_scenario(self):
        out = self.folder / "out"
        self.run_well("run", self.folder / "block.toml", "-o", out, "--set", "render=[]")
        kept = (out / "history.csv").read_bytes()
        for change in ("materials.soil.youngs_modulus=5e6", "domain.boundary.z_min='roller'", "bodies.0.velocity=[0,0,1]"):
            done = Run("solve", self.folder / "block.toml", "-o", out, "--set", change)
            self.assertEqual(done.code, 2, f"{change} would be ignored: the model has the old value\n{done}")
            self.assertIn("scarp discretize", done.err)
            self.assertIn(change.split(".")[0], done.err)
        self.assertEqual(kept, (out / "history.csv").read_bytes(), "a refused run clears nothing")
        self.run_well("solve", self.folder / "block.toml", "-o", out, "--set", "solver.end_time=0.02")
        done = self.run_well("render", self.folder / "block.toml", "-o", out)
        self.assertIn("made with other keys in \"solver\"", done.err)

    def test_no_artefact_replaces_an_input(self):
        self.run_well("ingest", self.folder / "hill.toml", "-o", self.folder / "a")
        here = self.folder / "here"
        (here / "clouds").mkdir(parents=True)
        (here / "clouds/before.las").write_bytes((self.folder / "a/clouds/before.las").read_bytes())
        scenario = re.sub("synthetic = .*", 'file = "clouds/before.las"', HILL)
        for name in ("scenario.toml", "hill.toml"):
            (here / name).write_text(scenario)
            before = {path: path.read_bytes() for path in here.rglob("*") if path.is_file()}
            for verb in ("run", "ingest"):
                done = Run(verb, here / name, "-o", here)
                self.assertEqual(done.code, 2, str(done))
                self.assertIn("overwrite", done.err)
            self.assertEqual(before, {path: path.read_bytes() for path in here.rglob("*") if path.is_file()})
            (here / name).unlink()
        cloud = here / "clouds/before.las"
        done = Run("compare", cloud, cloud, "--max-distance", "1", "-o", here / "clouds", "--name", "before")
        self.assertEqual(done.code, 2, str(done))
        done = Run("compare", cloud, cloud, "--max-distance", "1", "-o", here / "clouds", "--name", "../../x")
        self.assertEqual(done.code, 2, str(done))
        # Going on in the folder of an earlier run, from its resolved scenario, is what that file is for.
        self.run_well("ingest", self.folder / "a/scenario.toml", "-o", self.folder / "a")

    def test_a_run_that_is_cut_off_leaves_nothing_of_an_earlier_one(self):
        out = self.folder / "out"
        self.run_well("run", self.folder / "block.toml", "-o", out, "--set", "render=[]")
        done = Run("run", self.folder / "block.toml", "-o", out, "--set", "domain.cell=1e-5")
        self.assertEqual(done.code, 2, str(done))
        for name in ("model.hdf", "frames.hdf.series", "history.csv", "frames/frame_000000.hdf"):
            self.assertFalse((out / name).exists(), name)

    def test_damaged_summary_and_folders_in_the_way(self):
        out = self.folder / "out"
        self.run_well("run", self.folder / "block.toml", "-o", out, "--set", "render=[]")
        series = (out / "frames.hdf.series").stat().st_mtime_ns
        for damage in ("[]", '"x"', "{"):
            (out / "summary.json").write_text(damage)
            done = Run("solve", self.folder / "block.toml", "-o", out)
            self.assertEqual(done.code, 2, str(done))
            self.assertIn("summary.json", done.err)
            self.assertNotIn("exception", done.err)
            self.assertEqual(series, (out / "frames.hdf.series").stat().st_mtime_ns, "noticed before the work, not after")
        (self.folder / "a_file").write_text("in the way")
        done = Run("run", self.folder / "block.toml", "-o", self.folder / "a_file")
        self.assertEqual(done.code, 2, str(done))
        self.assertIn("a_file", done.err)
        self.assertNotIn("filesystem error", done.err)

    def test_closed_and_full_standard_streams(self):
        for closed in ("<&-", ">&-", "2>&-", "<&- >&- 2>&-"):
            done = subprocess.run(f'"{SCARP}" run "{self.folder}/block.toml" -o "{self.folder}/out" {closed}', shell=True,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, closed + done.stderr)
            for file in (self.folder / "out").rglob("*"):
                self.assertTrue(file.is_dir() or b"solve ..." not in file.read_bytes(), f"{closed}: progress in {file}")
        with open("/dev/full", "w") as full:
            done = subprocess.run([SCARP, "check", self.folder / "block.toml"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard output", done.stderr)

    def test_volume_far_from_the_input_is_said(self):
        done = self.run_well("check", self.folder / "block.toml", "--set", "bodies.0.volume={sphere={centre=[1,1,1],radius=0.4}}")
        self.assertIn("use smaller cells", done.out)

    def test_particles_that_leave_the_domain_are_said(self):
        done = self.run_well("run", self.folder / "block.toml", "-o", self.folder / "out", "--set", "render=[]", "--set",
                             "domain.boundary.z_min='free'", "--set", "bodies.0.velocity=[100,0,0]")
        self.assertIn("outside the domain", done.err)

    def test_scenario_in_the_current_folder(self):
        self.run_well("synth", self.folder / "hill.toml", "-o", self.folder)
        (self.folder / "mine.toml").write_text(re.sub("synthetic = .*", 'file = "before.las"', HILL))
        done = Run("check", "mine.toml", cwd=self.folder)
        self.assertEqual(done.code, 0, str(done))

    def test_overrides_quiet_and_json_progress(self):
        done = self.run_well("run", self.folder / "block.toml", "-o", self.folder / "a", "--set", "solver.end_time=0.02",
                             "--set", "bodies.block.cell=1.0", "--quiet")
        self.assertEqual(done.err, "")
        self.assertIn("end_time = 0.02", (self.folder / "a/scenario.toml").read_text())
        self.assertEqual(json.loads((self.folder / "a/summary.json").read_text())["discretize"]["particles"], 4 * 8)
        done = self.run_well("solve", self.folder / "block.toml", "-o", self.folder / "a", "--progress", "json",
                             "--set", "bodies.block.cell=1.0")
        for line in done.err.splitlines():
            self.assertIn("stage", json.loads(line))
        wrong = Run("check", self.folder / "block.toml", "--set", "solver.end_tim=1")
        self.assertEqual(wrong.code, 2)
        self.assertIn("end_time", wrong.err)

    def test_probes(self):
        probes = """
[[probes]]
name = "corner"
where = { point = [0, 0, 1] }
[[probes]]
name = "base"
where = { plane = { point = [1, 1, 0.5], normal = [0, 0, 1] } }
[[probes]]
name = "up"
where = { line = { from = [1, 1, 0], to = [1, 1, 1], bins = 4 } }
every = 0.025
[[probes]]
name = "nowhere"
where = { box = { min = [8, 8, 8], max = [9, 9, 9] }, place = "reference" }
"""
        (self.folder / "probes.toml").write_text(BLOCK + probes)
        out = self.folder / "p"
        self.run_well("run", self.folder / "probes.toml", "-o", out, "--set", "render=[]")
        tables = {}
        for name in ("corner", "base", "up", "nowhere"):
            with open(out / f"probes/{name}.csv") as file:
                tables[name] = list(csv.DictReader(file))
        with open(out / "history.csv") as file:
            history = list(csv.DictReader(file))
        self.assertEqual([row["time_s"] for row in tables["corner"]], [row["time"] for row in history])
        with h5py.File(out / "frames/frame_000005.hdf") as frame:
            at = list(frame["VTKHDF/PointData/id"]).index(json.loads((out / "summary.json").read_text())["solver"]["probes"][0]["particle"])
            self.assertEqual(float(tables["corner"][-1]["displacement_z_m"]).hex()[:8],
                             float(frame["VTKHDF/PointData/displacement"][at][2]).hex()[:8])
            self.assertAlmostEqual(float(tables["corner"][-1]["position_z_m"]), frame["VTKHDF/Points"][at][2], places=12)
        self.assertEqual(sorted({row["time_s"] for row in tables["up"]}), ["0", "0.025", "0.05"])
        self.assertEqual(len(tables["up"]), 3 * 4)
        self.assertEqual({row["centre_x_m"] for row in tables["nowhere"]}, {""}, "an empty cell where nothing is")
        falls = [float(row["normal_force_N"]) for row in tables["base"]]
        self.assertLess(min(falls), -1000, "the base carries what stands on it")
        self.run_well("run", self.folder / "block.toml", "-o", out, "--set", "render=[]")
        self.assertFalse((out / "probes/base.csv").exists(), "of an earlier run")
        for wrong, words in (('name = "corner"', ["two entries of probes"]), ("bins = 4", ["bins"]),
                             ("normal = [0, 0, 1]", ["normal", "direction"])):
            new = {"bins = 4": "bins = 0", "normal = [0, 0, 1]": "normal = [0, 0, 0]"}.get(wrong, 'name = "base"')
            (self.folder / "wrong.toml").write_text(BLOCK + probes.replace(wrong, new))
            done = Run("check", self.folder / "wrong.toml")
            self.assertEqual(done.code, 2, str(done))
            for word in words + ["wrong.toml:"]:
                self.assertIn(word, done.err)

    def test_a_body_between_two_scans_of_which_one_counts_from_elsewhere(self):
        for name, places, height in (("ground", range(5), 7), ("top", range(-2, 3), 1)):
            (self.folder / f"{name}.xyz").write_text("".join(f"{x} {y} {height}\n" for x in places for y in places))
        scans = [f'[[scans]]\nname = "{name}"\nfile = "{name}.xyz"\n' for name in ("ground", "top")]
        text = BLOCK.replace("[domain]", scans[0] + scans[1] + "shift = [2, 2, 8]\n[domain]", 1).replace(
            "{ box = { min = [0, 0, 0], max = [2, 2, 1] } }",
            '{ scan = "top", close = "surface", base_scan = "ground" }')
        (self.folder / "between.toml").write_text(text)
        done = self.run_well("check", self.folder / "between.toml")
        self.assertIn("body block: 2048 particles in 256 cells, 32 m3 of 32 m3", done.out)

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

    def test_pictures_of_other_loads_are_warned_of(self):
        self.run_well("run", self.folder / "block.toml", "-o", self.folder / "l")
        same = self.run_well("render", self.folder / "block.toml", "-o", self.folder / "l")
        self.assertNotIn("warning", same.err)
        other = self.run_well("render", self.folder / "block.toml", "-o", self.folder / "l", "--set",
                              "loads=[{ where = { box = { min = [0, 0, 0.9], max = [2, 2, 1] } }, traction = [0, 0, -1000] }]")
        self.assertIn('other keys in "loads"', other.err)

    def test_tolerance(self):
        done = Run("run", self.folder / "hill.toml", "-o", self.folder / "t", "--set", "compare.0.tolerance.mean=1e-6", "--set", "render=[]")
        self.assertEqual(done.code, 4, str(done))
        self.assertIn("outside tolerance", done.err)

    def test_difference_of_rasters_as_a_stage(self):
        # The first frame is the scanned ground: heights differ by what the lattice cannot resolve, not by half a cell.
        def run(*overrides):
            arguments = ["compare.0.method='dod'", "compare.0.simulated='first'", "compare.0.dod.cell=1",
                         "compare.0.name='ground'", "compare.0.section=[[500005,4100008],[500015,4100022]]", "render=[]",
                         *overrides]
            return Run("run", self.folder / "hill.toml", "-o", self.folder / "d",
                       *[word for argument in arguments for word in ("--set", argument)])
        done = run()
        self.assertEqual(done.code, 0, str(done))
        report = json.loads((self.folder / "d/compare/ground.json").read_text())
        self.assertIn("free surface from the volumes", report["gridding"]["simulated"])
        self.assertLess(abs(report["difference"]["median_m"]), 0.1 * 0.5, "of a spacing of 0.5 m")
        self.assertGreaterEqual(report["significance"]["sigma_simulated_m"], 0.5 / 12 ** 0.5 - 1e-6)
        self.assertEqual(report["significance"]["sigma_simulated_from"], "spread of the free surface")
        for name in ("ground_difference.asc", "ground_difference.png", "ground_histogram.png", "ground_section.png",
                     "ground_section.csv"):
            self.assertTrue((self.folder / "d/compare" / name).exists(), name)
        done = run("compare.0.tolerance.net_volume=0")
        self.assertEqual(done.code, 4, str(done))
        self.assertIn("net volume", done.err)

    def test_info_does_not_wait_for_a_pipe(self):
        os.mkfifo(self.folder / "pipe.las")
        done = subprocess.run([SCARP, "info", self.folder / "pipe.las"], capture_output=True, text=True, timeout=20)
        self.assertEqual(done.returncode, 2)
        self.assertIn("ordinary file", done.stderr)

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
