#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `./run test --nightly` ends with: its steps, how long each took and how it ended, as reports/measured/nightly.md.

    nightly.py FOLDER PROGRAM    FOLDER has steps.tsv and a log of each step; PROGRAM says its commit

Written only where the program was built of a commit. Exit 1 if a step failed."""

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
    "sanitizers": r"\d+% tests passed.*",
    "threads": r"\d+% tests passed.*",
    "traces": r"traces: (.*)",
    "mutants": r"drawn, seed \d+: .*",
}


def step(folder, line):
    name, seconds, status = line.split("\t")
    log = folder / f"{name}.log"
    said = re.findall(f"^{SAID[name]}$", log.read_text(errors="replace"), re.M) if name in SAID and log.exists() else []
    return name, f"{int(seconds) / 60:.1f}", "passed" if status == "0" else f"failed ({status})", said[-1] if said else ""


def mutants(folder):
    """The tables of mutate.py, and what survived."""
    log = folder / "mutants.log"
    found = log.exists() and re.search(r"^\| \| bugs \|.*", log.read_text(errors="replace"), re.M | re.S)
    return f"\n\nThe mutants:\n\n{found[0].strip()}" if found else ""


def main():
    folder, program = Path(sys.argv[1]), sys.argv[2]
    lines = (folder / "steps.tsv").read_text().splitlines()
    rows = [step(folder, line) for line in lines]
    minutes = sum(int(line.split("\t")[1]) for line in lines) / 60
    text = table(["step", "minutes", "ended", "said"], rows) + f"\n\n{minutes:.0f} minutes in all.{mutants(folder)}"
    failed = [row[0] for row in rows if row[2] != "passed"]
    print(text)
    if "dirty" in figures.commit(program):
        print("nightly: not written: the program was built of no commit; commit, and run it again")
    else:
        figure = next(one for one in MEASUREMENTS if one.name == "nightly")
        facts = {"command": "./run test --nightly", "commit": figures.commit(program), "date": time.strftime("%Y-%m-%d"),
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
