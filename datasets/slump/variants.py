# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The slump in other formulations, with other elements and other strength: the table of README.md.

    python3 datasets/slump/variants.py [-o FOLDER] [--scarp PROGRAM] [--threads N] [NAME ...]

runs the variants named, or all, each as `scarp run datasets/slump/scenario.toml --set ...` into FOLDER/NAME, and prints
a row for each. Where FOLDER/NAME holds a completed run already, it is only measured.
"""
import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

import h5py
import numpy

HERE = Path(__file__).resolve().parent
TOE, CREST, FLOOR = 48.75, (28.75, 35), 15  # of the slope before, m
RINGING = 0.66  # period of the standing wave of sudden gravity, s

NINE = ["bodies.slope.points_per_cell=9"]
MOVING = ["solver.reference_update=2.6"]
GIMP = ["bodies.slope.formulation='updated-lagrangian'", "solver.shape='gimp'"]
BSPLINE = ["bodies.slope.formulation='updated-lagrangian'", "solver.shape='quadratic-bspline'"]
F_BAR = ["solver.anti_locking='f-bar'"]
SOFTENING = ["materials.soil.residual_cohesion='5 kPa'", "materials.soil.residual_friction_angle=15",
             "materials.soil.softening_strain=0.5", "materials.soil.softening_length=1"]
CUT_OFF = ["materials.soil.tension_strength=0"]

VARIANTS = {
    "tl-2": ("total-Lagrangian, 2 x 2", []),
    "tl-3": ("total-Lagrangian, 3 x 3", NINE),
    "tl-moving-2": ("total-Lagrangian, moving, 2 x 2", MOVING),
    "tl-moving-3": ("total-Lagrangian, moving, 3 x 3", MOVING + NINE),
    "gimp-2": ("updated-Lagrangian, GIMP, 2 x 2", GIMP),
    "gimp-3": ("updated-Lagrangian, GIMP, 3 x 3", GIMP + NINE),
    "bspline-2": ("updated-Lagrangian, B-spline, 2 x 2", BSPLINE),
    "bspline-3": ("updated-Lagrangian, B-spline, 3 x 3", BSPLINE + NINE),
    "tl-moving-fbar": ("total-Lagrangian, moving, 2 x 2, F-bar", MOVING + F_BAR),
    "gimp-fbar": ("updated-Lagrangian, GIMP, 2 x 2, F-bar", GIMP + F_BAR),
    "bspline-fbar": ("updated-Lagrangian, B-spline, 2 x 2, F-bar", BSPLINE + F_BAR),
    "tl-moving-softening": ("total-Lagrangian, moving, 2 x 2, softening", MOVING + SOFTENING),
    "gimp-softening": ("updated-Lagrangian, GIMP, 2 x 2, softening", GIMP + SOFTENING),
    "tl-moving-cut-off": ("total-Lagrangian, moving, 2 x 2, no tension", MOVING + CUT_OFF),
    "gimp-cut-off": ("updated-Lagrangian, GIMP, 2 x 2, no tension", GIMP + CUT_OFF),
}


def run(scarp, folder, changes, threads):
    """The failure, or None."""
    summary = folder / "summary.json"
    if not summary.exists():
        arguments = [argument for change in changes for argument in ("--set", change)]
        code = subprocess.run([scarp, "run", HERE / "scenario.toml", "-o", folder, "--quiet", "--threads", str(threads),
                               *arguments], stderr=subprocess.PIPE, text=True)
        if code.returncode not in (0, 3):
            sys.exit(code.stderr)
    return json.loads(summary.read_text())["solver"]["failure"]


def smoothed_peak(time, kinetic):
    """When the mean over a period of the ringing is largest."""
    half = round(RINGING / 2 / (time[1] - time[0]))
    return time[half + numpy.convolve(kinetic, numpy.ones(2 * half + 1), "valid").argmax()]


def measure(folder):
    """Run-out of the foremost point from above the toe's level, drop of the point at the crest, largest displacement (m);
    the kinetic energy's peak, and that of its mean over a period (s); energy drift / potential energy released."""
    last = json.loads((folder / "frames.hdf.series").read_text())["files"][-1]["name"]
    with h5py.File(folder / last) as frame:
        x, u = frame["VTKHDF/Points"][:], frame["VTKHDF/PointData/displacement"][:]
    X = x - u
    with open(folder / "history.csv") as file:
        rows = list(csv.DictReader(file))
    time, kinetic, total, potential = (numpy.array([float(row[key]) for row in rows])
                                       for key in ("time", "kinetic", "total", "potential"))
    crest = numpy.hypot(X[:, 0] - CREST[0], X[:, 1] - CREST[1]).argmin()
    return (x[X[:, 1] > FLOOR, 0].max() - TOE, -u[crest, 1], numpy.linalg.norm(u, axis=1).max(),
            time[kinetic.argmax()], smoothed_peak(time, kinetic),
            100 * numpy.abs(total - total[0]).max() / abs(potential[-1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/slump_variants"))
    parser.add_argument("--scarp", default="build/bin/scarp")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(VARIANTS))
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in VARIANTS]
    if unknown:
        parser.error(f"no variant {unknown[0]!r}: one of {', '.join(VARIANTS)}")
    print("| variant | run-out, m | crest drop, m | largest displacement, m | peak, s | peak of the mean, s | drift, % |")
    print("|---|---|---|---|---|---|---|")
    for name in options.names or VARIANTS:
        title, changes = VARIANTS[name]
        failure = run(options.scarp, options.output / name, changes, options.threads)
        if failure:
            print(f"| {title} (`{name}`) | fails at {failure['time_s']:.2f} s: {failure['what'].split(':')[0]} | | | | | |", flush=True)
            continue
        run_out, drop, largest, peak, mean_peak, drift = measure(options.output / name)
        print(f"| {title} (`{name}`) | {run_out:.2f} | {drop:.2f} | {largest:.2f} | {peak:.2f} | {mean_peak:.2f} | {drift:.2f} |",
              flush=True)


if __name__ == "__main__":
    sys.exit(main())
