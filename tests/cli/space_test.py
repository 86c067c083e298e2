# SPDX-License-Identifier: Apache-2.0
"""Problems in space: solved, certified, checked; what is not built is refused."""

import copy
import json
import subprocess
import sys
from fractions import Fraction

import cli

# Bodies of a gram hold bodies of tons: float has too few digits for them, and doubles lose some.
ILL_CONDITIONED = ("cycle-of-a-scene-3-contacts", "cycle-of-a-scene-4-contacts")


class Space(cli.TestCase):
    def problems(self):
        found = sorted((cli.ROOT / "corpus/space").glob("*.json"))
        self.assertGreater(len(found), 3)
        return found

    def solvable(self):
        return [file for file in self.problems() if not file.stem.startswith("no-solution")]

    def check(self, certificate, accepted):
        """Both checkers say the same."""
        done = self.succeeds("check", certificate, "--json", code=0 if accepted else 1)
        self.assertEqual([entry["accepted"] for entry in done.json()], [accepted])
        independent = subprocess.run([sys.executable, cli.ROOT / "certify/check_certificate.py", certificate],
                                     capture_output=True, text=True)
        self.assertEqual(independent.returncode, 0 if accepted else 1, independent.stdout + independent.stderr)

    def test_certificates_of_the_corpus_are_accepted(self):
        certificates = sorted((cli.ROOT / "corpus/space/certificates").glob("*.json"))
        self.assertGreater(len(certificates), 3)
        for certificate in certificates:
            with self.subTest(certificate=certificate.name):
                self.check(certificate, accepted=True)

    def test_every_problem_is_certified_under_both_laws(self):
        for problem in self.solvable():
            for claim in ("solution-exists", "coulomb-solution"):
                with self.subTest(problem=problem.name, claim=claim):
                    certificate = self.folder / "c.json"
                    self.succeeds("certify", problem, "-o", certificate, "--claim", claim)
                    value = json.loads(certificate.read_text())
                    self.assertEqual(value["claim"], claim)
                    if claim == "coulomb-solution":
                        self.assertGreater(Fraction(value["witness"]["bound"]), 1 - Fraction(1, 2**20))
                    self.check(certificate, accepted=True)

    def test_every_altered_number_is_rejected(self):
        def alterations(value, path=()):
            if isinstance(value, str) and path[0] in ("witness", "problem") and path[-1] not in ("format", "kind"):
                yield path
            if isinstance(value, (dict, list)):
                for key, item in value.items() if isinstance(value, dict) else enumerate(value):
                    yield from alterations(item, (*path, key))

        certificate = self.folder / "c.json"
        for claim in ("solution-exists", "coulomb-solution"):
            self.succeeds("certify", cli.ROOT / "corpus/space/three-sliding-contacts.json", "-o", certificate,
                          "--claim", claim)
            good = json.loads(certificate.read_text())
            paths = list(alterations(good))
            self.assertGreater(len(paths), 100)
            # All but A, whose columns of forces that are zero do not matter (tests/certify/tamper_test.py has A).
            for number, path in enumerate(cli.share((path for path in paths if path[1] != "A"), 4)):
                with self.subTest(claim=claim, path=path):
                    bad = copy.deepcopy(good)
                    place = bad
                    for key in path[:-1]:
                        place = place[key]
                    place[path[-1]] = str(Fraction(place[path[-1]]) + (1 if number % 2 else -1))
                    self.check(self.file("bad.json", bad), accepted=False)

    def test_a_solution_of_the_weak_law_is_no_solution_of_coulombs(self):
        problem = {"format": "stiction-problem", "version": 1, "dimension": 3,
                   "contacts": [{"kind": "static", "mu": "1/2"}],
                   "A": [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]], "b": ["-1", "3", "4"]}
        turned = {"f": ["1", "-1/2", "0"], "a": ["0", "5/2", "4"]}
        def made(claim, **witness):
            return self.file("c.json", {"format": "stiction-certificate", "version": 1, "claim": claim,
                                        "problem": problem, "witness": {**turned, **witness}})
        self.check(made("solution-exists"), accepted=True)
        self.check(made("coulomb-solution", bound="1"), accepted=False)
        self.check(made("coulomb-solution", bound="1/2"), accepted=True)
        self.check(made("coulomb-solution", bound="0"), accepted=False)
        self.check(made("coulomb-solution", bound="3/2"), accepted=False)
        self.check(made("coulomb-solution"), accepted=False)
        self.check(made("solution-exists", bound="1"), accepted=False)
        exact = {"f": ["1", "-3/10", "-2/5"], "a": ["0", "27/10", "18/5"]}
        self.check(made("coulomb-solution", bound="1", **exact), accepted=True)

    def test_methods_and_arithmetics(self):
        for problem in self.solvable():
            ill = problem.stem in ILL_CONDITIONED
            bounds = {"float": 1e-4, "double": 1e-8}
            for method, arithmetic in [("complete", "exact"), ("complete", "double"), ("complete", "float"),
                                       ("fast", "double")]:
                if ill and arithmetic == "float":
                    continue
                for law in ("baraff", "coulomb"):
                    with self.subTest(problem=problem.name, method=method, arithmetic=arithmetic, law=law):
                        if law == "baraff" and arithmetic != "exact":
                            self.refuses("solve", problem, "--method", method, "--arithmetic", arithmetic, "--law", law,
                                         says="--law baraff")
                            continue
                        done = self.succeeds("solve", problem, "--method", method, "--arithmetic", arithmetic,
                                             "--law", law, "--json").json()
                        self.assertEqual(done["outcome"], "solved")
                        if arithmetic != "exact":
                            self.assertLess(done["residual"], bounds[arithmetic])
                        self.assertEqual("bound" in done, arithmetic == "exact" and law == "coulomb")
                        self.assertEqual(done["law"], law)

    def test_a_path_that_folds_and_descends(self):
        problem = cli.ROOT / "corpus/space/fold-and-descent-two-contacts.json"
        done = self.succeeds("solve", problem, "--method", "complete", "--json").json()
        statistics = done["statistics"]
        self.assertEqual((statistics["folds"], statistics["descents"], done["word"]), (2, 1, "I I"))

    def test_more_sides(self):
        problem = cli.ROOT / "corpus/space/three-sliding-contacts.json"
        for sides in (4, 12, 16):
            done = self.succeeds("solve", problem, "--method", "complete", "--sides", sides, "--json").json()
            self.assertEqual(done["outcome"], "solved")
        for sides in (0, 3, 6, -4):
            self.refuses("solve", problem, "--method", "complete", "--sides", sides, says="multiple of 4")

    def test_no_solution_is_a_ray_or_undecided(self):
        problem = cli.ROOT / "corpus/space/no-solution-scripted-wedge.json"
        done = self.succeeds("solve", problem, "--method", "complete", "--json", code=1).json()
        self.assertEqual((done["outcome"], done["ray"]), ("ray", ["1", "1", "0"]))
        for method in ("complete", "fast"):
            done = self.succeeds("solve", problem, "--method", method, "--arithmetic", "double", "--json", code=3)
            self.assertEqual(done.json()["outcome"], "undecided")
        for words in ((), ("--law", "baraff"), ("--claim", "solution-exists"), ("--claim", "coulomb-solution")):
            out = self.folder / "none.json"
            self.succeeds("certify", problem, "-o", out, *words, code=3)
            self.assertFalse(out.exists())

    def dead_normal(self, free, name="dead.json"):
        """Nothing lifts the third contact, whose free acceleration is this; b is not in the range of A."""
        u = [1, 0, 0, 1, 0, 1, 0, 1, 0]
        A = [[str(2 * x * y + 2 * (i == j == 8)) for j, y in enumerate(u)] for i, x in enumerate(u)]
        return self.file(name, {"format": "stiction-problem", "version": 1, "name": "dead-normal", "dimension": 3,
                                "contacts": [{"kind": "static", "mu": "1"}] * 3, "A": A,
                                "b": ["-1", "0", "1/2", "-1", "0", "1/3", free, "1/4", "0"]})

    def test_a_contact_that_nothing_lifts(self):
        out = self.folder / "c.json"
        for law in ("baraff", "coulomb"):
            done = self.succeeds("solve", self.dead_normal("0"), "--law", law, "--json").json()
            self.assertEqual((done["outcome"], done["method"], done["law"]), ("solved", "fast", law))
            ray = self.succeeds("solve", self.dead_normal("0"), "--law", law, "--method", "complete", "--json", code=1)
            self.assertEqual(ray.json()["outcome"], "ray")
            self.succeeds("certify", self.dead_normal("0"), "-o", out, "--law", law)
            claim = "coulomb-solution" if law == "coulomb" else "solution-exists"
            self.assertEqual(json.loads(out.read_text())["claim"], claim)
            self.check(out, accepted=True)
            done = self.succeeds("solve", self.dead_normal("-1/10"), "--law", law, "--json", code=1).json()
            self.assertEqual((done["outcome"], done["method"]), ("no-solution", "enumerate"))
            self.succeeds("certify", self.dead_normal("-1/10"), "-o", out, "--law", law)
            self.assertEqual(json.loads(out.read_text())["claim"], "no-solution")
            self.check(out, accepted=True)

    def test_a_proof_that_there_is_no_solution_has_a_budget(self):
        # a1 = f1 - 1, a2 = f1 - f2 - 2: each can be kept up, both as they must not
        problem = self.file("p.json", {
            "format": "stiction-problem", "version": 1, "dimension": 3, "name": "three-programs",
            "contacts": [{"kind": "frictionless"}] * 2, "A": [["1", "0"], ["1", "-1"]], "b": ["-1", "-2"]})
        done = self.succeeds("solve", problem, "--json", code=1).json()
        self.assertEqual((done["outcome"], done["statistics"]), ("no-solution", {"prefixes": 3, "programs": 3}))
        few = self.succeeds("solve", problem, "--method", "enumerate", "--max-pivots", 2, "--json", code=3).json()
        self.assertEqual((few["outcome"], few["reason"]), ("limit", "programs"))

    def test_the_hypothesis_on_b_is_decided(self):
        out = self.folder / "h.json"
        wedge = cli.ROOT / "corpus/space/no-solution-scripted-wedge.json"
        self.succeeds("certify", wedge, "-o", out, "--claim", "h")
        found = json.loads(out.read_text())
        self.assertEqual((found["claim"], found["witness"]["v"], found["witness"]["value"]), ("not-h", ["1", "1", "0"], "-1"))
        self.check(out, accepted=True)
        steep = json.loads(wedge.read_text())
        steep["contacts"][0]["mu"] = "99/100"
        del steep["origin"]
        self.succeeds("certify", self.file("steep.json", steep), "-o", out, "--claim", "h")
        self.assertEqual(json.loads(out.read_text())["claim"], "h")
        self.check(out, accepted=True)

    def test_certify_asks_for_coulombs_law_unless_told(self):
        out, problem = self.folder / "c.json", cli.ROOT / "corpus/space/three-sliding-contacts.json"
        for words, claim in [((), "coulomb-solution"), (("--law", "coulomb"), "coulomb-solution"),
                             (("--law", "baraff"), "solution-exists"), (("--claim", "solution-exists"), "solution-exists"),
                             (("--claim", "existence"), "coulomb-solution")]:
            self.succeeds("certify", problem, "-o", out, *words)
            self.assertEqual(json.loads(out.read_text())["claim"], claim)
            self.check(out, accepted=True)
        self.refuses("certify", problem, "-o", out, "--law", "amontons", says="--law")
        self.refuses("certify", problem, "-o", out, "--law", "baraff", "--claim", "h", says=["--law baraff", "--claim existence", "found h"])
        self.refuses("certify", self.file("plane.json", cli.SOLVED), "-o", out, "--law", "coulomb", says=["dimension", "--law"])

    def test_of_several_solutions_the_one_at_rest(self):
        pinched = cli.ROOT / "corpus/space/capsule-pinched.json"
        for law in ("baraff", "coulomb"):
            done = self.succeeds("solve", pinched, "--law", law, "--json").json()
            f = [Fraction(x) for x in done["f"]]
            self.assertEqual((done["outcome"], set(done["a"]), done["unique_accelerations"]), ("solved", {"0"}, False))
            self.assertEqual(("bound" in done, done.get("bound", "1")), (law == "coulomb", "1"))
            self.assertEqual((f[0] + f[3], f[6] + f[9]), (12, 12))
            self.assertEqual(sum(f[2::3]), Fraction("0.44145"))
            self.assertIn("another solution with other accelerations is known; this one moves less, or rests\n",
                          self.succeeds("solve", pinched, "--law", law).out)
            moving = self.succeeds("solve", pinched, "--law", law, "--method", "complete", "--json").json()
            self.assertNotEqual(set(moving["a"]), {"0"})
            self.assertNotIn("unique_accelerations", moving)

    def test_what_is_not_built_for_space_is_refused(self):
        problem = cli.ROOT / "corpus/space/three-sliding-contacts.json"
        out = self.folder / "c.json"
        self.refuses("solve", problem, "--method", "ipopt", says=["ipopt", "in space", "not built", "complete"])
        self.refuses("solve", problem, "--method", "enumerate", "--arithmetic", "double", says=["enumerate", "in space"])
        self.refuses("solve", problem, "--method", "complete", "--law", "amontons", says="--law")
        self.refuses("certify", problem, "-o", out, "--claim", "counterexample", says=["dimension", "3"])
        self.refuses("certify", problem, "--all", says=["dimension", "3"])
        self.refuses("certify", cli.ROOT / "corpus/two-contact-cycle.json", "-o", out, "--claim", "coulomb-solution",
                     says=["dimension", "in the plane the claim is solution-exists"])


if __name__ == "__main__":
    cli.main()
