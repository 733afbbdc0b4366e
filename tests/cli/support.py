# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line tests share: a way to run scarp and measure it, and small scenarios."""
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

SCARP = sys.argv[1]
SOURCE = Path(sys.argv[2])
DATA = Path(os.environ.get("SCARP_DATA", SOURCE / ".." / "shared" / "data"))


class Run:
    """One run of scarp: exit code, what it printed, seconds of wall clock, peak memory in bytes."""

    def __init__(self, *arguments, cwd=None):
        started = time.monotonic()
        process = subprocess.Popen([SCARP, *map(str, arguments)], cwd=cwd, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.out, self.err = process.communicate()
        self.code = process.returncode
        self.seconds = time.monotonic() - started

    def __str__(self):
        return f"exit {self.code}\n--- out\n{self.out}--- err\n{self.err}"


def validation_row(quantity, expected, got, tolerance, why, kept=True):
    """A row of the validation table, printed and, unless told otherwise, kept like those of
    tests/support/validation_table.hpp."""
    row = f"| {quantity} | {expected:.6g} | {got:.6g} | {tolerance:.2g} | {why} |"
    print(row, flush=True)
    path = os.environ.get("SCARP_VALIDATION_ROWS")
    if kept and path:
        with open(path, "a" if validation_row.begun else "w") as file:
            file.write(row + "\n")
        validation_row.begun = True


validation_row.begun = False


def limited(bytes_of_memory, *arguments):
    """A run whose address space is bounded, so that a large allocation fails it."""
    def bound():
        resource.setrlimit(resource.RLIMIT_AS, (bytes_of_memory, bytes_of_memory))
    started = time.monotonic()
    done = subprocess.run([SCARP, *map(str, arguments)], capture_output=True, text=True, preexec_fn=bound)
    done.seconds = time.monotonic() - started
    return done


# A block of soil in a box: small enough to run in a second.
BLOCK = """
title = "A block settles"
[domain]
dimension = 3
cell = 0.5
[domain.boundary]
z_min = "fixed"
[materials.soil]
model = "neo-hookean"
density = 1800
youngs_modulus = "2 MPa"
poissons_ratio = 0.3
[[bodies]]
name = "block"
volume = { box = { min = [0, 0, 0], max = [2, 2, 1] } }
material = "soil"
[solver]
end_time = 0.05
[output]
every = 0.01
[[render]]
name = "view"
width = 320
height = 240
"""

# A small synthetic hillside, with everything that a scenario can ask for.
HILL = """
title = "A small hillside"
[[scans]]
name = "before"
synthetic = { size = [20, 30], toe_length = 8, crest_length = 8, height = 8, density = 20, scanner = [10, -10, 15], reference_range = 30, site_offset = [500000, 4100000, 0] }
clean = [ { filter = "crop", min = [500001, 4100001, -5], max = [500019, 4100029, 30] },
          { filter = "statistical-outlier", neighbours = 8, deviations = 3.0 },
          { filter = "voxel-thin", size = 0.25 } ]
[domain]
cell = 1.0
[domain.boundary]
x_min = "roller"
x_max = "roller"
y_min = "roller"
y_max = "roller"
[materials.soil]
model = "mohr-coulomb"
density = 1900
youngs_modulus = "20 MPa"
poissons_ratio = 0.3
cohesion = "2 kPa"
friction_angle = 25
[[bodies]]
name = "slope"
volume = { scan = "before", close = "depth", depth = 3 }
material = "soil"
[solver]
end_time = 0.1
[output]
every = 0.05
[[render]]
name = "overview"
width = 320
height = 240
[[compare]]
observed = "before"
"""
