# SPDX-License-Identifier: Apache-2.0
"""Whether every problem of space that has a solution is solved over doubles, and how dearly.

Of the generators `exceptional` and `space`: b is in range(A), so (H) of certify/existence.md holds and a solution of
Coulomb's law exists. And the files of corpus/space/critical: grooves, pinches and others near critical loads. Method auto
over doubles, whose forces the gate calls solved (solver/problem/gate.h) or nobody does. Amplification: how many times what
acts on a contact its forces may be, by which accelerations computed in doubles are sure at all; by quantile."""

import collections
from pathlib import Path

import numpy as np

import stiction
import study

CRITICAL = Path(__file__).resolve().parents[2] / "corpus/space/critical"


def row_of(name, contacts, problems):
    answers = collections.Counter()
    reasons = collections.Counter()
    amplifications = []
    for problem in problems:
        answer = stiction.solve(problem, "auto", "double")
        answers[answer.outcome] += 1
        if answer.outcome == "solved":
            amplifications.append(answer.json["amplification"])
        else:
            reasons[answer.reason or answer.outcome] += 1
    drawn = sum(answers.values())
    low, high = (study.number(float(end)) for end in 100 * np.array(stiction.interval(answers["solved"], drawn)))
    quantiles = np.quantile(amplifications, (0.5, 0.99, 1)) if amplifications else ["-"] * 3
    causes = ", ".join(f"{count} {reason}" for reason, count in sorted(reasons.items())) or "none"
    return (name, contacts, drawn, answers["solved"], f"[{low}, {high}]", causes, *quantiles)


def main():
    o = study.options(__doc__, generator=["exceptional", "space"], contacts=[1, 2, 3, 4, 5], problems=1000, seeds=[11])
    rows = []
    for generator in o.generator:
        for contacts in o.contacts:
            drawn = (problem for seed in o.seeds for first, count in study.chunks(o.problems)
                     for problem in stiction.draw(generator, contacts, count, seed, first=first))
            rows.append(row_of(f"`{generator}`", contacts, drawn))
    files = sorted(CRITICAL.glob("*.json"))
    rows.append(row_of("`corpus/space/critical`", "all", (stiction.load(file) for file in files)))
    study.show(["problems of", "contacts", "problems", "solved", "%, 95 %", "not solved, by cause", "amplification, median",
                "99 %", "most"], rows)


study.run(main)
