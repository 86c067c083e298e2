#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Looks for worse problems than the records have: optimized searches, and, if the best of them beats the record that
stands, random ones of the same size beside it. The record is the best of all of these.

    tests/setup/records.py build/release/stiction --objective steps pieces --contacts 3 4 5 \\
        --generator psd integers exponential --problems 300000

Prints a line per search. Exit: 0 whether or not a record was set, 1 if something failed.
"""

import argparse
import json
import resource
import shlex
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "corpus/records"
LOW = ("condition", "friction")  # are better
ROUNDED = ("pivot", "rounding", "margin", "distance", "steps-per-contact")  # no record holds them exactly


def children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Search:
    """One search, and its best problem as a record in `folder`, if it has one."""

    def __init__(self, program, o, generator, optimizer, folder, problems):
        mu = o.random_mu if optimizer == "random" and o.objective == "friction" else o.mu
        self.store = Path(folder) / f"{optimizer}-{generator}-{problems}.store"
        self.words = ["search", "--objective", o.objective, "--optimizer", optimizer, "--generator", generator,
                      "--contacts", str(o.contacts), "--mu", *mu, *(["--gravity-only"] if o.gravity_only else []),
                      "--seed", str(o.seed), "--problems", str(problems)]
        before = children()
        done = subprocess.run([program, *self.words, "--threads", str(o.threads), "--finishing", "0", "--store", self.store],
                              capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{shlex.join(self.words)}: exit {done.returncode}\n{done.stderr}")
        self.seconds = children() - before
        self.problem = self.store.with_suffix(".json")
        best = subprocess.run([program, "problem", self.store, "--best", "-o", self.problem], capture_output=True)
        self.value = self.record_value(program, o, folder) if best.returncode == 0 else None
        print(f"{optimizer:12} {generator:16} {'nothing' if self.value is None else self.value} in {self.seconds:.0f} s", flush=True)

    def command(self):
        return f"./run {shlex.join(self.words)} --store S && ./run problem S --best"

    def record_value(self, program, o, folder):
        done = self.add(program, o, Path(folder), "trial", ["--random-command", "none"])
        return Fraction(json.loads((Path(folder) / "trial.json").read_text())["value"]) if done else None

    def add(self, program, o, folder, name, more):
        words = [program, "records", "--folder", folder, "--add", self.problem, "--frontier", name, "--what", o.what,
                 "--objective", o.objective, "--command", self.command(), "--seconds", f"{self.seconds:.1f}", *more]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode and "has no value" not in done.stderr and "found no definite" not in done.stderr:
            print(done.stderr, file=sys.stderr)
        return done.returncode == 0


def standing(name):
    file = FOLDER / f"{name}.json"
    return Fraction(json.loads(file.read_text())["value"]) if file.exists() else None


WHAT = {
    "steps": "steps of a run that solves",
    "give-ups": "variables that a run gives up and yet solves",
    "zero-run": "steps of length zero, one after the other within a drive, of a run that solves",
    "period": "drives of a loop's period",
    "pieces": "linear pieces of complete driving",
    "descents": "descents of complete driving",
    "folds": "folds of complete driving",
}


def look(o):
    """One frontier: whether it could be recorded, if there is something to record."""
    better = min if o.objective in LOW else max
    with tempfile.TemporaryDirectory() as folder:
        found = [Search(o.program, o, generator, optimizer, folder, o.problems)
                 for generator in o.generator for optimizer in o.optimizer]
        found = [search for search in found if search.value is not None]
        if not found:
            print(f"{o.frontier}: nothing", flush=True)
            return True
        best = better(found, key=lambda search: search.value)
        old = standing(o.frontier)
        if old is not None and better(old, best.value) == old:
            print(f"{o.frontier}: {old} stands", flush=True)
            return True
        equal = o.problems * len(o.optimizer)
        random = [Search(o.program, o, generator, "random", folder, equal) for generator in o.generator]
        values = [search.value for search in random if search.value is not None]
        best = better([best, *(search for search in random if search.value is not None)], key=lambda search: search.value)
        more = ["--random-evaluations", str(equal * len(o.generator)),
                "--random-command", "; ".join(search.command() for search in random)]
        if values:
            more += ["--random", str(better(values))]
        recorded = best.add(o.program, o, FOLDER, o.frontier, more)
        print(f"{o.frontier}: {best.value}, before {old}" if recorded else f"{o.frontier}: could not be recorded",
              flush=True)
        return recorded


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--objective", nargs="+", required=True)
    parser.add_argument("--contacts", nargs="+", type=int, required=True)
    parser.add_argument("--frontier", help="name of the record (default: OBJECTIVE-N-contacts)")
    parser.add_argument("--what", help="what the record is one of, in words")
    parser.add_argument("--generator", nargs="+", required=True)
    parser.add_argument("--optimizer", nargs="+", default=["evolution"])
    parser.add_argument("--mu", nargs="+", default=["1"])
    parser.add_argument("--random-mu", nargs="+", default=["1", "1/2", "1/3", "1/5", "1/10", "1/20", "1/50"],
                        help="what random problems draw from where friction is the objective")
    parser.add_argument("--gravity-only", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--problems", type=int, default=300_000)
    parser.add_argument("--threads", type=int, default=1)
    o = parser.parse_args()
    rows = [(objective, contacts) for objective in o.objective for contacts in o.contacts]
    for objective in o.objective:
        if objective in ROUNDED:
            parser.error(f"--objective: found {objective}, expected one whose values doubles do not round")
        if objective not in WHAT and not o.what:
            parser.error(f"--objective {objective}: expected --what, in words")
    if (o.frontier or o.what) and len(rows) > 1:
        parser.error("--frontier, --what: expected one objective and one number of contacts")
    recorded = True
    for objective, contacts in rows:
        one = argparse.Namespace(**{**vars(o), "objective": objective, "contacts": contacts})
        one.frontier = o.frontier or f"{objective}-{contacts}-contacts"
        one.what = o.what or f"{WHAT[objective]}, {contacts} contacts"
        recorded &= look(one)
    return 0 if recorded else 1


if __name__ == "__main__":
    sys.exit(main())
