# SPDX-License-Identifier: Apache-2.0
"""Section 4 of the paper without friction, beside elimination and quadratic programs, to 150 contacts.

Over doubles: LU of A f = -b by LAPACK, with partial pivoting, on one thread, many matrices a call; section 4 (`baraff`);
Lemke's method; the fast method, which factors the clamped part only; program (5) by Ipopt, with the process that each
call starts. Exactly: the program by CGAL (`qp`), on integers. Microseconds of processor time of whole calls, over doubles
the least of three: median (quartiles). Exit 1 where an exact answer is wrong."""

import json
import random
import sys
import time

import study  # before numpy: one thread

import numpy as np

import stiction

METHODS = {"baraff": ("baraff", "double"), "lemke": ("lemke", "double"), "fast": ("fast", "double"),
           "ipopt": ("qp", "double"), "qp": ("qp", "exact")}


def lu_seconds(systems):
    """Of one system."""
    A, b = (np.array(of, dtype=float) for of in zip(*systems))
    calls, start = 0, time.process_time()
    while time.process_time() - start < 0.05:
        np.linalg.solve(A, -b[..., None])
        calls += 1
    return (time.process_time() - start) / (calls * len(A))


def row_of(contacts, lu, runs):
    seconds = {method: run["seconds"] for method, run in runs.items()}
    baraff, ipopt = seconds["baraff"], seconds["ipopt"]
    return {"contacts": contacts, "problems": len(baraff),
            **{f"{method} solved": int((run["outcome"] == "solved").sum()) for method, run in runs.items()},
            "lu us": 1e6 * lu, "baraff us": study.quartiles(baraff, 1e6), "baraff/lu": study.quartiles(baraff / lu),
            "lemke/baraff": study.quartiles(seconds["lemke"] / baraff),
            "fast/baraff": study.quartiles(seconds["fast"] / baraff), "ipopt us": study.quartiles(ipopt, 1e6),
            "ipopt/baraff": study.quartiles(ipopt / baraff), "qp us": study.quartiles(seconds["qp"], 1e6),
            "qp/baraff": study.quartiles(seconds["qp"] / baraff)}


def main():
    o = study.options(__doc__, contacts=[3, 6, 12, 25, 50, 100, 150], problems=48, seed=1, json=False)
    rows, mismatches = [], 0
    for n in o.contacts:
        most = 48 if n <= 12 else 24 if n <= 25 else 8 if n <= 50 else 4  # exact arithmetic takes long
        systems = [study.definite(n, random.Random(f"{o.seed} {n} {index}"), 1) for index in range(min(o.problems, most))]
        problems = [stiction.Problem(A, b, [0] * n, ["frictionless"] * n) for A, b in systems]
        runs = {}
        for name, (method, arithmetic) in METHODS.items():
            study.say(f"{n} contacts: {name}")
            runs[name] = study.solved(problems, method, arithmetic, repeat=3 if arithmetic == "double" else 1)
        study.say()
        rows.append(row_of(n, lu_seconds(systems), runs))
        mismatches += study.contradictions([(1, runs["qp"])])
    if o.json:
        print(json.dumps({"suite": "frictionless", "seed": o.seed, "frictionless": rows, "mismatches": mismatches}))
    else:
        study.show(list(rows[0]), (row.values() for row in rows))
        print(f"{mismatches} mismatches")
    sys.exit(mismatches > 0)


study.run(main)
