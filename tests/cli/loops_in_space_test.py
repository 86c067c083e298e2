# SPDX-License-Identifier: Apache-2.0
"""Loops in space: certified, accepted by both checkers; altered, refused by both."""

import copy
import json
import subprocess
import sys
from fractions import Fraction

import cli


def two_slips():
    return cli.ROOT / "corpus/space/cycle-under-both-slips.json"


class LoopsInSpace(cli.TestCase):
    def certificate(self, policy):
        file = self.folder / "loop.json"
        self.succeeds("certify", two_slips(), "--claim", "cycle", "--policy", policy, "-o", file)
        return json.loads(file.read_text())

    def verdicts(self, certificates):
        """Of the program, and of the two independent programs."""
        files = []
        for k, certificate in enumerate(certificates):
            files.append(self.folder / f"{k}.json")
            files[-1].write_text(json.dumps(certificate))
        said = [entry["accepted"] for entry in cli.run("check", *files, "--json").json()]
        for name in ("check_certificate.py", "check_runs.py"):
            done = subprocess.run([sys.executable, cli.ROOT / "certify" / name, *files], capture_output=True, text=True)
            self.assertEqual(done.stderr, "")
            lines = done.stdout.splitlines()
            self.assertEqual([": accepted: " in line for line in lines], said, done.stdout)
        return said

    def kinds(self):
        proofs = {proof["witness"]["kind"]: proof for proof in map(self.certificate, ("paper", "slip=redirect"))}
        self.assertEqual(set(proofs), {"states", "box"})
        return proofs

    def test_both_kinds_are_accepted(self):
        proofs = self.kinds()
        self.assertEqual(self.verdicts(proofs.values()), [True, True])
        self.assertEqual(len(proofs["box"]["witness"]["radii"]), len(proofs["box"]["witness"]["charts"]))

    def altered(self, proof):
        """(what, certificate), all of them false."""
        def with_(what, change):
            other = copy.deepcopy(proof)
            change(other["witness"], other["problem"])
            return what, other

        def put(key, value):
            return with_(f"{key} {value}", lambda witness, _: witness.update({key: value}))

        def sign(vector, k):
            def change(_, problem):
                problem[vector][k] = str(-Fraction(problem[vector][k]))
            return with_(f"the sign of {vector}[{k}]", change)

        witness = proof["witness"]
        word = witness["word"]
        yield put("word", word[:-1])
        yield put("word", [*word, word[-1]])
        yield put("word", [word[1], word[0], *word[2:]])
        yield put("word", [*word[:-1], word[-1].rsplit(" ", 1)[0] + " NC"])
        yield put("start", witness["start"] + 1)
        yield put("start", witness["start"] - 1 if witness["start"] else 7)
        yield put("period", witness["period"] + 1)
        yield put("period", 2 * witness["period"])
        yield put("bits", 64)
        yield put("bits", 5000)
        yield put("policy", "slip=redirect" if witness["policy"] == "paper" else "paper")
        yield put("policy", "slip=polygon")
        yield put("kind", "box" if witness["kind"] == "states" else "states")
        yield sign("b", 0)
        yield sign("b", 4)
        yield with_("mu", lambda _, problem: problem["contacts"][0].update(mu="1/7"))
        yield with_("A", lambda _, problem: problem["A"][1].__setitem__(4, "-1"))

    def altered_box(self, proof):
        def put(key, k, value):
            other = copy.deepcopy(proof)
            other["witness"][key][k] = value
            return f"{key}[{k}] {value}", other

        witness = proof["witness"]
        for k in range(len(witness["radii"])):
            centre, radius = (Fraction(witness[key][k]) for key in ("centre", "radii"))
            yield put("centre", k, str(centre + 2 * radius))
            yield put("centre", k, str(centre - 2 * radius))
            yield put("centre", k, str(-centre))
            yield put("radii", k, str(radius / 2**200))  # the run does not come into it
            yield put("radii", k, str(radius * 2**20))   # it has many words
            yield put("radii", k, "0")
            yield put("radii", k, str(-radius))
            yield put("charts", k, 1 if witness["charts"][k] == 0 else 0)
            yield put("charts", k, 2)
            if witness["charts"][k]:
                yield put("charts", k, -witness["charts"][k])

    def test_altered_ones_are_refused(self):
        proofs = self.kinds()
        cases = [*self.altered(proofs["states"]), *self.altered(proofs["box"]), *self.altered_box(proofs["box"])]
        self.assertGreater(len(cases), 40)
        for (what, _), accepted in zip(cases, self.verdicts([case for _, case in cases])):
            self.assertFalse(accepted, what)

    def test_other_contacts_are_refused_by_name(self):
        file = cli.ROOT / "corpus/space/three-sliding-contacts.json"
        self.refuses("certify", file, "--claim", "cycle", says=["a bilateral or sliding contact", "frictionless and static"])


if __name__ == "__main__":
    cli.main()
