# SPDX-License-Identifier: Apache-2.0
"""Certificates of large planar problems: what it costs to make them, and to check them.

Bricks of 1 to 20 kg in walls (as many columns as courses), pyramids (of so many courses) and stacks, at rest or pushed
sideways by six tenths of their weight, friction 1/2; and, where STICTION_DATA names the folder, planar problems that
others published. Processor time of `certify`, `check` and check_certificate.py, the size of the file, and how many of the
two checkers refuse it once a number of its witness is altered."""

import json
import os
import random
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

import study

ROOT = Path(__file__).resolve().parents[2]
CHECKERS = ([study.PROGRAM, "check"], [sys.executable, ROOT / "certify/check_certificate.py"])
PUBLISHED = ("FrictionContactProblem00031", "FrictionContactProblem00237", "fc2d_granularflowonwall_00667_00000")
sys.set_int_max_str_digits(0)


def scene(places, sideways):
    draw = random.Random(len(places))
    bricks = [{"name": f"brick-{k}", "mass": draw.randint(1, 20), "position": place,
               "shapes": [{"box": ["31/32", "1/2"]}]} for k, place in enumerate(places)]
    floor = {"name": "floor", "fixed": True, "position": [0, -1], "shapes": [{"box": [400, 2]}]}
    return {"format": "stiction-scene", "version": 1, "name": "bricks", "dimension": 2, "mu": "1/2",
            "gravity": [6 if sideways else 0, -10], "bodies": [floor, *bricks]}


def wall(n):
    return [[column + course % 2 / 2, 0.25 + course / 2] for course in range(n) for column in range(n - course % 2)]


def pyramid(n):
    return [[column + course / 2, 0.25 + course / 2] for course in range(n) for column in range(n - course)]


def stack(n):
    return [[course % 3 / 16, 0.25 + course / 2] for course in range(n)]


def problems(o, folder):
    """Name and file of each."""
    for name, sizes, sideways in (("wall", o.walls, False), ("wall", o.pushed, True), ("pyramid", o.pyramids, False),
                                  ("stack", o.stacks, False)):
        for n in sizes:
            file = folder / "scene.json"
            file.write_text(json.dumps(scene({"wall": wall, "pyramid": pyramid, "stack": stack}[name](n), sideways)))
            yield f"{name} of {n}" + ", pushed" * sideways, file
    for name in PUBLISHED if "STICTION_DATA" in os.environ and not o.no_published else ():
        yield f"`{name}`", Path(os.environ["STICTION_DATA"]) / "friction" / f"{name}.dat"


def altered(certificate):
    """The same, with the last number of the forces, or of the entries of J, that is not zero a millionth larger."""
    witness = certificate["witness"]
    at = ([(witness["f"], i) for i in range(len(witness["f"]))] if "f" in witness else
          [(entry, 2) for entry in witness["factors"]["J"]["entries"]])
    numbers, i = [(numbers, i) for numbers, i in at if Fraction(numbers[i]) != 0][-1]
    numbers[i] = str(Fraction(numbers[i]) * Fraction(1000001, 1000000))
    return certificate


def rows(o, folder):
    proof, other = folder / "proof.json", folder / "altered.json"
    for name, problem in problems(o, folder):
        code, made = study.process(study.PROGRAM, "certify", problem, "-o", proof)
        if code != 0:
            raise ValueError(f"{name}: certify ends with exit {code}, expected 0")
        certificate, size = json.loads(proof.read_text()), proof.stat().st_size
        codes, checked = zip(*(study.process(*checker, proof) for checker in CHECKERS))
        if any(codes):
            raise ValueError(f"{name}: a checker refuses what certify wrote")
        contacts, claim = len(certificate["problem"]["contacts"]), certificate["claim"]
        other.write_text(json.dumps(altered(certificate)))
        refused = sum(study.process(*checker, other)[0] == 1 for checker in CHECKERS)
        yield name, contacts, f"`{claim}`", size / 1024, made, *checked, f"{refused} of 2"


def main():
    o = study.options(__doc__, walls=[5, 8, 10, 12, 15], pushed=[5], pyramids=[14], stacks=[30, 100],
                      no_published=False)
    with tempfile.TemporaryDirectory(prefix="stiction-certificates-") as folder:
        study.show(["problem", "contacts", "claim", "kB", "`certify`, s", "`check`, s", "`check_certificate.py`, s",
                    "altered: refused"], rows(o, Path(folder)))


study.run(main)
