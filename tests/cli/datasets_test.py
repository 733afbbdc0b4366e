# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every data set that has an expected.json and holds its summary, history and last frame against it."""
import csv
import json
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

from support import SOURCE, Run

STATISTICS = {
    "first": lambda value, rows, column: value[0],
    "last": lambda value, rows, column: value[-1],
    "min_over_first": lambda value, rows, column: min(value[1:]) / value[0],
    "time_of_min": lambda value, rows, column: rows[value.index(min(value[1:]))]["time"],
    "last_over_first": lambda value, rows, column: value[-1] / value[0],
    "last_over_max": lambda value, rows, column: value[-1] / max(value),
    "last_over_potential": lambda value, rows, column: value[-1] / abs(rows[-1]["potential"]),
}


def surface_at(points, spacing, x):
    """Top of a plane-strain body at x: the highest centre within twice the spacing, and half a spacing above it."""
    near = points[abs(points[:, 0] - x) < 2 * spacing]
    return near[:, 1].max() + spacing / 2


def found(check, summary, rows, points):
    if "summary" in check:
        value = summary
        for key in check["summary"].split("."):
            value = value[key]
        return value
    if "surface_at" in check:
        volume = summary["discretize"]["volumes"][0]
        return surface_at(points, (volume["particle_volume_m3"] / volume["particles"]) ** 0.5, check["surface_at"])
    if "lowest" in check:
        return float(points[:, 1].min())
    if "front_of" in check:
        return float(numpy.quantile(points[:, 0], check["front_of"]))
    values = [row[check["column"]] for row in rows]
    return STATISTICS[check["statistic"]](values, rows, check["column"])


class DataSets(unittest.TestCase):
    def test_expected_results(self):
        files = sorted((SOURCE / "datasets").glob("*/expected.json"))
        self.assertGreater(len(files), 1)
        print("| data set | quantity | expected | got | tolerance | why |\n|---|---|---|---|---|---|")
        for file in files:
            with self.subTest(file.parent.name), tempfile.TemporaryDirectory() as folder:
                done = Run("run", file.parent / "scenario.toml", "-o", folder, "--set", "render=[]", "--quiet")
                self.assertEqual(done.code, 0, str(done))
                summary = json.loads((Path(folder) / "summary.json").read_text())
                with open(Path(folder) / "history.csv") as history:
                    rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(history)]
                last = json.loads((Path(folder) / "frames.hdf.series").read_text())["files"][-1]["name"]
                with h5py.File(Path(folder) / last) as frame:
                    points = frame["VTKHDF/Points"][:]
                for check in json.loads(file.read_text())["checks"]:
                    got = found(check, summary, rows, points)
                    print(f"| {file.parent.name} | {check['quantity']} | {check['expected']} | {got:.6g} | "
                          f"{check['tolerance']} | {check['why']} |")
                    self.assertLessEqual(abs(got - check["expected"]), check["tolerance"], check["quantity"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
