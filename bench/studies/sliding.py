# SPDX-License-Identifier: Apache-2.0
"""Section 6: how the published algorithm ends where contacts slide, under the policy paper.

Problems of the search's generators whose last contacts slide, each to one side or the other, with the friction
coefficients that they were drawn with. A stays symmetric and semidefinite; after (24) the matrix that the algorithm
sees is not. Runs are decided by certified signs; whether a problem with a loop has a solution, and how it ends under
every policy, is decided exactly. Outcomes are whole numbers of problems."""

import random

import numpy as np

import stiction
import study

OUTCOMES = ("solved", "ray", "singular", "stall", "limit", "undecided", "cycle")


def sliding(problem, count, draw):
    """The problem, of which the last contacts slide."""
    contacts = len(problem.kinds)
    kinds = ["static"] * (contacts - count) + ["sliding"] * count
    slips = [None] * (contacts - count) + [draw.choice((1, -1)) for _ in range(count)]
    return stiction.Problem(problem.A, problem.b, problem.mu, kinds, slips=slips)


def row_of(generator, contacts, count, o):
    outcomes = dict.fromkeys(OUTCOMES, 0)
    claims, every = {"solution-exists": 0, "no-solution": 0}, 0
    draw = random.Random(f"{o.seed} {contacts} {count}")
    for first, size in study.chunks(o.problems):
        problems = [sliding(problem, count, draw)
                    for problem in stiction.draw(generator, contacts, size, o.seed, first=first)]
        run = stiction.solve_all(problems, "baraff", "filtered")
        for outcome, number in zip(*np.unique(run["outcome"], return_counts=True)):
            outcomes[outcome] += int(number)
        for i in np.flatnonzero(run["outcome"] == "cycle"):
            certificate = stiction.certify(problems[i])
            if certificate is not None:
                claims[certificate.kind] += 1
            every += all(end["outcome"] == "cycle" for end in stiction.ends(problems[i]).values())
    return (f"`{generator}`", f"{contacts}, {count}", *outcomes.values(), study.rate(outcomes["cycle"], o.problems),
            f"{claims['solution-exists']}, {claims['no-solution']}", every)


def main():
    o = study.options(__doc__, generator=["integers", "small"], contacts=[1, 2, 3], problems=10000, seed=1)
    study.show(["generator", "contacts, sliding", *OUTCOMES, "cycles in a million, 95 %", "with a solution, without",
                "under every policy"],
               [row_of(generator, contacts, count, o) for generator in o.generator for contacts in o.contacts
                for count in range(1, contacts + 1)])


study.run(main)
