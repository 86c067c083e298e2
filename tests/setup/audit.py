#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Audits the search, by hand: every problem is run exactly, by all methods, and of these a random sample is
certified to have a solution and checked by the independent checker.

  tests/setup/audit.py PROGRAM [--problems N] [--sample N] [--seed K] [--store FILE] [--contacts N ...]

A store that is there already is taken as far as it goes. Exit 0 if there was no exception.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import sqlite3
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "certify"))
from certificate_reader import Rejected, check, load  # noqa: E402
from check_certificate import CLAIMS  # noqa: E402


def draw(program, store, units, indices, count, seed, folder):
    """Problem files drawn uniformly, without repetition: places that no unit has are drawn again."""
    chance, seen, files = random.Random(seed), set(), []
    while len(files) < count:
        place = (chance.randrange(units), chance.randrange(indices))
        if place in seen:
            continue
        seen.add(place)
        file = folder / f"{place[0]}-{place[1]}.json"
        done = subprocess.run([program, "problem", store, *map(str, place), "-o", file], capture_output=True, text=True)
        if done.returncode == 0:
            files.append(file)
        elif "expected 0 to" not in done.stderr:
            sys.exit(done.stderr)
    return files


def certify(program, problem):
    certificate = problem.with_suffix(".certificate.json")
    subprocess.run([program, "certify", problem, "-o", certificate], check=True, capture_output=True)
    return certificate


def accepted(problem, certificate):
    """Whether the certificate proves that this very problem has a solution."""
    stated = load(certificate)
    found = json.loads(problem.read_text())
    same = all(stated["problem"][key] == found[key] for key in ("contacts", "A", "b"))
    try:
        return same and check(stated, CLAIMS).startswith("solution-exists")
    except Rejected as reason:
        print(f"{problem.name}: {reason}")
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--problems", type=int, default=1000000)
    parser.add_argument("--sample", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--store", default="audit.store")
    parser.add_argument("--contacts", nargs="+", default=["1", "2", "3", "4", "5", "6"])
    o = parser.parse_args()
    program = os.path.abspath(o.program)
    subprocess.run([program, "search", "--audit-every", "1", "--enumerate-every", "20", "--contacts", *o.contacts, "--problems", str(o.problems),
                    "--seed", str(o.seed), "--store", o.store], check=True)
    summary = json.loads(subprocess.run([program, "status", o.store, "--json"], check=True, capture_output=True).stdout)
    with sqlite3.connect(o.store) as db:
        definition, = db.execute("SELECT value FROM campaign WHERE key = 'definition'").fetchone()
    db.close()
    with tempfile.TemporaryDirectory() as folder:
        problems = draw(program, o.store, summary["units"], json.loads(definition)["unit_problems"], o.sample, o.seed,
                        pathlib.Path(folder))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            certificates = list(pool.map(lambda problem: certify(program, problem), problems))
        good = sum(accepted(*pair) for pair in zip(problems, certificates))
    checked = summary["existence_checked"]
    exceptions = checked - summary["existence_solved"] + summary["disagreements_of_methods"]
    print(f"{checked} exact runs of {summary['problems']} problems, {summary['compared']} by Lemke's method too, all "
          f"modes tried of {summary['enumerated']}: {exceptions} exceptions; of {len(problems)} problems drawn at "
          f"random {good} certificates accepted by check_certificate.py")
    sys.exit(0 if exceptions == 0 and good == len(problems) and checked >= summary["problems"] else 1)


if __name__ == "__main__":
    main()
