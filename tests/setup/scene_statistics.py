#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which problems of simulations does the published algorithm not solve? By hand: simulates the planar scenes of
corpus/scenes with --problems into a temporary folder, surveys what was met, and prints a table in Markdown, with
the problems that were not solved below it.

  tests/setup/scene_statistics.py PROGRAM [SCENE ...] [--exact] [--jobs N]

SCENE: names, all by default. The published algorithm runs over doubles, and over rationals where that is no
solution with a residual of at most 1e-6. Where rounding leaves A nearly singular it can end otherwise over
rationals though doubles solve the problem: --exact runs all over rationals, up to 32 contacts, which takes ten
times as long and more. Seconds are those of the surveys. Exit 0 if complete driving, or a method behind it,
solved each problem or proved that it has no solution.
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
FILES = 50  # of one process


def simulate(program, scene, folder):
    problems = pathlib.Path(folder) / "problems"
    command = [program, "simulate", ROOT / "corpus/scenes" / f"{scene}.json", "-o", f"{folder}/run", "--no-svg",
               "--problems", problems]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in SIMULATED:
        sys.exit(done.stderr)
    return sorted(problems.iterdir())


def survey(program, files, *options):
    command = [program, "survey", *files, "--json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def judge(program, files, exact):
    """The runs of each problem, those over rationals behind those over doubles."""
    entries = survey(program, files, "--suspicions")
    if exact:
        for entry, more in zip(entries, survey(program, files)):
            entry["runs"] += more["runs"]
    return [(pathlib.Path(entry["file"]).stem, entry["contacts"], entry["runs"]) for entry in entries]


def count(entries, seconds):
    """How the problems of a scene ended: by the published algorithm over doubles and over rationals, by others."""
    row = {"problems": len(entries), "double": collections.Counter(), "exact": collections.Counter(),
           "others": collections.Counter(), "unsolved": [], "seconds": seconds}
    for name, contacts, runs in entries:
        row["others"][[run["outcome"] for run in runs if run["method"] != "baraff"][-1]] += 1
        published = {run["arithmetic"]: run["outcome"] for run in runs if run["method"] == "baraff"}
        for arithmetic, outcome in published.items():
            row[arithmetic][outcome] += 1
        if published.get("exact", published["double"]) != "solved":
            row["unsolved"].append(f"{name}, {contacts} contacts: {published}")
    return row


def text(counts):
    return ", ".join(f"{number:,} {outcome}" for outcome, number in counts.most_common()) or "-"


def show(name, row):
    print(f"| {name} | {row['problems']:,} | {text(row['double'])} | {text(row['exact'])} | {text(row['others'])} | "
          f"{row['seconds']:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    scenes = options.scenes or sorted(path.stem for path in (ROOT / "corpus/scenes").glob("*.json"))
    rationals = "all" if options.exact else "those not solved"
    print(f"| scene | problems | `baraff`, doubles | `baraff`, rationals: {rationals} | complete driving, or others "
          "behind it | seconds |\n|---|---|---|---|---|---|")
    rows = []
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            files = simulate(program, scene, folder)
            start = time.monotonic()
            parts = [files[i:i + FILES] for i in range(0, len(files), FILES)]
            judged = pool.map(lambda part: judge(program, part, options.exact), parts)
            rows.append(count([entry for part in judged for entry in part], time.monotonic() - start))
        show(f"`{scene}`", rows[-1])
    total = {key: sum((row[key] for row in rows), type(rows[0][key])()) for key in rows[0]}
    show("all", total)
    print("".join(f"\n{line}" for line in total["unsolved"]))
    sys.exit(0 if set(total["others"]) <= {"solved", "no-solution"} else 1)


if __name__ == "__main__":
    main()
