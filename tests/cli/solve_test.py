# SPDX-License-Identifier: Apache-2.0
"""stiction solve: every method in every arithmetic; what it calls solved is solved, and what it prints is judged."""

import json
import unittest
from fractions import Fraction

import cli

WRONG = Fraction(1, 10**6)


def natural_residual(problem, f):
    """Of planar static contacts, relative."""
    A = [[Fraction(x) for x in row] for row in problem["A"]]
    b = [Fraction(x) for x in problem["b"]]
    a = [sum(x * y for x, y in zip(row, f)) + c for row, c in zip(A, b)]
    r = 1 / max(A[i][i] for i in range(len(b)))
    worst = Fraction(0)
    for i, contact in enumerate(problem["contacts"]):
        n, bound = 2 * i, Fraction(contact["mu"]) * max(Fraction(0), f[2 * i])
        gap = min(f[n + 1] + bound, max(f[n + 1] - bound, r * a[n + 1]))
        worst = max(worst, abs(min(f[n], r * a[n])), abs(gap))
    return worst / max(max(map(abs, f)), r * max(map(abs, b)))


def static(mu, A, b):
    return {"format": "stiction-problem", "version": 1, "name": "p", "dimension": 2,
            "contacts": [{"kind": "static", "mu": m} for m in mu], "A": A, "b": b}


class Solve(cli.TestCase):
    def methods(self, dimension="plane"):
        for method in self.succeeds("methods", "--json").json():
            for arithmetic in method[dimension]:
                yield method["name"], arithmetic

    def solve_everywhere(self, problem, judge=True, share=3):
        """By every method in every arithmetic, or a share of these; how often it was solved and refused."""
        file, solved, refused = self.file("p.json", problem), 0, 0
        for method, arithmetic in cli.share(self.methods(), share):
            with self.subTest(method=method, arithmetic=arithmetic):
                done = cli.run("solve", file, "--method", method, "--arithmetic", arithmetic, "--json")
                self.assertIn(done.code, (0, 1, 2, 3), done.err)
                if done.code == 2:
                    refused += 1
                    self.assertIn(str(file), done.err)
                    continue
                answer = done.json()
                self.assertEqual(done.code == 0, answer["outcome"] == "solved")
                if answer["outcome"] != "solved" or not judge:
                    continue
                solved += 1
                exact = answer["arithmetic"] == "exact"
                self.assertEqual({type(x) for x in answer["f"]}, {str} if exact else {answer["f"][0].__class__})
                f = [Fraction(x) if not isinstance(x, list) else Fraction(sum(map(Fraction, x)), 2) for x in answer["f"]]
                rounded = 1e-3 if arithmetic == "float" else 0  # of the problem itself
                self.assertLess(natural_residual(problem, f), WRONG + Fraction(rounded))
        return solved, refused

    def test_wrong_answers_of_a_search_are_no_longer_called_solved(self):
        for contacts in (2, 3, 6):
            problem = json.loads((cli.ROOT / f"corpus/wrong-in-doubles-{contacts}-contacts.json").read_text())
            solved, _ = self.solve_everywhere(problem, share=1)
            self.assertGreater(solved, 5)

    def test_a_suspicion_is_answered_with_exact_forces(self):
        done = self.succeeds("solve", cli.ROOT / "corpus/wrong-in-doubles-3-contacts.json", "--method", "baraff",
                             "--arithmetic", "double", "--residual", "1e-17", "--json").json()
        self.assertEqual((done["outcome"], done["arithmetic"]), ("solved", "exact"))
        self.assertEqual(done["suspected"]["outcome"], "undecided")
        self.assertTrue(all(isinstance(x, str) for x in done["f"]))

    def test_extreme_friction_and_parallel_contacts(self):
        for mu in ("10000000000000000", "1e-300", "1e300"):
            self.solve_everywhere(static([mu, mu], cli.REFERENCE["A"], cli.REFERENCE["b"]))
        tilt = Fraction(1, 10**10)
        J = [[0, 1], [1, 0], [tilt, 1], [1, -tilt]]
        A = [[str(Fraction(sum(Fraction(x) * y for x, y in zip(p, q)))) for q in J] for p in J]
        self.solve_everywhere(static(["1/2", "1/2"], A, ["-1", "1/3", "-1", "1/3"]))

    def test_units_that_leave_the_range_of_doubles(self):
        for power in (-300, -150, 150, 300):
            A = [[str(Fraction(x) * Fraction(10) ** power) for x in row] for row in cli.REFERENCE["A"]]
            b = [str(Fraction(x) / Fraction(10) ** power) for x in cli.REFERENCE["b"]]
            self.solve_everywhere(static(["1", "1"], A, b), judge=abs(power) < 300)

    def test_numbers_beyond_the_arithmetic_are_refused_by_name(self):
        for place, value, arithmetics in [("A", "1e309", ["float", "double"]), ("A", "1e39", ["float"]),
                                          ("b", "1e309", ["float", "double"]), ("mu", "1e309", ["double"]),
                                          ("b", "-1e-100", ["float"])]:
            problem = static(["1"], [["2", "0"], ["0", "3"]], ["-1", "1"])
            if place == "A":
                problem["A"][1][1] = value
            elif place == "b":
                problem["b"][0] = value
            else:
                problem["contacts"][0]["mu"] = value
            file = self.file("p.json", problem)
            for arithmetic in arithmetics:
                for method, built in cli.share(self.methods(), 2):
                    if built != arithmetic:
                        continue
                    self.refuses("solve", file, "--method", method, "--arithmetic", arithmetic,
                                 says=[file, place, "found", arithmetic])
            self.solve_everywhere(problem, judge=False)

    def test_auto_names_its_method_and_ends_where_the_published_algorithm_loops(self):
        done = self.succeeds("solve", self.file("p.json", cli.REFERENCE), "--json").json()
        self.assertEqual((done["outcome"], done["method"], done["arithmetic"]), ("solved", "complete", "exact"))
        done = self.succeeds("solve", self.file("p.json", cli.REFERENCE), "--arithmetic", "double", "--json").json()
        self.assertEqual((done["outcome"], done["arithmetic"]), ("solved", "double"))

    def test_a_residual_that_is_asked_for_is_met(self):
        file = self.file("p.json", cli.SOLVED)
        done = self.succeeds("solve", file, "--arithmetic", "double", "--residual", "1e-13", "--json").json()
        self.assertLessEqual(done["residual"], 1e-13)
        done = self.succeeds("solve", file, "--method", "fast", "--arithmetic", "double", "--residual", "1e-25", "--json",
                             code=3).json()
        self.assertEqual(done["outcome"], "undecided")

    def test_the_law_of_friction_belongs_to_space(self):
        self.refuses("solve", self.file("p.json", cli.SOLVED), "--law", "coulomb", says=["dimension", "--law"])

    def test_every_path_method_is_replayed(self):
        file = self.file("p.json", cli.REFERENCE)
        for method in ("complete", "lemke"):
            for arithmetic in ("exact", "double", "float"):
                done = self.succeeds("replay", file, "--method", method, "--arithmetic", arithmetic, "--json", "--step")
                replay = done.json()
                self.assertEqual(replay["outcome"], "solved")
                self.assertGreater(len(replay["pivots"]), 2)
                last = replay["pivots"][-1]["f"]
                if arithmetic == "exact":
                    self.assertEqual(last, replay["f"])
                self.succeeds("replay", file, "--method", method, "--arithmetic", arithmetic, "--step")
        out = self.succeeds("replay", file, "--method", "complete", "--step").out
        self.assertIn("a fold", out)
        self.assertIn("the published algorithm gives", out)

    def test_when_the_time_is_up_exact_arithmetic_ends_too(self):
        """Alone a linear program of these numbers takes minutes, as do the assumptions behind it."""
        count = 120
        A = [[30 if i == j else 1 / (7 + i + j) for j in range(count)] for i in range(count)]
        file = self.file("p.json", {"dimension": 2, "contacts": [{"kind": "frictionless"}] * count, "A": A,
                                    "b": [(i % 5 - 3) / 7 for i in range(count)]})
        for method in ("enumerate", "ipopt", "qp"):
            done = cli.run("solve", file, "--json", "--method", method, "--arithmetic", "exact", "--seconds", 0.3, timeout=30)
            answer = done.json()
            if method == "enumerate":
                self.assertEqual((done.code, answer["outcome"], answer["reason"]), (3, "undecided", "stopped"))
            for failed in answer["assumptions"]:
                self.assertEqual(failed["undecided"], "stopped")


class SingularMatrices(cli.TestCase):
    def test_bodies_are_found_of_every_semidefinite_matrix(self):
        # Rounding leaves pivots of these below zero.
        corpus = cli.ROOT / "corpus"
        for name in ("space/cube-rests-on-four-corners", "space/cube-slides-on-four-corners", "sliding/hinged-slider"):
            with self.subTest(name=name):
                answer = self.succeeds("solve", corpus / f"{name}.json", "--method", "newton-bodies", "--json").json()
                self.assertEqual(answer["outcome"], "solved")
                self.assertLess(answer["residual"], 1e-8)
        indefinite = self.file("p.json", {**cli.SOLVED, "A": [["1", "2"], ["2", "1"]]})
        answer = cli.run("solve", indefinite, "--method", "newton-bodies", "--json").json()
        self.assertIn("not symmetric and positive semidefinite", answer["reason"])


if __name__ == "__main__":
    cli.main()
