# SPDX-License-Identifier: Apache-2.0
"""What the methods do on the same problems: outcomes, counts, folds, give-ups, and the starts of Ipopt.

Problems as in study.py. Runs are exact, and what they call solved is verified. Exit 1 where one method contradicts
another. Ipopt, and the enumeration of all contact modes of up to four contacts, are given every tenth and twentieth
problem."""

import collections
import sys

import numpy as np

import stiction
import study
from study import FRICTIONS

# Method and policy, and what it counts; one in so many problems.
METHODS = {("complete", "paper"): ("pieces", 1), ("baraff", "paper"): ("steps", 1),
           ("baraff", "apex=suspended"): ("steps", 1), ("baraff", "admit=eager,file=yes,apex=suspended"): ("steps", 1),
           ("lemke", "paper"): ("pivots", 1), ("ipopt", "paper"): ("starts", 10),
           ("enumerate", "paper"): ("programs", 20)}
COMPLETE, BARAFF, IPOPT = ("complete", "paper"), [key for key in METHODS if key[0] == "baraff"], ("ipopt", "paper")


def work_rows(contacts, runs):
    for (method, policy), run in runs.items():
        counter, done = METHODS[method, policy][0], run["outcome"] == "solved"
        ends = collections.Counter(run["outcome"][~done])
        counts = run[counter][done] if counter in run else []
        yield (contacts, f"`{method}`", "" if policy == "paper" else f"`{policy}`", len(done), int(done.sum()),
               ", ".join(f"{count} {end}" for end, count in ends.items()) or "0", study.share(ends["cycle"], len(done)),
               f"{counter}: {study.number(float(np.mean(counts)))} ({max(counts)})" if len(counts) else "-")


def main():
    o = study.options(__doc__, contacts=[2, 3, 4, 5, 6], problems=160, seed=1, generator="")
    work, folds, starts, wrong = [], collections.defaultdict(list), [], 0
    pairs = {key: collections.Counter() for key in BARAFF}
    for contacts in o.contacts:
        problems = [study.draw(o.generator, contacts, index, o.seed) for index in range(o.problems)]
        runs = {key: stiction.solve_all(problems[::every], key[0], "exact", key[1])
                for key, (_, every) in METHODS.items() if key[0] != "enumerate" or contacts <= 4}
        wrong += study.contradictions([(METHODS[key][1], run) for key, run in runs.items()])
        work += work_rows(contacts, runs)
        complete = runs[COMPLETE]
        for i, fold in enumerate(zip(complete["folds"] > 0, complete["descents"] > 0)):
            folds[f"{contacts} contacts"].append(fold)
            folds[f"mu = {FRICTIONS[i % len(FRICTIONS)]}"].append(fold)
        for key in BARAFF:
            give_ups = runs[key]["give_ups"] > 0
            pairs[key].update(zip(complete["folds"] > 0, give_ups))
            plain = (complete["folds"] == 0) & (np.arange(o.problems) % len(FRICTIONS) != 0)
            pairs[key]["plain"] += int(plain.sum())
            pairs[key]["equal"] += int((plain & (runs[key]["steps"] == complete["pieces"])).sum())
        ipopt = runs[IPOPT]
        needed = np.where(ipopt["outcome"] == "solved", np.minimum(ipopt["starts"], 4), 5)
        starts.append((contacts, len(needed), *(int((needed == k).sum()) for k in range(1, 6))))
    study.show(["contacts", "method", "policy", "problems", "solved", "not solved", "of these cycles, 95 %",
                "mean (most)"], work)
    by_contacts_first = sorted(folds.items(), key=lambda item: item[0].startswith("mu"))
    study.show(["", "problems", "folds, 95 %", "descents, 95 %"],
               [(name, len(of), *(study.share(int(sum(one)), len(of)) for one in zip(*of))) for name, of in by_contacts_first])
    study.show(["policy", "folds and give-ups", "folds only", "give-ups only", "neither",
                "no folds, mu > 0: as many steps"],
               [(f"`{policy}`", *(pair[key] for key in ((True, True), (True, False), (False, True), (False, False))),
                 f"{pair['equal']:,} of {pair['plain']:,}") for (_, policy), pair in pairs.items()])
    study.show(["contacts", "problems", "starts: 1", "2", "3", "4 to 20", "none"], starts)
    print(f"Methods that contradict each other: {wrong}")
    sys.exit(wrong > 0)


study.run(main)
