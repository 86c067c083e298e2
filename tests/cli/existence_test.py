# SPDX-License-Identifier: Apache-2.0
"""Existence of every corpus problem, decided by the program, accepted by both checkers; methods side by side."""

import json
import pathlib
import sys

import cli

SOURCES = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCES / "certify"))
from certificate_reader import Rejected, check, load  # noqa: E402
from check_certificate import CLAIMS  # noqa: E402
NO_SOLUTION = {"no-solution-scripted-wedge", "no-solution-zero-matrix"}


class Existence(cli.TestCase):
    def problems(self):
        found = sorted((SOURCES / "corpus").glob("*.json"))
        self.assertGreater(len(found), 20)
        return found

    def test_every_problem_of_the_corpus_is_decided_and_both_checkers_agree(self):
        for problem in self.problems():
            with self.subTest(problem=problem.name):
                certificate = self.folder / f"{problem.stem}.certificate.json"
                self.succeeds("certify", problem, "-o", certificate)
                claim = json.loads(certificate.read_text())["claim"]
                self.assertEqual(claim, "no-solution" if problem.stem in NO_SOLUTION else "solution-exists")
                self.succeeds("check", certificate)
                self.assertTrue(check(load(certificate), CLAIMS).startswith(claim))

    def test_complete_driving_and_lemke_solve_what_the_published_algorithm_loops_on(self):
        for problem in self.problems():
            for method in ("complete", "lemke", "enumerate", "ipopt"):
                with self.subTest(problem=problem.name, method=method):
                    done = cli.run("solve", problem, "--method", method, "--json")
                    if problem.stem in NO_SOLUTION:
                        ends = {"enumerate": (1, "no-solution"), "ipopt": (3, "undecided")}.get(method, (1, "ray"))
                        self.assertEqual((done.code, done.json()["outcome"]), ends)
                    else:
                        self.assertEqual((done.code, done.json()["outcome"]), (0, "solved"))

    def test_that_there_is_no_solution_is_an_outcome_where_it_is_proved(self):
        problems = [SOURCES / f"corpus/{name}.json" for name in (*NO_SOLUTION, "sliding/cycle-of-sliding-contacts")]
        for problem in problems:
            for options in ((), ("--method", "enumerate"), ("--method", "enumerate", "--arithmetic", "double")):
                with self.subTest(problem=problem.name, options=options):
                    done = self.succeeds("solve", problem, *options, "--json", code=1).json()
                    self.assertEqual((done["outcome"], done["method"], done["f"]), ("no-solution", "enumerate", None))
                    self.assertIn("no mode", done["reason"])
            self.assertTrue(self.succeeds("solve", problem, code=1).out.startswith("no-solution: no forces meet all conditions, proved"))
        wedge = SOURCES / "corpus/no-solution-scripted-wedge.json"  # takes three linear programs
        done = self.succeeds("solve", wedge, "--method", "enumerate", "--max-pivots", 1, "--json", code=3).json()
        self.assertEqual(done["outcome"], "limit")  # nothing is proved
        # The proof keeps the direction of the infinite step that was met before it.
        rod = SOURCES / "corpus/sliding/rod-without-solution.json"
        done = self.succeeds("solve", rod, "--json", code=1).json()
        self.assertEqual((done["outcome"], done["ray"]), ("no-solution", ["1", "-2"]))

    def test_doubles_agree_with_exact_numbers(self):
        for problem in self.problems():
            if problem.stem in NO_SOLUTION or problem.stem.startswith("wrong-in-doubles"):  # nearly degenerate
                continue
            with self.subTest(problem=problem.name):
                exact = cli.run("solve", problem, "--method", "complete", "--json").json()
                double = cli.run("solve", problem, "--method", "complete", "--arithmetic", "double", "--json").json()
                self.assertEqual(double["outcome"], "solved")
                self.assertLess(double["residual"], 1e-8)
                self.assertEqual(double["word"], exact["word"])

    def test_all_lists_every_solution_of_the_contact_with_three(self):
        done = self.succeeds("certify", SOURCES / "corpus/three-solutions-one-contact.json", "--all", "--json")
        found = {tuple(word["f"]) for word in done.json()["words"]}
        self.assertEqual(found, {("0", "0"), ("3", "-2"), ("1", "-1")})

    def test_safety_of_the_reference_problem(self):
        problem = SOURCES / "corpus/two-contact-cycle.json"
        certificate = self.folder / "unsafe.json"
        done = self.succeeds("certify", problem, "--safe", "-o", certificate, "--json").json()
        self.assertEqual((done["safe"], done["threshold"]["low"], done["threshold"]["high"]), (False, "1/3", "1/3"))
        self.assertEqual(json.loads(certificate.read_text())["claim"], "unsafe")
        self.succeeds("check", certificate)
        check(load(certificate), CLAIMS)

    def test_a_condition_number_that_shows_safety_is_accepted_by_both_checkers_or_undecided(self):
        small = self.folder / "small.certificate.json"
        self.succeeds("certify", SOURCES / "corpus/safe-by-condition.json", "--claim", "safe-by-condition", "-o", small)
        self.succeeds("check", small)
        contacts = 10  # 4^10 words
        rows = 2 * contacts
        A = [["4" if i == j else "1" if abs(i - j) == 1 else "0" for j in range(rows)] for i in range(rows)]
        document = {"format": "stiction-problem", "version": 1, "name": "chain", "dimension": 2,
                    "contacts": [{"kind": "static", "mu": "1/2"}] * contacts, "A": A, "b": ["-1"] * rows}
        problem, certificate = self.folder / "chain.json", self.folder / "chain.certificate.json"
        problem.write_text(json.dumps(document))
        told = self.succeeds("certify", problem, "--safe", "-o", certificate, "--json").json()
        self.assertIs(told["safe"], True)
        self.assertNotIn("threshold", told)
        self.assertEqual(json.loads(certificate.read_text())["claim"], "safe-by-condition")
        self.succeeds("check", certificate)
        check(load(certificate), CLAIMS)
        for key, value in (("least", "5"), ("most", "1"), ("most", "100000"), ("scaling", ["1"] * (rows - 1))):
            false = json.loads(certificate.read_text())
            false["witness"][key] = value
            with self.assertRaises(Rejected):
                check(false, CLAIMS)

        document["contacts"] = [{"kind": "static", "mu": "50"}] * contacts
        problem.write_text(json.dumps(document))
        done = self.succeeds("certify", problem, "--safe", code=3)
        self.assertIn("too many words", done.out)
        self.assertIn("its condition alone: safe for uniform mu <= ", done.out)
        done = self.succeeds("certify", problem, "--claim", "safe-by-condition", "-o", certificate)
        self.assertIn("safe-by-condition: disproved, unsafe: ", done.out)

    def test_a_sliding_contact_without_a_solution(self):
        problem = self.folder / "rod.json"
        problem.write_text(json.dumps({
            "format": "stiction-problem", "version": 1, "name": "rod", "dimension": 2,
            "contacts": [{"kind": "sliding", "mu": "2", "slip": "1"}],
            "A": [["8/5", "6/5"], ["6/5", "17/5"]], "b": ["-10", "0"]}))
        certificate = self.folder / "rod.certificate.json"
        self.succeeds("certify", problem, "-o", certificate)
        self.assertEqual(json.loads(certificate.read_text())["claim"], "no-solution")
        self.succeeds("check", certificate)
        check(load(certificate), CLAIMS)


if __name__ == "__main__":
    cli.main()
