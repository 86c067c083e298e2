#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which problems of simulations does the published algorithm not solve? By hand: simulates the planar scenes of
corpus/scenes with --problems into a temporary folder, surveys what was met, and prints a table in Markdown, with
the problems that were not solved below it.

  tests/setup/scene_statistics.py PROGRAM [SCENE ...] [--exact] [--jobs N]

SCENE: names, all by default. The published algorithm runs over doubles, and over rationals where that is no
solution with a residual of at most 1e-6; --exact: all over rationals, up to 32 contacts. In brackets: how many
of them ran over rationals. Seconds are those of the survey. Exit 0 if complete driving, or a method
behind it, solved each problem or proved that it has no solution.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIMULATED = (0, 3)  # 3: a frame without an answer, whose problem was met too


def survey(program, scene, exact):
    """How the last run of each problem ended, over rationals if there is one, of the published algorithm and of
    the other methods; what the published algorithm did not solve, its runs over rationals, seconds."""
    with tempfile.TemporaryDirectory() as folder:
        problems = pathlib.Path(folder) / "problems"
        command = [program, "simulate", ROOT / "corpus/scenes" / f"{scene}.json", "-o", f"{folder}/run", "--no-svg",
                   "--problems", problems]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in SIMULATED:
            sys.exit(done.stderr)
        start = time.monotonic()
        command = [program, "survey", problems, "--json", *([] if exact else ["--suspicions"])]
        entries = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    published, others, unsolved, rationals = collections.Counter(), collections.Counter(), [], 0
    for entry in entries:
        others[[run["outcome"] for run in entry["runs"] if run["method"] != "baraff"][-1]] += 1
        for run in [run for run in entry["runs"] if run["method"] == "baraff"][-1:]:
            published[run["outcome"]] += 1
            rationals += run["arithmetic"] == "exact"
            if run["outcome"] != "solved":
                unsolved.append(f"{pathlib.Path(entry['file']).stem}: {run['outcome']}, {run['arithmetic']}, "
                                f"{entry['contacts']} contacts")
    return {"scene": scene, "problems": len(entries), "published": published, "others": others,
            "unsolved": unsolved, "rationals": rationals, "seconds": time.monotonic() - start}


def text(counts):
    return ", ".join(f"{count:,} {outcome}" for outcome, count in counts.most_common()) or "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    scenes = options.scenes or sorted(path.stem for path in (ROOT / "corpus/scenes").glob("*.json"))
    print("| scene | problems | `baraff` | (over rationals) | complete driving, or behind it others | seconds |\n|---|---|---|---|---|---|")
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for row in pool.map(lambda scene: survey(program, scene, options.exact), scenes):
            rows.append(row)
            print(f"| `{row['scene']}` | {row['problems']:,} | {text(row['published'])} | ({row['rationals']:,}) | "
                  f"{text(row['others'])} | {row['seconds']:.0f} |", flush=True)
    published, others = (sum((row[key] for row in rows), collections.Counter()) for key in ("published", "others"))
    print(f"| all | {sum(row['problems'] for row in rows):,} | {text(published)} | "
          f"({sum(row['rationals'] for row in rows):,}) | {text(others)} | "
          f"{sum(row['seconds'] for row in rows):.0f} |\n")
    for row in rows:
        print("".join(f"{line}\n" for line in row["unsolved"]), end="")
    sys.exit(0 if set(others) <= {"solved", "no-solution"} else 1)


if __name__ == "__main__":
    main()
