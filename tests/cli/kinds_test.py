# SPDX-License-Identifier: Apache-2.0
"""Bilateral constraints (4.5) and sliding contacts (6): every method takes them, and certificates decide."""

import json
import random
import subprocess
import sys
from fractions import Fraction

import cli

FOLDER = cli.ROOT / "corpus" / "sliding"
METHODS = ["baraff", "complete", "lemke", "enumerate", "ipopt"]


def problem_of(contacts, A, b, name="mixed"):
    return {"format": "stiction-problem", "version": 1, "name": name, "dimension": 2, "contacts": contacts,
            "A": [[str(x) for x in row] for row in A], "b": [str(x) for x in b]}


def bordered(problem):
    """With a bilateral contact before and, in twice its units, behind, which leave of it the problem itself."""
    A, b = [list(map(Fraction, row)) for row in problem["A"]], list(map(Fraction, problem["b"]))
    u, bB = [Fraction(i % 3 - 1) for i in range(len(b))], Fraction(-3)
    rows = [[Fraction(2), *u, Fraction(4)]]
    rows += [[x, *(y + x * z / 2 for y, z in zip(row, u)), 2 * x] for x, row in zip(u, A)]
    rows += [[2 * x for x in rows[0]]]
    hinge = {"kind": "bilateral"}
    return problem_of([hinge, *problem["contacts"], hinge], rows,
                      [bB, *(x + y * bB / 2 for x, y in zip(b, u)), 2 * bB], "bordered")


def mixed(draw):
    """Contacts of every kind; A = J J' and b = J c, or anything."""
    contacts = []
    for _ in range(draw.randint(1, 4)):
        kind = draw.choice(["bilateral", "bilateral", "frictionless", "static", "sliding", "static"])
        contact = {"kind": kind}
        if kind in ("static", "sliding"):
            contact["mu"] = str(Fraction(draw.randint(0, 4), 2))
        if kind == "sliding":
            contact["slip"] = draw.choice(["1", "-1"])
        contacts.append(contact)
    rows = sum(2 if "mu" in contact else 1 for contact in contacts)
    columns = draw.randint(1, rows + 1)
    J = [[draw.randint(-2, 2) for _ in range(columns)] for _ in range(rows)]
    if draw.random() < 0.5:  # with two hinges, the same one twice
        J[-1] = [2 * x for x in J[0]]
    A = [[sum(x * y for x, y in zip(row, other)) for other in J] for row in J]
    c = [draw.randint(-3, 3) for _ in range(columns)]
    b = [sum(x * y for x, y in zip(row, c)) for row in J]
    if draw.random() < 0.3:
        A = [[draw.randint(-1, 1) for _ in row] for row in A]
    return problem_of(contacts, A, b)


class Kinds(cli.TestCase):
    def solve(self, name, *options):
        return cli.run("solve", FOLDER / f"{name}.json", "--json", *options)

    def independent(self, certificate):
        return subprocess.run([sys.executable, cli.ROOT / "certify" / "check_certificate.py", certificate],
                              capture_output=True, text=True)

    def certified(self, name):
        certificate = self.folder / f"{name}.json"
        self.succeeds("certify", FOLDER / f"{name}.json", "-o", certificate)
        self.succeeds("check", certificate)
        done = self.independent(certificate)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(certificate.read_text())["claim"]

    def test_every_method_solves_a_hinge_a_slider_and_a_static_contact(self):
        expected = ["-10/21", "16/21", "8/21", "17/21", "-17/21", "0"]  # the second hinge repeats the first
        for method in METHODS:
            with self.subTest(method=method):
                result = self.solve("hinged-slider", "--method", method).json()
                self.assertEqual(result["outcome"], "solved")
                self.assertEqual(result["f"][1:5], expected[1:5])
                self.assertEqual([result["a"][row] for row in (0, 1, 3, 5)], ["0"] * 4)
        self.assertEqual(self.certified("hinged-slider"), "solution-exists")

    def test_doubles_agree(self):
        for method in ("baraff", "complete", "lemke", "fast"):
            with self.subTest(method=method):
                result = self.solve("hinged-slider", "--method", method, "--arithmetic", "double").json()
                self.assertEqual(result["outcome"], "solved")
                self.assertLess(result["residual"], 1e-12)
                self.assertAlmostEqual(result["f"][1], 16 / 21, places=12)

    def test_an_infinite_step_has_an_impulsive_direction_and_no_solution_is_certified(self):
        for name, direction in (("rod-without-solution", ["1", "-2"]), ("smallest-without-solution", ["1", "-1"])):
            for method in ("baraff", "complete", "lemke"):
                with self.subTest(name=name, method=method):
                    done = self.solve(name, "--method", method)
                    self.assertEqual(done.code, 1)
                    self.assertEqual(done.json()["outcome"], "ray")
                    self.assertEqual(done.json()["ray"], direction)
            self.assertEqual(self.certified(name), "no-solution")

    def test_both_solutions_of_the_rod_are_listed(self):
        words = self.succeeds("certify", FOLDER / "rod-with-two-solutions.json", "--all", "--json").json()["words"]
        self.assertEqual([word["f"] for word in words], [["0", "0"], ["25/2", "-25"]])
        self.assertTrue(all(word["unique"] for word in words))

    def test_hinges_that_contradict_each_other_are_singular_and_without_solution(self):
        problem = {"format": "stiction-problem", "version": 1, "name": "two hinges", "dimension": 2,
                   "contacts": [{"kind": "bilateral"}, {"kind": "bilateral"}],
                   "A": [["1", "2"], ["2", "4"]], "b": ["1", "3"]}
        file = self.file("hinges.json", problem)
        for method in ("baraff", "complete", "lemke"):
            done = cli.run("solve", file, "--json", "--method", method)
            self.assertEqual((done.code, done.json()["outcome"]), (1, "singular"))
            self.assertIn("no forces keep the bilateral constraints", done.json()["reason"])
        certificate = self.folder / "hinges.cert.json"
        self.succeeds("certify", file, "-o", certificate)
        self.assertEqual(json.loads(certificate.read_text())["claim"], "no-solution")

    def test_replay_names_the_rows_of_the_file_and_shows_the_forces_of_hinges(self):
        file = FOLDER / "hinged-slider.json"
        out = self.succeeds("replay", file, "--step").out
        for line in ["Contact 1 is bilateral: N1 stays in C, a_N1 = 0 (4.5).", "Contact 2 slides: f_F2 = 1/2 f_N2 (24).",
                     "Before the first drive f = (-1/2, 0, 0, 0, 0, 0), a = (0, -7/2, 2, -4, 9/2, 0)",
                     "  df = (-1/2, 1, 1/2, 0, 0, 0)   da = (0, 3, 3, 1, 0, 0)", "C = {N1 N2 N3 N4}", "NC- = {F3}"]:
            self.assertIn(line, out)
        replay = self.succeeds("replay", file, "--step", "--json").json()
        self.assertEqual([pivot["driven"] for pivot in replay["pivots"]], ["N2", "N3", "F3"])
        self.assertEqual(replay["initial"]["f"][0], "-1/2")
        self.assertEqual(replay["f"], ["-10/21", "16/21", "8/21", "17/21", "-17/21", "0"])
        counts = self.succeeds("replay", file, "--all-policies", "--json").json()["counts"]
        self.assertEqual(counts, {"solved": 1536})
        ray = self.succeeds("replay", FOLDER / "rod-without-solution.json", "--json").json()
        self.assertEqual((ray["outcome"], ray["ray"]), ("ray", ["1", "-2"]))

    def test_a_cycle_beside_hinges_is_certified_minimized_and_refuted_where_it_is_altered(self):
        file, certificate = self.file("bordered.json", bordered(cli.REFERENCE)), self.folder / "certificate.json"
        said = self.succeeds("certify", file, "--claim", "cycle", "--policy", "*", "-o", certificate, code=1).out
        self.assertIn("cycle: disproved: 1,320 of 1,536 policies loop", said)
        self.assertEqual(self.succeeds("check", certificate, "--json").json()[0]["facts"]["policies"], 1320)
        done = self.independent(certificate)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("policies 1320, runs", done.stdout)
        self.succeeds("certify", file, "--claim", "cycle", "-o", certificate)
        stated = json.loads(certificate.read_text())
        run = stated["witness"]["runs"][0]
        self.assertEqual([pivot["step"] for pivot in run["pivots"]][-len(cli.PERIOD):], cli.PERIOD)
        self.assertEqual((run["state"]["sets"]["N1"], run["state"]["sets"]["N4"]), ("C", "C"))
        for place, value in [((0,), "1/7"), ((5,), "1")]:  # forces of the hinges
            altered = json.loads(certificate.read_text())
            altered["witness"]["runs"][0]["state"]["f"][place[0]] = value
            wrong = self.file("wrong.json", altered)
            self.succeeds("check", wrong, code=1)
            self.assertEqual(self.independent(wrong).returncode, 1)
        out = self.folder / "small.json"
        self.succeeds("minimize", file, "-o", out, "--keep-signature")
        self.assertEqual({contact["kind"] for contact in json.loads(out.read_text())["contacts"]}, {"static"})

    def test_the_independent_checker_runs_every_kind_as_replay_does(self):
        sys.path.insert(0, str(cli.ROOT / "certify"))
        from certificate_reader import read_problem
        from check_runs import Ended, Rows, run

        def end_after_1000(steps):
            if len(steps) == 1000:
                raise Ended("limit")

        draw, outcomes = random.Random(45), {}
        hinge = [{"kind": "bilateral"}, {"kind": "frictionless"}]  # whose force, or whose row, another one spoils
        problems = [problem_of(hinge, [[0, 0], [1, 1]], [0, -1]), problem_of(hinge, [[0, 1], [0, 1]], [0, -1])]
        # The hinge without a force is the one whose column depends on those before.
        problems += [problem_of(2 * hinge[:1], [[0, 0], [1, 2]], [0, -1]), problem_of(2 * hinge[:1], [[1, 2], [2, 4]], [1, 3])]
        # Friction along the acceleration of its contact, as only sliding friction can be.
        problems += [problem_of([{"kind": "sliding", "mu": "1", "slip": "1"}], [["2", "0"], ["0", "1"]], ["-1", "-1"])]
        problems += [mixed(draw) for _ in range(60 if cli.ALL else 15)]
        for index, problem in enumerate(problems):
            policy = draw.choice(["paper", "resume=round", "scan=highest,resume=round,file=yes",
                                  "admit=eager,file=yes,apex=suspended", "scan=most-violated,ties=contacts"])
            with self.subTest(index=index, policy=policy, problem=problem):
                replay = cli.run("replay", self.file("p.json", problem), "--policy", policy, "--json").json()
                plain = {key: problem[key] for key in ("format", "version", "dimension", "contacts", "A", "b")}
                found = run(Rows(read_problem(plain)), policy, end_after_1000)
                self.assertEqual(found.outcome, replay["outcome"])
                self.assertEqual(json.loads(json.dumps(found.pivots, default=str)), replay["pivots"])
                if found.outcome == "solved":
                    self.assertEqual([str(x) for x in found.state["f"]], replay["f"])
                key = replay.get("reason", found.outcome)
                outcomes[key] = outcomes.get(key, 0) + 1
        if not cli.ALL:
            return
        self.assertLessEqual({"solved", "ray", "no forces keep the bilateral constraints",
                              "the bilateral constraints are singular"}, set(outcomes), outcomes)

    def test_loops_beside_sliding_contacts_and_what_they_miss(self):
        for name, policies, claim in [("cycle-beside-a-sliding-contact", 1536, "solution-exists"),
                                      ("cycle-of-sliding-contacts", 1536, "no-solution"),
                                      ("cycle-or-ray-without-solution", 576, "no-solution")]:
            with self.subTest(name=name):
                certificate, file = self.folder / "certificate.json", FOLDER / f"{name}.json"
                code = 0 if policies == 1536 else 1
                self.succeeds("certify", file, "--claim", "cycle", "--policy", "*", "-o", certificate, code=code)
                facts = self.succeeds("check", certificate, "--json").json()[0]["facts"]
                self.assertEqual(facts["policies"], policies)
                self.succeeds("certify", file, "--claim", "cycle", "-o", certificate)
                self.assertEqual(self.independent(certificate).returncode, 0)
                self.assertEqual(self.certified(name), claim)

    def test_safety_speaks_of_static_and_frictionless_contacts(self):
        self.refuses("certify", FOLDER / "hinged-slider.json", "--safe",
                     says=["contacts[0].kind: found bilateral", "frictionless or static", "safety"])


if __name__ == "__main__":
    cli.main()
