# SPDX-License-Identifier: Apache-2.0
"""For how many problems in space is a solution of Coulomb's law certified within a box?

Problems of the generator `space`; `certify --claim coulomb-exact`, which shows nothing where a strict inequality of the
forces that it found is within 1e-6 of its unit. So the share of the nondegenerate problems is at least what stands
here."""

import stiction
import study


def row_of(contacts, count, seed):
    problems = stiction.draw("space", contacts, count, seed)
    shown = sum(stiction.certify(problem, "coulomb-exact") is not None for problem in problems)
    return contacts, count, shown, study.share(shown, count)


def main():
    o = study.options(__doc__, contacts=[1, 2, 3, 4, 5, 6, 7, 8], problems=200, seed=1)
    study.show(["contacts", "problems", "certified", "share, 95 %"],
               [row_of(contacts, o.problems, o.seed) for contacts in o.contacts])


study.run(main)
