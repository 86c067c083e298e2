# SPDX-License-Identifier: Apache-2.0
"""What certified outcomes cost beside doubles, and what staged suspicions save a search.

Certified outcomes: as `trade` measures them, the median of `filtered` and of `exact` by that of `double`, by family; and
how many runs needed rationals. Walls of COURSESxBRICKS at rest: processor time of `solve` and `certify`, whole processes
that end at --limit seconds. Searches: processor time of a campaign whose suspicions, and one problem in 5,000, are
decided by certified signs, and of one that decides every problem over rationals."""

import json
import tempfile
import time
from pathlib import Path

import stiction
import study
import trade

ROWS = [(method, arithmetic, "") for method in ("complete", "baraff") for arithmetic in ("double", "filtered", "exact")]


def certified(o):
    for source in trade.sources(o, "--contacts", *o.contacts):
        lines = list(trade.measured(source, ROWS))
        for double, filtered, exact in (lines[:3], lines[3:]):
            unit, problems = double["microseconds"][1], filtered["problems"]
            yield (f"`{double['method']}`", double["setting"], f"`{double['family']}`", problems, unit,
                   filtered["microseconds"][1] / unit, exact["microseconds"][1] / unit,
                   study.share(filtered["decided_on"][-1], problems))


def walls(o):
    with tempfile.TemporaryDirectory(prefix="stiction-walls-") as folder:
        file = Path(folder, "wall.json")
        for wall in o.walls:
            blocks = study.wall(*map(int, wall.split("x")))
            for dimension, where in ((2, "plane"), (3, "space")):
                file.write_text(json.dumps(study.scene("wall", dimension, blocks, 1)))
                ends = [study.process(study.PROGRAM, *words, limit=o.limit) for words in (
                    ("solve", file), ("certify", file, "-o", Path(folder, "proof.json")))]
                yield wall, where, len(blocks), *(seconds if code == 0 else f"exit {code}" for code, seconds in ends)


def seconds(generator, contacts, arithmetic, o):
    """Processor time of the same campaign, finishing apart."""
    start = time.process_time()
    for _ in stiction.search(generator, contacts, problems=o.searched, seed=o.seed, threads=1, finishing=0,
                             arithmetic=arithmetic):
        pass
    return time.process_time() - start


def main():
    o = study.options(__doc__, contacts=[2, 4, 6, 8], problems=30, searched=1000, repeat=3, seed=1,
                      walls=["6x5", "10x10"], limit=60)
    study.show(["method", "contacts", "family", "problems", "doubles, microseconds", "certified, times doubles",
                "rationals, times doubles", "needed rationals, 95 %"], certified(o))
    study.show(["wall", "in", "bodies", "`solve`, s", "`certify`, s"], walls(o))
    rows = []
    for generator in ("conditioned", "near-degenerate"):
        for contacts in o.contacts:
            pairs = [[seconds(generator, contacts, arithmetic, o) for arithmetic in ("exact", "double")]
                     for _ in range(o.repeat)]
            rows.append((f"`{generator}`", contacts, study.times([exact / double for exact, double in pairs])))
    study.show(["search of", "contacts", "problems a second, times those over rationals: median (90 %)"], rows)


study.run(main)
