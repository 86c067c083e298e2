#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `./run test --nightly` ends with: its steps, how long each took and how it ended, as reports/measured/nightly.md.

    nightly.py FOLDER PROGRAM STEP...    FOLDER has STEP.tsv and STEP.log of the last run of each; PROGRAM says its commit

Written only where every step was run on the commit of the program, with nothing uncommitted. Exit 1 if a step failed, or
is missing."""

import re
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/figures"))

import figures  # noqa: E402
from markdown import table  # noqa: E402
from registry import BLOCKS, MEASUREMENTS, measured_files  # noqa: E402

# What a log says of its step, in a line.
SAID = {
    "tests": r"\d+% tests passed.*",
    "sanitizers": r"\d+ short tests passed",
    "threads": r"\d+ short tests passed",
    "traces": r"traces: (.*)",
    "model": r"All tests passed.*",
    "bars": r"over \d+ of \d+ bars",
}


def step(folder, name):
    """A row of the table, seconds, and the commit that the step was run on; nothing where it was not run."""
    file, log = folder / f"{name}.tsv", folder / f"{name}.log"
    if not file.exists():
        return (name, "", "not run", ""), 0, None
    _, seconds, status, commit = file.read_text().rstrip("\n").split("\t")
    said = re.findall(f"^{SAID[name]}$", log.read_text(errors="replace"), re.M) if name in SAID and log.exists() else []
    ended = "passed" if status == "0" else f"failed ({status})"
    return (name, f"{int(seconds) / 60:.1f}", ended, said[-1] if said else ""), int(seconds), commit


def main():
    folder, program, names = Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    steps = [step(folder, name) for name in names]
    rows, commit = [row for row, _, _ in steps], figures.commit(program)
    minutes = sum(seconds for _, seconds, _ in steps) / 60
    text = table(["step", "minutes", "ended", "said"], rows) + f"\n\n{minutes:.0f} minutes in all."
    failed = [row[0] for row in rows if row[2] != "passed"]
    others = [row[0] for row, _, of in steps if of != commit or "dirty" in commit]
    print(text)
    if others:
        print(f"nightly: not written: the program is of {commit}; on that, with nothing uncommitted, were not run: {' '.join(others)}")
        failed += [name for name in others if name not in failed]
    else:
        figure = next(one for one in MEASUREMENTS if one.name == "nightly")
        facts = {"command": "./run test --nightly", "commit": commit, "date": time.strftime("%Y-%m-%d"),
                 "machine": figures.machine()}
        (ROOT / figure.file).write_text(figures.measured_file(figure, text, facts))
        listed = next(one for one in BLOCKS if one.name == "measured")
        page = ROOT / listed.file
        page.write_text(figures.replaced(page.read_text(), listed, measured_files()))
        print(f"nightly: {figure.file} is written, and in the list of {listed.file}: commit them")
    print(f"nightly: {'failed: ' + ' '.join(failed) if failed else 'passed'}")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
