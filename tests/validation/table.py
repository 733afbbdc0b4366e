# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The validation table, from the rows that the validation tests leave in a folder.

  table.py FOLDER --write   rewrites tests/validation/README.md, and the summary between the markers of README.md
  table.py FOLDER --check   fails where these do not have the rows that the tests print: problem, quantity, expected,
                            tolerance. What was got may differ.
"""
import re
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
TABLE = SOURCE / "tests/validation/README.md"
README = SOURCE / "README.md"
BEGIN, END = "<!-- validation table: tools/dev/validation.sh writes it -->", "<!-- end of the validation table -->"
HEAD = """# Validation

What `ctest -L validation` holds against closed forms, converged references and measurements. `tools/dev/validation.sh`
runs it and writes this page; a test keeps the rows up to date. A tolerance is the largest difference allowed; where a
band is expected, it stands in its place.
"""


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def read_rows(folder):
    """(problem, quantity, expected, got, tolerance, why), by problem; within one in the order of the tests."""
    rows = []
    for file in sorted(Path(folder).glob("*.txt")):
        for line in file.read_text().splitlines():
            name, expected, got, tolerance, why = cells(line)
            problem, quantity = re.match(r"(.*?)(?:: |, )(.*)", name).groups()
            rows.append((problem, quantity, expected, got, tolerance, why))
    return sorted(rows, key=lambda row: row[0].lower())


def share_used(row):
    """Of the tolerance, or of half the band."""
    _, _, expected, got, tolerance, _ = row
    if " to " in expected:
        low, high = map(float, expected.split(" to "))
        return abs(float(got) - (low + high) / 2) / ((high - low) / 2)
    return abs(float(got) - float(expected)) / float(tolerance) if float(tolerance) > 0 else 0.0


def full_table(rows):
    text = HEAD
    problem = None
    for row in rows:
        if row[0] != problem:
            problem = row[0]
            text += f"\n## {problem}\n\n| quantity | expected | got | tolerance | why |\n|---|---|---|---|---|\n"
        text += "| " + " | ".join(row[1:]) + " |\n"
    return text


def summary_table(rows):
    text = "| problem | checks | the one closest to its limit |\n|---|---|---|\n"
    for problem in dict.fromkeys(row[0] for row in rows):
        of_problem = [row for row in rows if row[0] == problem]
        worst = max(of_problem, key=share_used)
        allowed = f"expected {worst[2]}" + (f" within {worst[4]}" if worst[4] else "")
        text += f"| {problem} | {len(of_problem)} | {worst[1]}: {worst[3]}, {allowed} |\n"
    return text


def between_markers(text):
    return text.split(BEGIN, 1)[1].split(END, 1)[0]


def stated_rows(text):
    """(problem, quantity, expected, tolerance) of a written table."""
    rows, problem = [], None
    for line in text.splitlines():
        if line.startswith("## "):
            problem = line[3:]
        elif line.startswith("|") and problem and not line.startswith(("| quantity |", "|---")):
            quantity, expected, _, tolerance, _ = cells(line)
            rows.append((problem, quantity, expected, tolerance))
    return rows


def check(rows):
    printed = [(row[0], row[1], row[2], row[4]) for row in rows]
    stated = stated_rows(TABLE.read_text())
    wrong = [f"not in the table: {row}" for row in printed if row not in stated]
    wrong += [f"in the table, but no test prints it: {row}" for row in stated if row not in printed]
    counts = [line.split("|")[1:3] for line in summary_table(rows).splitlines()]
    if counts != [line.split("|")[1:3] for line in between_markers(README.read_text()).strip().splitlines()]:
        wrong.append("README.md does not count the same problems and checks")
    if not rows:
        wrong.append("the tests have left no rows")
    if wrong:
        sys.exit("the validation table is not up to date; run tools/dev/validation.sh\n" + "\n".join(wrong))
    print(f"{len(rows)} rows, all in the table")


def write(rows):
    TABLE.write_text(full_table(rows))
    text = README.read_text()
    before, after = text.split(BEGIN, 1)[0], text.split(END, 1)[1]
    README.write_text(before + BEGIN + "\n" + summary_table(rows) + END + after)
    print(f"{len(rows)} rows written to {TABLE.relative_to(SOURCE)}")


if __name__ == "__main__":
    {"--write": write, "--check": check}[sys.argv[2]](read_rows(sys.argv[1]))
