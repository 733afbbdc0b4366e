# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every data set that has an expected.json and holds its summary and history against it."""
import csv
import json
import sys
import tempfile
import unittest
from pathlib import Path

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


def found(check, summary, rows):
    if "summary" in check:
        value = summary
        for key in check["summary"].split("."):
            value = value[key]
        return value
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
                for check in json.loads(file.read_text())["checks"]:
                    got = found(check, summary, rows)
                    print(f"| {file.parent.name} | {check['quantity']} | {check['expected']} | {got:.6g} | "
                          f"{check['tolerance']} | {check['why']} |")
                    self.assertLessEqual(abs(got - check["expected"]), check["tolerance"], check["quantity"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
