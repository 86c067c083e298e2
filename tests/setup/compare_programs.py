#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the outputs of two builds of the program, by hand: before and after a change of its structure.

  tests/setup/compare_programs.py OLD NEW [--generated N] [--jobs J]

Runs some thousands of commands with both, over every problem and scene of the corpus and N generated problems, and
groups what differs: by verb and options, and by what of the output it is. Of JSON outputs the keys that both have
are compared; keys that only one has are listed by group. Exit 0 if nothing differs.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
METHODS = ("baraff", "complete", "lemke", "enumerate", "fast")
ARITHMETICS = ("exact", "double", "float", "quad", "interval", "filtered")
CLAIMS = ("solution-exists", "symmetric", "psd", "in-range", "h", "safe", "cycle")
POLICIES = ("paper", "resume=round", "ties=contacts,apex=suspended", "scan=most-violated,file=yes", "give-up=second")
SECONDS = 60


def generated(draw):
    """Problems as a person writes them: small integers, singular ones and parallel contacts among them."""
    contacts = draw.randint(1, 4)
    kinds = [draw.choice(["static", "static", "frictionless"]) for _ in range(contacts)]
    rows, columns = sum(2 if kind == "static" else 1 for kind in kinds), draw.randint(1, 2 * contacts + 1)
    J = [[draw.randint(-4, 4) for _ in range(columns)] for _ in range(rows)]
    c = [draw.randint(-4, 4) for _ in range(columns)]
    return {"format": "stiction-problem", "version": 1, "dimension": 2,
            "contacts": [{"kind": k, **({"mu": draw.choice(["1", "1/2", "1/5", "2", "0"])} if k == "static" else {})}
                         for k in kinds],
            "A": [[str(sum(x * y for x, y in zip(p, q))) for q in J] for p in J],
            "b": [str(sum(x * y for x, y in zip(row, c))) for row in J]}


def commands(folder, count):
    """Lists of arguments; the last of a `certify` or `draw` is the output, - for standard output."""
    problems = sorted((ROOT / "corpus").glob("*.json")) + sorted((ROOT / "corpus/sliding").glob("*.json"))
    space = sorted((ROOT / "corpus/space").glob("*.json"))
    scenes = sorted((ROOT / "corpus/scenes").glob("*.json")) + sorted((ROOT / "corpus/scenes/space").glob("*.json"))
    draw = random.Random(11)
    for index in range(count):
        file = folder / f"generated-{index}.json"
        file.write_text(json.dumps(generated(draw)))
        yield ["solve", file, "--method", draw.choice(METHODS), "--arithmetic", draw.choice(ARITHMETICS), "--json"]
        yield ["replay", file, "--json", "--policy", draw.choice(POLICIES)]
        yield ["certify", file, "--claim", draw.choice(CLAIMS), "-o", "-"]
    for problem in problems + space:
        for method in METHODS:
            for arithmetic in ARITHMETICS:
                yield ["solve", problem, "--method", method, "--arithmetic", arithmetic, "--json"]
        for claim in CLAIMS if problem in problems else CLAIMS[:4]:
            yield ["certify", problem, "--claim", claim, "-o", "-"]
    for problem in problems:
        for policy in POLICIES:
            yield ["replay", problem, "--json", "--policy", policy]
        yield ["replay", problem, "--json", "--all-policies"]
        yield ["certify", problem, "--all", "--json"]
        yield ["minimize", problem, "-o", "-"]
    for scene in scenes:
        yield ["assemble", scene, "-o", "-"]
        yield ["draw", scene, "-o", "-"]


def run(program, arguments):
    try:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=SECONDS)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return "no end", ""


def document(text):
    try:
        return json.loads(text)
    except ValueError:
        return None


def differences(old, new):
    """What differs between two (exit, output), in few words."""
    if old[0] != new[0]:
        yield f"exit {old[0]} -> {new[0]}"
    left, right = document(old[1]), document(new[1])
    if not (isinstance(left, dict) and isinstance(right, dict)):
        if old[1] != new[1]:
            yield "text"
        return
    for key in sorted({*left} | {*right}):
        if key not in left or key not in right:
            yield f"only {'new' if key in right else 'old'} has `{key}`"
        elif left[key] != right[key]:
            values = f": {left[key]} -> {right[key]}" if key in ("outcome", "claim") else ""
            yield f"`{key}`{values}"


def group_of(arguments):
    """The command without the names of its files."""
    return " ".join("FILE" if isinstance(a, pathlib.Path) else re.sub(r"^-o$|^-$", "", a) for a in arguments).strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--generated", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    o = parser.parse_args()
    groups, examples, equal = collections.Counter(), {}, 0
    with tempfile.TemporaryDirectory() as name:
        listed = list(commands(pathlib.Path(name), o.generated))
        with concurrent.futures.ThreadPoolExecutor(o.jobs) as pool:
            both = pool.map(lambda arguments: [run(program, arguments) for program in (o.old, o.new)], listed)
            for arguments, (old, new) in zip(listed, both):
                found = list(differences(old, new))
                equal += not found
                for difference in found:
                    key = (group_of(arguments), difference)
                    groups[key] += 1
                    examples.setdefault(key, pathlib.Path(arguments[1]).name)
    for (command, difference), count in sorted(groups.items()):
        print(f"{count:5} {command}: {difference} ({examples[command, difference]})")
    print(f"{len(listed)} commands, {equal} equal")
    return 0 if equal == len(listed) else 1


if __name__ == "__main__":
    raise SystemExit(main())
