# SPDX-License-Identifier: Apache-2.0
"""Problems that went wrong (tests/problems): every file has its right value, by statics or over fractions, by every
method and arithmetic that calls it solved."""

import csv
import json
import subprocess
import sys
import unittest
from fractions import Fraction

import cli

PROBLEMS = cli.ROOT / "tests" / "problems"
FLOATING = ["float", "double", "quad"]


def problem_of(name):
    return json.loads((PROBLEMS / f"{name}.json").read_text())


def rows_of(problem):
    """By contact: its normal row."""
    rows, row = [], 0
    for contact in problem["contacts"]:
        rows.append(row)
        row += problem["dimension"] if contact["kind"] in ("static", "sliding") else 1
    return rows


def accelerations(problem, f):
    return [sum((Fraction(x) * y for x, y in zip(row, f)), Fraction(b)) for row, b in zip(problem["A"], problem["b"])]


class Problems(cli.TestCase):
    def solutions(self, name, methods=("auto", "fast", "complete", "lemke"), arithmetics=(*FLOATING, ""), *options):
        """Forces and accelerations, as fractions, of every answer that is called solved; on the problem as given."""
        problem = problem_of(name)
        for method in methods:
            for arithmetic in arithmetics:
                words = ["--arithmetic", arithmetic] if arithmetic else []
                done = cli.run("solve", PROBLEMS / f"{name}.json", "--json", "--method", method, *words, *options)
                if done.code == 2:
                    continue  # not built
                self.assertIn(done.code, (0, 1, 3), done.err)
                answer = done.json()
                if answer["outcome"] != "solved":
                    continue
                f = [Fraction(x) for x in answer["f"]]
                with self.subTest(name=name, method=method, arithmetic=arithmetic or "usual"):
                    yield problem, answer, f, accelerations(problem, f)

    def default(self, name, *options, code=0, **limits):
        return self.succeeds("solve", PROBLEMS / f"{name}.json", "--json", *options, code=code, **limits).json()

    # ---- Free fall -------------------------------------------------------------------------------------------

    def test_a_cube_with_more_friction_than_it_needs_rests(self):
        for name, digits in [("mu1e9-tilt", 5), ("mu3e8-small", 5), ("mu1e7-small", 4)]:
            answers = list(self.solutions(name))
            self.assertTrue(answers, name)
            for problem, _, f, a in answers:
                rows = rows_of(problem)
                self.assertLess(max(map(abs, a)), 10 ** -digits * 10)
                self.assertAlmostEqual(float(sum(f[n] for n in rows)), 9.81, digits - 1)
                for k in (1, 2):
                    self.assertAlmostEqual(float(sum(f[n + k] for n in rows)), -float(Fraction(problem["b"][k])), digits - 1)
            self.assertEqual(self.default(name)["outcome"], "solved")

    def test_its_twin_in_the_plane_rests(self):
        answers = list(self.solutions("plane-mu1e12"))
        self.assertTrue(answers)
        for _, _, _, a in answers:
            self.assertLess(max(map(abs, a)), 1e-4)

    # ---- Mass ratios -----------------------------------------------------------------------------------------

    def test_a_light_contact_does_not_hide_a_heavy_one(self):
        answers = list(self.solutions("mass-ratio-1e6-complete-float", ("auto", "fast", "complete", "lemke", "baraff")))
        self.assertTrue(answers)
        for _, _, f, a in answers:
            self.assertAlmostEqual(float(f[0]), 1_208_134, delta=300)
            self.assertAlmostEqual(float(f[2]), -5.0e5, delta=1e4)
        problem = problem_of("mass-ratio-1e9-baraff-double")
        for _, _, f, a in self.solutions("mass-ratio-1e9-baraff-double", ("baraff", "auto", "complete"), (*FLOATING, ""),
                                         "--max-pivots", "5000", "--max-drives", "2000"):
            for n in rows_of(problem):
                self.assertGreater(float(a[n]), -1e-3)
                if f[n] > 1:
                    self.assertLess(abs(float(a[n])), 1e-3)
        for _, _, f, _ in self.solutions("mass-ratio-auto-double-f-zero"):
            self.assertNotEqual(set(f), {0})

    # ---- Coulomb's law by default ----------------------------------------------------------------------------

    def test_friction_is_opposite_to_the_push_from_any_side(self):
        for name in ["bullet2590-push-37", "bullet2590-push-45"]:
            for problem, answer, f, a in self.solutions(name):
                self.assertEqual(answer["law"], "coulomb")
                rows = rows_of(problem)
                push = [Fraction(problem["b"][k]) for k in (1, 2)]
                friction = [sum(f[n + k] for n in rows) for k in (1, 2)]
                size = sum(float(x) ** 2 for x in friction) ** 0.5
                self.assertAlmostEqual(size, 3, 4)
                self.assertAlmostEqual(float(friction[0] * push[1] - friction[1] * push[0]), 0, 3)
                self.assertLess(friction[0] * push[0] + friction[1] * push[1], 0)
                for n in rows:
                    self.assertAlmostEqual(sum(float(a[n + k]) ** 2 for k in (1, 2)) ** 0.5, 2, 4)
            self.assertEqual(self.default(name)["law"], "coulomb")

    # ---- Escalation ------------------------------------------------------------------------------------------

    def test_a_step_of_an_engine_in_float_is_solved_by_default(self):
        answer = self.default("bullet-float-stack-10-to-1")
        self.assertEqual((answer["outcome"], answer["law"]), ("solved", "coulomb"))
        surveyed = self.succeeds("survey", PROBLEMS / "bullet-float-stack-10-to-1.json", "--json").json()[0]
        self.assertIn("solved", [run["outcome"] for run in surveyed["runs"]])

    # ---- Filtered, exact -------------------------------------------------------------------------------------

    def test_filtered_goes_on_as_exact_does(self):
        file = PROBLEMS / "filtered-says-ray.json"
        for arithmetic in ("exact", "filtered"):
            self.assertEqual(self.default("filtered-says-ray", "--arithmetic", arithmetic)["outcome"], "solved", file)
        scripted = self.file("p.json", {"A": [["1", "-1"], ["-1", "1"]], "b": ["-1", "-1/1125899906842624"],
                                        "contacts": [{"kind": "static", "mu": "1"}], "dimension": 2,
                                        "format": "stiction-problem", "version": 1, "name": "p"})
        for arithmetic in ("exact", "filtered"):
            done = self.succeeds("solve", scripted, "--json", "--arithmetic", arithmetic, code=1)
            self.assertEqual(done.json()["outcome"], "no-solution")

    # ---- What a verdict is about -----------------------------------------------------------------------------

    def answers(self, name, *options):
        """By method and arithmetic, what is answered, with its exit code; refusals left out."""
        for method in ("auto", "fast", "complete", "lemke", "enumerate", "qp", "baraff"):
            for arithmetic in (*FLOATING, ""):
                words = ["--arithmetic", arithmetic] if arithmetic else []
                done = cli.run("solve", PROBLEMS / f"{name}.json", "--json", "--method", method, *words, *options)
                if done.code != 2:
                    self.assertIn(done.code, (0, 1, 3), done.err)
                    with self.subTest(name=name, method=method, arithmetic=arithmetic or "usual"):
                        yield done.json()

    def test_no_rounded_problem_proves_that_the_file_has_no_solution(self):
        for name in ("enumerate-double-no-solution", "false-no-solution", "float-exactly-false"):
            outcomes = [answer["outcome"] for answer in self.answers(name)]
            self.assertNotIn("no-solution", outcomes, name)
            self.assertIn("solved", outcomes, name)

    def test_exact_is_said_of_the_numbers_of_the_file_alone(self):
        for name in ("exact-answer-of-rounded", "exact-answer-of-rounded-lemke", "float-exactly-false"):
            problem = problem_of(name)
            for answer in self.answers(name):
                if answer["arithmetic"] != "exact" or answer["outcome"] != "solved":
                    continue
                f = [Fraction(x) for x in answer["f"]]
                self.assertEqual([Fraction(x) for x in answer["a"]], accelerations(problem, f))

    def test_a_contact_that_sinks_is_not_solved_and_the_right_force_is_found(self):
        found = [f for _, _, f, _ in self.solutions("shadow-three-contacts", ("auto", "fast", "complete", "lemke", "baraff"))]
        self.assertGreater(len(found), 15)
        for f in found:
            self.assertAlmostEqual(float(f[0]), 2.292513301700395e-05, delta=1e-10)

    def test_forces_that_do_no_work_are_solved_over_doubles_too(self):
        answer = self.default("zero-work-unit-inf", "--arithmetic", "double")
        self.assertEqual(answer["outcome"], "solved")
        self.assertEqual([round(x, 9) for x in answer["f"]], [0.33, 0, 0.033])
        for verb in ("explain", "survey"):
            self.succeeds(verb, PROBLEMS / "zero-work-unit-inf.json", "--json")

    def test_a_quadratic_program_asks_whether_the_file_is_convex(self):
        for arithmetic in ("float", "double", "exact"):
            self.assertEqual(self.default("qp-float-psd-refused", "--method", "qp", "--arithmetic", arithmetic)["outcome"],
                             "solved")
        answer = self.default("qp-double-space", "--method", "qp", "--arithmetic", "double")
        self.assertEqual((answer["outcome"], [round(x, 6) for x in answer["f"]]), ("solved", [0.5, 0]))

    def test_the_law_of_the_paper_is_not_answered_by_another_in_silence(self):
        self.refuses("solve", PROBLEMS / "mujoco3328-pinch-12N.json", "--law", "baraff", "--method", "complete", "--arithmetic",
                     "double", says=["--law baraff", "--arithmetic exact"])

    # ---- Not unique, not in range ----------------------------------------------------------------------------

    def test_of_two_solutions_the_one_at_rest_is_told(self):
        answer = self.default("mujoco3328-pinch-12N")
        self.assertIs(answer["unique_accelerations"], False)
        self.assertEqual({Fraction(x) for x in answer["a"]}, {0})
        f = [Fraction(x) for x in answer["f"]]
        self.assertEqual((f[0] + f[3], f[6] + f[9]), (12, 12))
        self.assertEqual(sum(f[k] for k in (2, 5, 8, 11)), Fraction("0.44145"))
        self.assertNotIn("unique_accelerations", self.default("bullet2590-push-37"))

    def test_programs_whose_equations_are_singular_by_themselves(self):
        for arithmetic in ("exact", "double"):
            self.assertEqual(self.default("lp-4-8", "--arithmetic", arithmetic)["outcome"], "solved")
        # N bridges of diodes beside one resistor: v = 7 / (1.01 + 8 N / 500).
        for bridges in (4, 5):
            for arithmetic in ("exact", "double"):
                f = self.default(f"bridges-{bridges}", "--arithmetic", arithmetic, timeout=10)["f"]
                self.assertAlmostEqual(float(Fraction(f[0])), 7 / (1.01 + 8 * bridges / 500), 9)

    def test_every_row_of_the_cascade_answers_a_problem(self):
        """(certify/request/cascade.cpp), where an arithmetic has several."""
        double, filtered, corpus = "double", "filtered", cli.ROOT / "corpus"
        for row, file, asked, method, arithmetic, suspected in [
            ("factors", PROBLEMS / "grip-mu-0.03.json", double, "interior-point", "double", None),
            ("space", corpus / "space" / "cycle-under-both-slips.json", double, "fast", "double", None),
            ("plane", corpus / "cycle-every-policy-mu-1.json", double, "fast", "double", None),
            ("singular", self.file("held.json", '{"contacts": [{"kind": "bilateral"}, {"kind": "static", "mu": 1}], '
                                   '"A": [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], "b": [-1, 2, 0.5]}'), double, "proximal", "double",
             None),
            ("quad in the plane", PROBLEMS / "over-quad.json", double, "fast", "quad", "undecided"),
            ("quad in space", PROBLEMS / "over-quad-in-space.json", double, "fast", "quad", "undecided"),
            ("filtered", corpus / "cycle-every-policy-mu-1.json", filtered, "complete", "filtered", None),
            ("filtered, many rows", self.file("rows.json", json.dumps({
                "A": [[4 * (i == j) + 1 for j in range(20)] for i in range(20)], "b": [-1] * 20, "mu": 1, "dimension": 2})),
             filtered, "fast", "filtered", None),
            ("exact behind it", corpus / "no-solution-zero-matrix.json", filtered, "enumerate", "exact", None),
        ]:
            with self.subTest(row=row):
                answer = cli.run("solve", file, "--json", "--arithmetic", asked).json()
                self.assertEqual((answer["method"], answer["arithmetic"]), (method, arithmetic))
                self.assertEqual(answer.get("suspected", {}).get("outcome"), suspected)

    def test_what_doubles_do_not_solve_quad_does(self):
        for name in ("over-quad", "over-quad-in-space"):
            found = list(self.solutions(name, ("auto",), ("double",)))
            self.assertEqual(len(found), 1)
            problem, _, f, a = found[0]
            for i, row in enumerate(problem["A"]):
                size = sum(abs(Fraction(x) * y) for x, y in zip(row, f))
                self.assertLessEqual(abs(a[i]), Fraction("1e-8") * abs(Fraction(problem["b"][i])) + Fraction("9e-16") * size)

    def test_of_two_slips_the_one_that_moves_less_is_told(self):
        answer = self.default("grip-mu-0.03")
        self.assertIs(answer["unique_accelerations"], False)
        problem, a = problem_of("grip-mu-0.03"), [float(Fraction(x)) for x in answer["a"]]
        f = [float(Fraction(x)) for x in answer["f"]]
        for n in rows_of(problem):
            self.assertAlmostEqual(f[n], 3.75, 6)
            self.assertAlmostEqual(f[n + 2], 0.1125, 6)
            self.assertAlmostEqual(a[n + 1], 0, 6)
            self.assertAlmostEqual(a[n + 2], -0.81, 6)

    def test_other_axes_change_no_verdict(self):
        for words in (["solve", "-j"], ["solve", "-j", "-m", "complete"], ["certify", "-o", self.folder / "c.json", "--json"]):
            told = [cli.run(words[0], PROBLEMS / f"{name}.json", *words[1:]).json() for name in ("rota", "rotb")]
            for key in ("outcome", "state", "claim"):
                self.assertEqual(told[0].get(key), told[1].get(key), words)

    def test_a_row_of_zeros_has_a_solution_or_a_proof_that_there_is_none(self):
        self.assertEqual(self.default("dart892-dead-normal")["outcome"], "solved")
        self.assertEqual(self.default("dart892-dead-normal-approaching", code=1)["outcome"], "no-solution")
        for name, claim in [("dart892-dead-normal", "coulomb-solution"), ("dart892-dead-normal-approaching", "no-solution")]:
            certificate = self.folder / "certificate.json"
            self.succeeds("certify", PROBLEMS / f"{name}.json", "-o", certificate)
            self.assertEqual(json.loads(certificate.read_text())["claim"], claim)
            self.succeeds("check", certificate)
            checker = [sys.executable, str(cli.ROOT / "certify" / "check_certificate.py"), str(certificate)]
            self.assertEqual(subprocess.run(checker, capture_output=True).returncode, 0)

    # ---- What was right and stays so -------------------------------------------------------------------------

    def test_two_coefficients_at_a_contact_can_be_said(self):
        self.assertEqual(self.default("dart7-split_84")["outcome"], "solved")

    def test_a_wall_holds_what_is_pressed_against_it(self):
        self.assertEqual({Fraction(x) for x in self.default("genesis2872-wall")["a"]}, {0})

    def energies(self, name):
        folder = self.folder / name
        self.succeeds("simulate", PROBLEMS / f"{name}.json", "-o", folder, timeout=600)
        with open(folder / "energy.csv") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def test_a_box_that_is_pushed_rests_whatever_mu_is(self):
        for frame in self.energies("mu-1e9-box-pushed"):
            self.assertLess(frame["kinetic_J"], 1e-6)
            self.assertAlmostEqual(frame["total_J"], 5, 2)

    def test_scenes_of_other_engines_users_end_as_mechanics_says(self):
        # 6 m/s against mu g = 4.905: it stops, and after that has no energy of motion; likewise 5 m/s against 2.
        for name in ["genesis3126-cube-6mps", "jolt983-sliding-box-yaw"]:
            self.assertLess(self.energies(name)[-1]["kinetic_J"], 1e-6, name)
        loop = self.energies("gazebo2608-loop")
        self.assertLess(abs(loop[-1]["total_J"] / loop[0]["total_J"] - 1), 3e-4)


if __name__ == "__main__":
    cli.main()
