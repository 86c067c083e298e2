# SPDX-License-Identifier: Apache-2.0
"""Problems in factors J, M, w, c: every verb takes them, they are the problem that A and b say, and large ones are solved
without A."""

import json
import subprocess
import sys
from fractions import Fraction

import cli

SCENES = cli.ROOT / "corpus/scenes"
# Two blocks on each other; the second mass is one block of two velocities that act on each other.
FACTORS = {"J": [[0, 1, 0, 0], [1, 0, 0, 0], [0, -1, 0, 1], [-1, 0, 1, 0]],
           "M": ["2", 2, [["1/2", "1/8"], ["1/8", "1/2"]]], "w": [0, "-9.81", 1, "-9.81"]}
STACK = {"factors": FACTORS, "mu": ["1/2", "0.3"]}


def product(A, B):
    return [[sum((x * y for x, y in zip(row, column)), Fraction(0)) for column in zip(*B)] for row in A]


def formed(factors):
    """A and b, here, of rows J and blocks M of one or two velocities."""
    J = [[Fraction(x) for x in row] for row in factors["J"]]
    size, at = len(J[0]), 0
    W = [[Fraction(0)] * size for _ in range(size)]
    for block in factors["M"]:
        if not isinstance(block, list):
            W[at][at] = 1 / Fraction(block)
            at += 1
            continue
        (p, q), (r, s) = [[Fraction(x) for x in row] for row in block]
        determinant = p * s - q * r
        W[at][at], W[at][at + 1], W[at + 1][at], W[at + 1][at + 1] = (x / determinant for x in (s, -q, -r, p))
        at += 2
    A = product(product(J, W), list(zip(*J)))
    b = [sum((x * Fraction(w) for x, w in zip(row, factors["w"])), Fraction(c))
         for row, c in zip(J, factors.get("c", [0] * len(J)))]
    return {"A": [[str(x) for x in row] for row in A], "b": [str(x) for x in b]}


def wall(columns, rows, mu="1/2"):
    """Blocks of two corners that stand on two others, or on the floor; planar, a unit of mass each, as sparse factors.
    Velocities of a block are x, y, spin; a corner is half a width to either side, half a height below."""
    entries, row = [], 0

    def corner(x, y, spin, block, sign):  # of the normal and the tangent of a contact, at (x, y) from the middle
        if block is not None:
            for at, column, value in ((0, 1, 1), (0, 2, x), (1, 0, 1), (1, 2, -y)):
                entries.append([row + at, 3 * block + column, str(sign * value)])

    for level in range(rows):
        for k in range(columns):
            block = level * columns + k
            for side in (-1, 1):
                below = None if level == 0 else (level - 1) * columns + k
                corner(side, -1, 0, block, 1)
                corner(side, 1, 0, below, -1)
                row += 2
    count = columns * rows
    return {"factors": {"J": {"size": [row, 3 * count], "entries": [e for e in entries if e[2] != "0"]},
                        "M": ["1"] * (3 * count), "w": ["0", "-10", "0"] * count},
            "mu": [mu] * (row // 2), "dimension": 2}


def space_wall(layers, **changes):
    """The lowest layers of a wall in space: of two nine bricks and 156 rows, of three 14 and 252."""
    scene = json.loads((SCENES / "large/brick-wall-in-space.json").read_text())
    kept = ("floor", *(f"brick-{layer + 1}-" for layer in range(layers)))
    low = [body for body in scene["bodies"] if body["name"].startswith(kept)]
    return {**scene, "bodies": low, **changes}


class Case(cli.TestCase):
    def both(self):
        """A problem in factors, and the same in A and b."""
        return self.file("factored.json", STACK), self.file("dense.json", {**formed(FACTORS), "mu": STACK["mu"]})

    def assembled(self, scene, *options):
        out = self.folder / "assembled.json"
        self.succeeds("assemble", SCENES / scene, "-o", out, *options)
        text = out.read_text()
        out.unlink()
        return self.file(f"{'-'.join(options).strip('-') or 'dense'}.json", text)


class Verbs(Case):
    def test_they_say_the_same_problem_exactly(self):
        factored, dense = self.both()
        certificate = self.folder / "certificate.json"
        self.succeeds("certify", dense, "-o", certificate)
        self.succeeds("check", certificate, "--problem", factored)
        answers = [self.succeeds("solve", file, "--json").json() for file in (factored, dense)]
        self.assertEqual(answers[0], answers[1])
        self.assertEqual(answers[0]["arithmetic"], "exact")

    def test_every_verb_takes_them(self):
        factored, _ = self.both()
        out, minimized = self.folder / "out", self.folder / "minimized"
        for call in (["solve"], ["replay"], ["certify", "-o", out], ["certify", "--safe"], ["certify", "--all"],
                     ["survey"], ["explain"], ["import", "-o", out], ["export", "--format", "fclib", "--round", "-o", out]):
            with self.subTest(verb=call[0]):
                done = cli.run(call[0], factored, *call[1:])
                self.assertEqual((done.code, done.err), (0, ""))

    def test_import_writes_them_back_as_they_are(self):
        factored, _ = self.both()
        out, again = self.folder / "out.json", self.folder / "again.json"
        self.succeeds("import", factored, "-o", out)
        written = json.loads(out.read_text())
        self.assertNotIn("A", written)
        self.assertEqual(written["factors"]["M"], ["2", "2", [["1/2", "1/8"], ["1/8", "1/2"]]])
        self.assertEqual(written["factors"]["J"]["size"], [4, 4])
        self.succeeds("import", out, "-o", again)
        self.assertEqual(json.loads(again.read_text())["factors"], written["factors"])

    def test_what_is_wrong_is_told_by_its_block(self):
        wrong = {**STACK, "factors": {**FACTORS, "M": [2, -2, [[1, 2], [0, 1]]]}, "b": [0]}
        self.refuses("solve", self.file("wrong.json", wrong), says=["b: found b beside factors", "factors.M[2]: found"])
        wrong = {**STACK, "factors": {**FACTORS, "M": [2, -2, [[1, 2], [2, 1]]]}}
        self.refuses("solve", self.file("wrong.json", wrong), says=["factors.M[1]: found a block that is not positive "
                                                                    "definite", "factors.M[2]: found a block"])


class Assembled(Case):
    def test_a_scene_in_factors_is_its_problem(self):
        for scene in ("block-in-a-valley.json", "stack.json", "double-pendulum.json", "space/table.json"):
            with self.subTest(scene=scene):
                factored, dense = self.assembled(scene, "--factors"), self.assembled(scene)
                self.assertIn("factors", json.loads(factored.read_text()))
                certificate = self.folder / "certificate.json"
                self.succeeds("certify", dense, "-o", certificate, "--claim", "symmetric")
                self.succeeds("check", certificate, "--problem", factored)

    def test_walls_are_solved_by_bodies_and_the_gate_agrees(self):
        for scene, method in (("large/brick-wall.json", "newton-bodies"),
                              ("large/brick-wall-in-space.json", "interior-point")):
            with self.subTest(scene=scene):
                factored, dense = self.assembled(scene, "--factors"), self.assembled(scene)
                answer = self.succeeds("solve", factored, "--json").json()
                self.assertEqual((answer["outcome"], answer["method"]), ("solved", method))
                self.assertLessEqual(answer["residual"], 1e-8)
                self.assertEqual(answer["assumptions"], [])
                # Rounded, A is not semidefinite, and a hundred contacts touch without a force.
                other = self.succeeds("solve", dense, "--json").json()
                self.assertEqual(other["outcome"], "solved")
                self.assertLessEqual(other["residual"], 1e-8)


class Large(Case):
    def test_thousands_of_contacts_are_solved_without_a_and_forces_hold_the_weight(self):
        columns, rows = 40, 40  # 3200 contacts, 6400 rows
        file = self.file("wall.json", wall(columns, rows))
        answer = self.succeeds("solve", file, "--json").json()
        self.assertEqual((answer["outcome"], answer["method"]), ("solved", "newton-bodies"))
        self.assertIn("A is not formed", answer["why"])
        self.assertEqual(answer["assumptions"], [])
        f = answer["f"]
        self.assertEqual(len(f), 4 * columns * rows)
        self.assertAlmostEqual(sum(f[0:4 * columns:2]), 10 * columns * rows, delta=1e-6)  # of the floor
        for level in range(rows):
            at = 4 * columns * level
            self.assertAlmostEqual(sum(f[at:at + 4 * columns:2]), 10 * columns * (rows - level), delta=1e-6)
        self.refuses("solve", file, "--method", "complete", says=["6400", "at most 4000 with --method complete"])
        self.refuses("certify", file, "-o", self.folder / "out", says="6400")

    def test_the_best_forces_are_told_with_their_errors_when_the_time_is_up(self):
        file = self.file("wall.json", wall(40, 40, mu="1/10"))
        done = cli.run("solve", file, "--json", "--seconds", 0.4, "--residual", 1e-12)
        answer = done.json()
        if answer["outcome"] == "solved":  # a quick machine
            self.assertLessEqual(answer["residual"], 1e-12)
            return
        self.assertEqual((done.code, answer["outcome"], answer["reason"][:7]), (3, "undecided", "stopped"))
        if answer["reason"] == "stopped while the file was read":  # a slow one
            return
        self.assertEqual(len(answer["f"]), 6400)
        self.assertGreater(answer["residual"], 1e-12)

    def test_a_residual_of_1e_12_is_held(self):
        answer = self.succeeds("solve", self.file("wall.json", wall(12, 12)), "--json", "--residual", 1e-12,
                               "--method", "newton-bodies").json()
        self.assertEqual(answer["outcome"], "solved")
        self.assertLessEqual(answer["residual"], 1e-12)


class Methods(Case):
    def test_newton_bodies_takes_a_dense_semidefinite_problem_too(self):
        _, dense = self.both()
        answer = self.succeeds("solve", dense, "--json", "--method", "newton-bodies").json()
        self.assertEqual((answer["outcome"], answer["arithmetic"]), ("solved", "double"))
        asymmetric = {"A": [[1, 0.5], [0, 1]], "b": [-1, 0], "mu": 1}
        done = cli.run("solve", self.file("asymmetric.json", asymmetric), "--json", "--method", "newton-bodies")
        self.assertEqual(done.code, 3)
        self.assertIn("A is not symmetric and positive semidefinite", done.json()["reason"])

    def test_two_coefficients_a_contact_are_one_where_the_second_axis_is_scaled(self):
        """The example of corpus/formats/problems.md, and its law unscaled, with any s."""
        for mu1, mu2, push in ((Fraction(1, 2), Fraction(1, 4), Fraction(17, 2)), (Fraction(1, 3), Fraction(2), Fraction(30))):
            s = mu2 / mu1
            problem = {"A": [["1", "0", "0"], ["0", "1", "0"], ["0", "0", str(s * s)]],
                       "b": ["-10", "0", str(s * push)], "mu": str(mu1)}
            answer = self.succeeds("solve", self.file("two.json", problem), "--json").json()
            self.assertEqual(answer["outcome"], "solved")
            fN, f1, f2 = (Fraction(x) for x in answer["f"])
            aF = Fraction(answer["a"][2])
            self.assertEqual((fN, f1), (10, 0))
            self.assertEqual((s * f2, aF / s), (-mu2 * 10, push - mu2 * 10))


class Certified(Case):
    def test_what_factors_prove_is_certified_by_them(self):
        factored = self.assembled("large/brick-wall.json", "--factors")
        certificate = self.folder / "certificate.json"
        for claim in ("psd", "in-range", "h", "exists"):
            with self.subTest(claim=claim):
                self.succeeds("certify", factored, "-o", certificate, "--claim", claim)
                written = json.loads(certificate.read_text())
                self.assertEqual((written["claim"], list(written["witness"])), (claim, ["factors"]))
                self.succeeds("check", certificate, "--problem", factored)

    def test_forces_of_walls_in_space_are_proved_at_rest_and_where_they_slide(self):
        """In the modes that doubles end in; both checkers take them; of the scene as of its factors."""
        rests, slides = space_wall(2), space_wall(3, gravity=[6, 2, -10])
        for scene, claim, word, bound in ((rests, "existence", "coulomb-solution", 1), (rests, "rests", "rests", None),
                                          (slides, "existence", "coulomb-solution", Fraction(1 - 1e-12))):
            file, factors = self.file("scene.json", scene), self.folder / "factors.json"
            self.succeeds("assemble", file, "--factors", "-o", factors)
            texts = []
            for source in (file, factors):
                out = self.folder / "certificate.json"
                self.succeeds("certify", source, "-o", out, "--claim", claim)
                texts.append(out.read_text())
                self.succeeds("check", out, "--problem", file)
                checker = [sys.executable, cli.ROOT / "certify/check_certificate.py", out]
                self.assertEqual(subprocess.run(checker, capture_output=True).returncode, 0)
            self.assertEqual(texts[0], texts[1])
            written = json.loads(texts[0])
            self.assertEqual(written["claim"], word)
            if bound:
                self.assertGreaterEqual(Fraction(written["witness"]["bound"]), bound)
            for number in written["witness"]["f"] if scene is rests else ():
                self.assertLess(len(number), 60)

    def test_a_scene_is_solved_as_its_factors_are(self):
        for scene, options in ((space_wall(2), []), (space_wall(2), ["--arithmetic", "exact"]),
                               (space_wall(3, gravity=[6, 2, -10]), [])):
            with self.subTest(gravity=scene["gravity"], options=options):
                file, factors = self.file("scene.json", scene), self.folder / "factors.json"
                self.succeeds("assemble", file, "--factors", "-o", factors)
                answers = [self.succeeds("solve", source, "--json", *options).json() for source in (file, factors)]
                self.assertEqual(answers[0], answers[1])
                self.assertEqual((answers[0]["outcome"], answers[0]["method"]), ("solved", "interior-point"))

    def test_velocities_that_no_row_touches_are_left_out(self):
        J = [[*row[:2], 0, *row[2:], 0] for row in FACTORS["J"]]
        M, w = [*FACTORS["M"][:2], 7, FACTORS["M"][2], "1/3"], [*FACTORS["w"][:2], 5, *FACTORS["w"][2:], 6]
        beside = self.file("beside.json", {**STACK, "factors": {"J": J, "M": M, "w": w}})
        certificate = self.folder / "certificate.json"
        for claim in ("psd", "in-range", "h", "exists"):
            with self.subTest(claim=claim):
                self.succeeds("certify", beside, "-o", certificate, "--claim", claim)
                written = json.loads(certificate.read_text())["witness"]["factors"]
                self.assertEqual((written["J"]["size"], written["w"]), ([4, 4], ["0", "-981/100", "1", "-981/100"]))
                self.succeeds("check", certificate, "--problem", beside)

    def test_c_outside_of_the_dual_cone_is_decided_otherwise(self):
        for c, claim, keys in ((["1", "0", "0", "0"], "h", ["factors"]), (["0", "1", "0", "0"], "h", ["y"])):
            problem = {**STACK, "factors": {**FACTORS, "c": c}}
            certificate = self.folder / "certificate.json"
            self.succeeds("certify", self.file("c.json", problem), "-o", certificate, "--claim", claim)
            self.assertEqual(list(json.loads(certificate.read_text())["witness"]), keys)


if __name__ == "__main__":
    cli.main()
