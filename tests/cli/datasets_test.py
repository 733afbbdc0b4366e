# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every data set that has an expected.json and holds its summary, history, probes and frames against it.

A check names what it looks at: "summary", a "column" (of history.csv, or of a "probe") with a "statistic", a "curve", or
something of the last frame; or a "value" of a "comparison". "data" names the real files that scans are read from; where
they are absent the data set is skipped, which is said. "runs" adds runs with other keys, for what only two resolutions can tell; "over" divides by
what another run gave.
"""
import csv
import functools
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

from support import DATA, SOURCE, Run, validation_row

STATISTICS = {
    "first": lambda value, rows: value[0],
    "last": lambda value, rows: value[-1],
    "min": lambda value, rows: min(value),
    "max": lambda value, rows: max(value),
    "min_over_first": lambda value, rows: min(value[1:]) / value[0],
    "time_of_min": lambda value, rows: rows[value.index(min(value[1:]))]["time"],
    "last_over_first": lambda value, rows: value[-1] / value[0],
    "last_over_max": lambda value, rows: value[-1] / max(value),
    "last_over_max_strain": lambda value, rows: value[-1] / max(row["strain"] for row in rows),
    "mean_of_last_fifth": lambda value, rows: sum(value[-len(value) // 5:]) / len(value[-len(value) // 5:]),
    "last_over_potential": lambda value, rows: value[-1] / abs(rows[-1]["potential"]),
}


def evaluate(formula, **variables):
    """A formula of expected.json, in numpy's functions."""
    names = {name: getattr(numpy, name) for name in ("sin", "cos", "exp", "sqrt", "pi")}
    return eval(formula, {"__builtins__": {}}, names | variables)


def read_table(file):
    with open(file) as table:
        return [{key: float(value) if value else math.nan for key, value in row.items()} for row in csv.DictReader(table)]


def number_in(value, path):
    for key in path.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


class Result:
    """What a run left in its folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.summary = json.loads((self.folder / "summary.json").read_text())

    @functools.cached_property
    def history(self):
        return read_table(self.folder / "history.csv")

    @functools.cached_property
    def series(self):
        return json.loads((self.folder / "frames.hdf.series").read_text())["files"]

    def compared(self, check):
        return number_in(json.loads((self.folder / f"compare/{check['comparison']}.json").read_text()), check["value"])

    def table(self, check):
        return read_table(self.folder / f"probes/{check['probe']}.csv") if "probe" in check else self.history

    def last_points(self):
        with h5py.File(self.folder / self.series[-1]["name"]) as frame:
            return frame["VTKHDF/Points"][:]

    def last_displacements(self):
        with h5py.File(self.folder / self.series[-1]["name"]) as frame:
            return frame["VTKHDF/PointData/displacement"][:]

    def front(self, share, time=None):
        """x that this share of the points stays behind: in the last frame, or at a time, linear between frames."""
        fronts = []
        for entry in self.series if time is not None else self.series[-1:]:
            with h5py.File(self.folder / entry["name"]) as frame:
                fronts.append(float(numpy.quantile(frame["VTKHDF/Points"][:, 0], share)))
        return float(numpy.interp(time, [entry["time"] for entry in self.series], fronts)) if len(fronts) > 1 else fronts[0]

    def spacing(self):
        """Between material points of the first body of a plane-strain model."""
        volume = self.summary["discretize"]["volumes"][0]
        return (volume["particle_volume_m3"] / volume["particles"]) ** 0.5

    def largest_rms_error(self, exact):
        """Over the frames, of the displacement against formulas of X, Y and t, one per axis."""
        worst = 0
        for entry in self.series:
            with h5py.File(self.folder / entry["name"]) as frame:
                displacement = frame["VTKHDF/PointData/displacement"][:]
                reference = frame["VTKHDF/Points"][:] - displacement
            square = sum((displacement[:, a] - evaluate(formula, X=reference[:, 0], Y=reference[:, 1], t=entry["time"])) ** 2
                         for a, formula in enumerate(exact))
            worst = max(worst, float(numpy.sqrt(numpy.mean(square))))
        return worst


    def most_beyond(self, bodies, x):
        """Points of some bodies beyond a plane x, in the frame with most of them."""
        most = 0
        for entry in self.series:
            with h5py.File(self.folder / entry["name"]) as frame:
                of = numpy.isin(frame["VTKHDF/PointData/body"][:], bodies)
                most = max(most, int(numpy.sum(frame["VTKHDF/Points"][:][of, 0] > x)))
        return most

    def heights_above(self, body, raster):
        """Per frame, of a body's points above an ESRI ASCII grid, bilinear; NaN where it has no value."""
        ground, west, south, cell = read_ascii_grid(DATA / raster)
        for entry in self.series:
            with h5py.File(self.folder / entry["name"]) as frame:
                of = frame["VTKHDF/PointData/body"][:] == body
                x, y, z = (frame["VTKHDF/Points"][:][of] + frame["origin"][:]).T
            column, row = (x - west) / cell, (y - south) / cell
            i = numpy.clip(column.astype(int), 0, ground.shape[1] - 2)
            j = numpy.clip(row.astype(int), 0, ground.shape[0] - 2)
            a, b = column - i, row - j
            yield z - ((1 - a) * (1 - b) * ground[j, i] + a * (1 - b) * ground[j, i + 1]
                       + (1 - a) * b * ground[j + 1, i] + a * b * ground[j + 1, i + 1])

    def least_above(self, body, raster):
        return min(float(numpy.nanmin(heights)) for heights in self.heights_above(body, raster))

    def share_below(self, body, raster, depth):
        """Of a body's points in the last frame."""
        *_, last = self.heights_above(body, raster)
        return float(numpy.mean(last < -depth))

    def fall_over_travel(self):
        """Of the centre of what has moved: height over way in plan."""
        before, after = (numpy.array(self.summary["run_out"][key]) for key in ("centre_before_m", "centre_after_m"))
        return float((before[2] - after[2]) / numpy.linalg.norm((after - before)[:2]))

    def impulse_over_momentum_lost(self, bodies, axis):
        """Of the contact forces on bodies that do not move, over what those that do have lost."""
        rows = self.history
        impulse = sum((row["time"] - before["time"]) * row[f"contact_force_{axis}_{body}"]
                      for before, row in zip(rows, rows[1:]) for body in bodies)
        return impulse / (rows[0][f"momentum_{axis}"] - rows[-1][f"momentum_{axis}"])


def read_ascii_grid(file):
    """Values from the south up, NaN where there are none; x and y of the first cell's middle; size of a cell."""
    words = file.read_text().split()
    head = {key.lower(): float(value) for key, value in zip(words[:12:2], words[1:12:2])}
    values = numpy.array(words[12:], float).reshape(int(head["nrows"]), int(head["ncols"]))[::-1]
    values[values == head["nodata_value"]] = numpy.nan
    half = head["cellsize"] / 2
    return values, head["xllcorner"] + half, head["yllcorner"] + half, head["cellsize"]


def surface_at(points, spacing, x):
    """Top of a plane-strain body at x: the highest centre within twice the spacing, and half a spacing above it."""
    near = points[abs(points[:, 0] - x) < 2 * spacing]
    return near[:, 1].max() + spacing / 2


def still_at(points, displacement, spacing, x, least):
    """Height below which a plane-strain body has not failed at x of its reference configuration: half a spacing above the
    highest point that has moved by less than `least`."""
    reference = points - displacement
    still = (abs(reference[:, 0] - x) <= 0.51 * spacing) & (numpy.linalg.norm(displacement, axis=1) < least)
    return reference[still, 1].max() + spacing / 2


def curve_error(curve, rows):
    """The largest departure of a column from a formula of t, over the formula's largest value."""
    exact = [float(evaluate(curve["exact"], t=row["time"])) for row in rows]
    return max(abs(row[curve["column"]] - value) for row, value in zip(rows, exact)) / max(map(abs, exact))


def found(check, runs):
    if "over" in check:
        return found_in(check, runs[check["run"]], runs) / found_in(check, runs[check["over"]], runs)
    return found_in(check, runs[check.get("run", "")], runs)


def found_in(check, result, runs):
    if "summary" in check:
        return number_in(result.summary, check["summary"])
    if "comparison" in check:
        return result.compared(check)
    if "order_of" in check:
        coarse, fine = (runs[name].largest_rms_error(check["order_of"]) for name in ("", check["fine"]))
        return math.log2(coarse / fine)
    if "error_of" in check:
        return result.largest_rms_error(check["error_of"]) / check["scale"]
    if "curve" in check:
        return curve_error(check["curve"], result.history)
    if "surface_at" in check:
        return surface_at(result.last_points(), result.spacing(), check["surface_at"])
    if "still_at" in check:
        return still_at(result.last_points(), result.last_displacements(), result.spacing(), check["still_at"], check["least"])
    if "beyond" in check:
        return result.most_beyond(**check["beyond"])
    if "least_above" in check:
        return result.least_above(**check["least_above"])
    if "below" in check:
        return result.share_below(**check["below"])
    if "fall_over_travel" in check:
        return result.fall_over_travel()
    if "impulse" in check:
        return result.impulse_over_momentum_lost(**check["impulse"])
    if "lowest" in check:
        return float(result.last_points()[:, 1].min())
    if "between" in check:
        first, last = check["between"]
        return (result.front(check["front_of"], last) - result.front(check["front_of"], first)) / (last - first)
    if "front_of" in check:
        return result.front(check["front_of"], check.get("time"))
    rows = result.table(check)
    return STATISTICS[check["statistic"]]([row[check["column"]] for row in rows], rows) / check.get("scale", 1)


class DataSets(unittest.TestCase):
    def run_all(self, data_set, expected, folder):
        runs = {}
        for name, changes in ({"": []} | expected.get("runs", {})).items():
            out = Path(folder) / (name or "run")
            data = [f'{key}="{DATA / file}"' for key, file in expected.get("data", {}).items()]
            overrides = [argument for change in ["render=[]", *data, *changes] for argument in ("--set", change)]
            done = Run("run", data_set / "scenario.toml", "-o", out, "--quiet", *overrides)
            self.assertEqual(done.code, 0, str(done))
            runs[name] = Result(out)
        return runs

    def test_expected_results(self):
        files = sorted((SOURCE / "datasets").glob("*/expected.json"))
        self.assertGreater(len(files), 1)
        for file in files:
            with self.subTest(file.parent.name), tempfile.TemporaryDirectory() as folder:
                expected = json.loads(file.read_text())
                absent = [name for name in expected.get("data", {}).values() if not (DATA / name).exists()]
                if absent:
                    self.skipTest(f"{file.parent.name} needs {', '.join(absent)} in {DATA}")
                runs = self.run_all(file.parent, expected, folder)
                for check in expected["checks"]:
                    got = found(check, runs)
                    # The validation table holds what everyone can run, without data from elsewhere.
                    validation_row(f"data set {file.parent.name}: {check['quantity']}", check["expected"], got,
                                   check["tolerance"], check["why"], kept="data" not in expected)
                    with self.subTest(check["quantity"]):
                        self.assertLessEqual(abs(got - check["expected"]), check["tolerance"], check["quantity"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
