# SPDX-License-Identifier: Apache-2.0
"""Loops of the published algorithm in space on random problems: suspected, proved by which means, open.

    A = J J', b = J w    J 3n x (3n + 1), entries of J and w uniform integers in [-1000, 1000]

mu is 1/5, 1/2, 1, 2 or 5 at all contacts, in turn. Doubles suspect a loop where a rounded state recurs. `certify
--claim cycle` proves it: the sets of a state that remembers nothing else recur (`states`), or the run never
leaves a box of what it remembers (`box`), whose limit may be a tie (`punctured`); `lowest mu`: of those that are
proved. Every certificate is shown to the independent checker, certify/check_runs.py, which also says in which boxes no
state recurs (`no state twice`, claim `endless`), and of which proofs the line or the trail told a zero (`by line or
trail`, certify/certificates.md). `refused`: those that it does not accept; --certificates FOLDER keeps all. Exit code 1 if any is refused."""

import collections
import json
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np

import stiction
import study

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "certify"))
from certificate_reader import Rejected, check  # noqa: E402
from check_runs import CLAIMS  # noqa: E402

POLICIES = {"literal": "paper", "redirect": "slip=redirect"}
MU = ("1/5", "1/2", "1", "2", "5")
FRICTION = [Fraction(mu) for mu in MU]


def draw(contacts, seed, index):
    numbers = np.random.Generator(np.random.PCG64([seed, contacts, index]))
    columns = 3 * contacts + 1
    J = numbers.integers(-1000, 1000, (3 * contacts, columns), endpoint=True)
    w = numbers.integers(-1000, 1000, columns, endpoint=True)
    return stiction.Problem(J @ J.T, J @ w, MU[index % len(MU)], ["static"] * contacts, dimension=3)


def verdict(certificate):
    """What the independent checker says of a certificate; nothing if it refuses it."""
    try:
        return check(certificate, CLAIMS)
    except Rejected:
        return ""


def prove(problem, mu, policy, count, file):
    """What becomes of a suspicion, at friction mu."""
    count["suspected"] += 1
    proof = stiction.certify(problem, "cycle", policy)
    if proof is None:
        count["open"] += 1
        return
    if file:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(proof.text)
    certificate = json.loads(proof.text)
    said = verdict(certificate)
    if not said:
        count["refused"] += 1
        return
    witness = certificate["witness"]
    count[witness["kind"]] += 1
    count["endless"] += witness["kind"] != "states" and verdict({**certificate, "claim": "endless"}) != ""
    count["past"] += "by the line" in said or "by the trail" in said
    count["lowest mu"] = min(count["lowest mu"] or max(FRICTION), mu)
    count["coordinates"] = max(count["coordinates"], len(witness.get("radii", ())))


def row_of(contacts, slip, seeds, problems, folder):
    count = collections.Counter()
    for seed in seeds:
        for first, some in study.chunks(problems):
            drawn = [draw(contacts, seed, index) for index in range(first, first + some)]
            ends = stiction.solve_all(drawn, "baraff", "double", POLICIES[slip])["outcome"]
            for index in np.flatnonzero(ends == "cycle"):
                name = f"{contacts}-{slip}-{seed}-{first + index}.json"
                prove(drawn[index], FRICTION[(first + index) % len(MU)], POLICIES[slip], count,
                      folder and Path(folder, name))
    kinds = [count[kind] for kind in ("states", "box", "punctured")]
    proved = sum(kinds)
    return (contacts, slip, len(seeds) * problems, count["suspected"], *kinds,
            count["endless"], count["past"], study.share(proved, count["suspected"]),
            *(count[name] for name in ("open", "refused", "coordinates")),
            str(count["lowest mu"]) if proved else "-")


def main():
    o = study.options(__doc__, contacts=[2, 3], slip=["literal", "redirect"], problems=10000, seeds=[11, 12, 13],
                      certificates="")
    rows = [row_of(contacts, slip, o.seeds, o.problems, o.certificates) for contacts in o.contacts for slip in o.slip]
    study.show(["contacts", "`slip`", "problems", "suspected", "by states", "by boxes", "punctured", "no state twice",
                "by line or trail", "proved, 95 %", "open", "refused", "most coordinates", "lowest mu"], rows)
    sys.exit(any(row[-3] for row in rows))


study.run(main)
