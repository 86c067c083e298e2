#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How fast the pages of a report open in Chromium, with few findings and with ten thousand.

    page_times.py PROGRAM [--repeats N] [--json]

A page has opened when its load event has ended; the processor time is that of its thread, whatever else runs. Wants reports/web/node_modules (npm ci there) and chromium."""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
from report_page_test import CAMPAIGN, MANY, add_findings  # noqa: E402

PAGES = ("index.html", "findings.html", "results.html")


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def measure(program, folder, repeats):
    """Of each page: how many findings, its size, and of every time that it was opened the milliseconds, and those of the
    processor."""
    few, many = folder / "few.store", folder / "many.store"
    run(program, "search", *CAMPAIGN, "--problems", 40000, "--store", few, "--finishing", 100)
    shutil.copy(few, many)
    add_findings(many, MANY)
    files = {}
    for store in (few, many):
        out = folder / store.stem
        run(program, "report", store, "-o", out)
        lines = (out / "findings.csv").read_text().splitlines()
        files.update({out / page: len(lines) - 1 for page in PAGES})
    times = json.loads(run("node", ROOT / "tests/setup/page_times.mjs", repeats, *files))
    return [{"page": file.name, "findings": findings, "bytes": file.stat().st_size, "milliseconds": [opened for opened, _ in times[str(file)]],
             "processor": [processor for _, processor in times[str(file)]]}
            for file, findings in files.items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = measure(options.program.resolve(), Path(folder), options.repeats)
    if options.json:
        print(json.dumps(found))
        return
    for one in found:
        print(f"{one['page']:14} {one['findings']:6,} findings {one['bytes'] / 1e3:6.0f} kB, opened in "
              f"{statistics.median(one['milliseconds']):.0f} ms; of the processor {statistics.median(one['processor']):.0f}")


if __name__ == "__main__":
    main()
