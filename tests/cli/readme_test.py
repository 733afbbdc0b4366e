# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the README's console blocks: each line that starts with '$ scarp' or '$ python3' must succeed.

The two set-up commands (tools/dev/demo.sh, tools/dev/test.sh) are only checked to exist: this test is run by one of
them. Blocks run in the project's folder, as a reader's would, but write below a fresh one.
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import DATA, SCARP, SOURCE


class Readme(unittest.TestCase):
    def test_commands(self):
        text = (SOURCE / "README.md").read_text()
        commands = [line[2:] for block in re.findall(r"```console\n(.*?)```", text, re.S)
                    for line in block.splitlines() if line.startswith("$ ")]
        self.assertGreater(len(commands), 4)
        environment = dict(os.environ, PATH=f"{Path(SCARP).parent}:{os.environ['PATH']}")
        ran = 0
        with tempfile.TemporaryDirectory() as folder:
            for command in commands:
                if command.startswith("tools/dev/"):
                    self.assertTrue(os.access(SOURCE / command.split()[0], os.X_OK), command)
                    continue
                self.assertRegex(command, r"^scarp |^python3 ")
                if "rockslope" in command and not DATA.is_dir():
                    print(f"skipped, no real data: {command}")
                    continue
                # The demo's own run is too long for a test: coarser cells do the same job.
                quick = command + " --set domain.cell=4 --set solver.end_time=0.2" if command.startswith("scarp run") else command
                quick = quick.replace("python3 ", "/usr/bin/python3 ").replace(" out/", f" {folder}/out/")
                done = subprocess.run(quick, shell=True, cwd=SOURCE, env=environment,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{quick}\n{done.stdout}{done.stderr}")
                ran += 1
        self.assertGreater(ran, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
