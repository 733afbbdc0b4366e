# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations that fail, each for another reason, through the whole program: exit code 3, one line that names step, time
and particle, and whole artefacts of everything before."""
import csv
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

from support import BLOCK, Run

# In which forms bodies are stepped: the same failures in each.
FORMS = {
    "nodal": [],
    "particle-state": ["solver.back_end='particle-state'"],
    "moving": ["solver.reference_update=2"],
    "updated": ["bodies.block.formulation='updated-lagrangian'"],
}


def struck(force, where="body = 'block'"):
    """The block, and a force (N) on part of it once two hundredths of a second have passed."""
    return BLOCK + f"""
[[loads]]
name = "strike"
where = {{ {where} }}
force = {force}
table = [[0, 0], [0.02, 0], [0.0201, 1]]
"""


PRESSED = """
[[loads]]
name = "press"
where = { box = { min = [0, 0, 1], max = [2, 2, 1] } }
velocity = [0, 0, -4]
"""


class Failures(unittest.TestCase):
    def provoke(self, scenario, what, *overrides, particle=True, frames_at_least=1):
        """Runs a scenario that must fail; returns the failure as summary.json has it."""
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "scenario.toml").write_text(scenario)
            changes = [argument for change in ("render=[]", *overrides) for argument in ("--set", change)]
            done = Run("run", folder / "scenario.toml", "-o", folder / "out", "--quiet", *changes)
            self.assertEqual(done.code, 3, str(done))
            self.assertEqual(done.err.count("\n"), 1, done.err)
            said = re.match(r"scarp: error: the simulation failed at step (\d+), t = (\S+) s"
                            r"(?:, particle (\d+) at \(([^)]*)\))?: (.*)\n", done.err)
            self.assertTrue(said, done.err)
            summary = json.loads((folder / "out/summary.json").read_text())
            self.assertEqual(summary["solver"]["status"], "failed")
            failure = summary["solver"]["failure"]
            self.assertIn(what, said[5])
            self.assertEqual(failure["what"], said[5])
            self.assertEqual(failure["step"], int(said[1]))
            self.assertAlmostEqual(failure["time_s"], float(said[2]), delta=1e-6 * float(said[2]))
            self.assertEqual(said[3] is not None, particle, done.err)
            if particle:
                self.assertEqual(failure["particle"], int(said[3]))
            self.check_artefacts(folder / "out", failure, frames_at_least)
            return failure

    def check_artefacts(self, out, failure, frames_at_least):
        self.assertEqual([], [str(path) for path in out.rglob("*.tmp*")])
        series = json.loads((out / "frames.hdf.series").read_text())["files"]
        self.assertGreaterEqual(len(series), frames_at_least)
        self.assertEqual(sorted(entry["name"] for entry in series),
                         sorted(f"frames/{path.name}" for path in (out / "frames").iterdir()))
        for entry in series:
            self.assertLessEqual(entry["time"], failure["time_s"])
            with h5py.File(out / entry["name"]) as frame:
                points = frame["VTKHDF/Points"][:]
                self.assertTrue(numpy.isfinite(points).all())
                for field in frame["VTKHDF/PointData"].values():
                    self.assertEqual(len(field), len(points))
                    self.assertTrue(numpy.isfinite(field[:]).all(), field.name)
        with open(out / "history.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertGreaterEqual(len(rows), len(series))
        for row in rows:
            self.assertTrue(all(numpy.isfinite(float(value)) for value in row.values()), row)

    def in_each_form(self, scenario, what, at_step, *overrides, **expected):
        for form, changes in FORMS.items():
            with self.subTest(form):
                failure = self.provoke(scenario, what, *overrides, *changes, frames_at_least=3, **expected)
                self.assertAlmostEqual(failure["step"], at_step, delta=1)

    def test_steps_run_out(self):
        self.in_each_form(BLOCK, "max_steps", 25, "solver.max_steps=25", "output.every=0.001", particle=False)

    def test_a_particle_is_turned_inside_out(self):
        self.in_each_form(struck([0, 0, -1e12], "box = { min = [0, 0, 0.75], max = [2, 2, 1] }"), "turned inside out", 21)

    def test_something_is_not_finite(self):
        self.in_each_form(struck([1e200, 0, 1e200]), "not finite", 21, "domain.boundary.z_min='free'")

    def test_a_particle_leaves_the_grid(self):
        failure = self.provoke(BLOCK, "left the grid", "bodies.block.formulation='updated-lagrangian'",
                            "bodies.block.velocity=[30,0,0]", "domain.boundary.z_min='free'", "domain.min=[-1,-1,-1]",
                            "domain.max=[3,3,3]", "solver.gravity=[0,0,0]", "output.every=0.01", frames_at_least=3)
        self.assertAlmostEqual(failure["position_m"][0], 3, delta=0.2)
        self.assertGreater(failure["step"], 1)

    def test_the_time_step_collapses(self):
        for form in ("nodal", "particle-state"):
            with self.subTest(form):
                failure = self.provoke(BLOCK + PRESSED, "the time step has collapsed", "solver.gravity=[0,0,0]",
                                       "solver.end_time=1", *FORMS[form], frames_at_least=20)
                self.assertIn("body 'block', material 'soil', wave speed", failure["what"])
                self.assertGreater(failure["step"], 10)

    def test_a_particle_outruns_the_time_step(self):
        # On a grid that stands still the step falls with the speed of the particles.
        failure = self.provoke(struck([3.6e15, 0, 0]), "the time step has collapsed", *FORMS["updated"],
                               "solver.gravity=[0,0,0]", "domain.boundary.z_min='free'", "domain.min=[0,0,0]",
                               "domain.max=[1e6,3,3]", frames_at_least=3)
        self.assertIn("body 'block', material 'soil'", failure["what"])
        self.assertIn("particle speed", failure["what"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
