# SPDX-License-Identifier: Apache-2.0
"""Times of the methods on the same problems (study.py), microseconds of processor time: of whole calls on numbers in
memory, the least of three, of Ipopt with the process that each call starts. `work` counts what they do.

Answers are judged over rationals; `wrong`: called solved, and the residual is above the bound. Exit 1 where an exact
answer is wrong, or one method refutes what another solves. Ipopt, and the enumeration of all contact modes of up to four
contacts, are given every tenth and twentieth problem."""

import json
import sys

import study

# Method, arithmetic, policy: one in so many problems. The first is the unit of times.
METHODS = {("complete", "double", "paper"): 1, ("complete", "exact", "paper"): 1, ("baraff", "exact", "paper"): 1,
           ("baraff", "exact", "apex=suspended"): 1, ("baraff", "exact", "admit=eager,file=yes,apex=suspended"): 1,
           ("lemke", "exact", "paper"): 1, ("ipopt", "exact", "paper"): 10, ("baraff", "double", "paper"): 1,
           ("lemke", "double", "paper"): 1, ("enumerate", "exact", "paper"): 20}


def row_of(contacts, key, run, unit):
    method, arithmetic, policy = key
    is_solved = run["outcome"] == "solved"
    wrong = is_solved & (run["residual"] > (0 if arithmetic == "exact" else 1e-8))
    return {"contacts": contacts, "method": method, "reading": policy if method == "baraff" else "",
            "arithmetic": arithmetic, "problems": len(is_solved), "solved": int((is_solved & ~wrong).sum()),
            "wrong": int(wrong.sum()), "us": study.quartiles(run["seconds"], 1e6),
            "ratio": study.quartiles(run["seconds"] / unit["seconds"][::METHODS[key]])}


def main():
    o = study.options(__doc__, contacts=[2, 3, 4, 5, 6], problems=800, seed=1, generator="", json=False)
    rows, mismatches = [], 0
    for contacts in o.contacts:
        problems = [study.draw(o.generator, contacts, index, o.seed) for index in range(o.problems)]
        runs = {}
        for key, every in METHODS.items():
            study.say(f"{contacts} contacts: {' '.join(key)}")
            if key[0] != "enumerate" or contacts <= 4:
                runs[key] = study.solved(problems[::every], *key)
        study.say()
        rows += [row_of(contacts, key, run, runs[next(iter(METHODS))]) for key, run in runs.items()]
        mismatches += study.contradictions([(METHODS[key], run) for key, run in runs.items() if key[1] == "exact"])
    if o.json:
        print(json.dumps({"suite": "methods", "seed": o.seed, "generator": o.generator or "definite", "times": rows,
                          "mismatches": mismatches}))
    else:
        study.show(["contacts", "method", "reading", "arithmetic", "problems", "solved", "wrong",
                    "microseconds: median (quartiles)", "times `complete`, double"], (row.values() for row in rows))
        print(f"{mismatches} mismatches")
    sys.exit(mismatches > 0)


study.run(main)
