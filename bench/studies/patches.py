# SPDX-License-Identifier: Apache-2.0
"""Ways to change the published algorithm, from the cheapest on, and how often each still fails.

    first, previous, second   what is given up differs, nothing else (give-up=..., solver/published/readings.md)
    fold                      where the determinant turns, the driven force goes back; where it is zero again the run
                              fails: complete driving without its descents
    lemke                     at the first give-up the problem is handed to Lemke's method
    complete                  complete driving

Failures in a million problems, of runs whose signs are certified: none is one of rounding."""

import numpy as np

import stiction
import study

RULES = {"first": "paper", "previous": "give-up=previous", "second": "give-up=second"}


def counted(generator, contacts, o):
    """What happens to the problems of a row: a name, and how often."""
    sums = dict.fromkeys(("gives up", "folds", *RULES, "fold", "lemke", "complete"), 0)
    for first, count in study.chunks(o.problems):
        problems = stiction.draw(generator, contacts, count, o.seed, first=first)
        for rule, policy in RULES.items():
            run = stiction.solve_all(problems, "baraff", "filtered", policy, max_drives=1000)
            failed = run["outcome"] != "solved"
            sums[rule] += failed.sum()
            if rule == "first":
                gave_up = failed | (run["give_ups"] > 0)
        complete = stiction.solve_all(problems, "complete", "exact")
        handed = stiction.solve_all([problems[i] for i in np.flatnonzero(gave_up)], "lemke", "filtered")
        for name, which in (("gives up", gave_up), ("folds", complete["folds"] > 0), ("fold", complete["descents"] > 0),
                            ("lemke", handed["outcome"] != "solved"), ("complete", complete["outcome"] != "solved")):
            sums[name] += which.sum()
    return {name: int(count) for name, count in sums.items()}


def main():
    o = study.options(__doc__, generator=["psd", "integers", "bodies", "scenes", "conditioned"], contacts=[2, 3, 4, 5],
                      problems=10000, seed=1)
    rows = []
    for generator in o.generator:
        for contacts in o.contacts:
            sums = counted(generator, contacts, o)
            rows.append((f"`{generator}`", contacts, o.problems, study.share(sums.pop("gives up"), o.problems),
                         study.share(sums.pop("folds"), o.problems),
                         *(study.rate(count, o.problems) for count in sums.values())))
    study.show(["generator", "contacts", "problems", "give up", "folds", *(f"`give-up={rule}`" for rule in RULES), "fold",
                "Lemke at a give-up", "`complete`"], rows)


study.run(main)
