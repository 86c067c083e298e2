# SPDX-License-Identifier: Apache-2.0
"""What certified outcomes cost beside doubles, and what staged suspicions save a search.

Certified outcomes: of `stiction bench --suite trade`, whose calls have their data in memory, the median of `filtered`
and of `exact` by that of `double`, by family; and how many runs needed rationals. Searches: processor time of a
campaign whose suspicions, and one problem in 5,000, are decided by certified signs, and of one that decides every
problem over rationals."""

import json
import os
import subprocess
import time

import stiction
import study

PROGRAM = os.path.join(os.path.dirname(stiction.__file__), "../../../stiction")


def ladder(o):
    """method, contacts, family -> arithmetic -> line."""
    words = [PROGRAM, "bench", "--suite", "trade", "--json", "--seed", str(o.seed), "--problems", str(o.problems),
             "--contacts", *map(str, o.contacts)]
    lines = {}
    for line in json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout):
        lines.setdefault((line["method"], line["setting"], line["family"]), {})[line["arithmetic"]] = line
    return lines


def certified(lines):
    for (method, contacts, family), by in lines.items():
        if method in ("complete", "baraff"):
            double, filtered, exact = (by[name]["microseconds"] for name in ("double", "filtered", "exact"))
            yield (f"`{method}`", contacts, f"`{family}`", by["filtered"]["problems"], double[1],
                   filtered[1] / double[1], exact[1] / double[1], study.share(by["filtered"]["decided_on"][-1], by["filtered"]["problems"]))


def seconds(generator, contacts, arithmetic, o):
    """Processor time of the same campaign, finishing apart."""
    start = time.process_time()
    for _ in stiction.search(generator, contacts, problems=o.searched, seed=o.seed, threads=1, finishing=0,
                             arithmetic=arithmetic):
        pass
    return time.process_time() - start


def main():
    o = study.options(__doc__, contacts=[2, 4, 6, 8], problems=30, searched=1000, repeat=3, seed=1)
    study.show(["method", "contacts", "family", "problems", "doubles, microseconds", "certified, times doubles",
                "rationals, times doubles", "needed rationals, 95 %"], certified(ladder(o)))
    rows = []
    for generator in ("conditioned", "near-degenerate"):
        for contacts in o.contacts:
            pairs = [[seconds(generator, contacts, arithmetic, o) for arithmetic in ("exact", "double")]
                     for _ in range(o.repeat)]
            rows.append((f"`{generator}`", contacts, study.times([exact / double for exact, double in pairs])))
    study.show(["search of", "contacts", "problems a second, times those over rationals: median (90 %)"], rows)


study.run(main)
