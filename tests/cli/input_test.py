# SPDX-License-Identifier: Apache-2.0
"""What FILE may be: every form in every verb, what may be left out, refusals that name all faults and the next step."""

import json
import re
import sqlite3
from fractions import Fraction

import cli

SHORT = {"A": cli.SOLVED["A"], "b": cli.SOLVED["b"], "mu": "1"}
FORCES = ["1/2", "-1/3"]
DAT = "2 1 0 2 2 2 2\n2 0\n0 3\n-1 1\n1\n"  # the same problem
SCENE = cli.ROOT / "corpus/scenes/block-in-a-valley.json"
PAGE = cli.ROOT / "corpus/formats/problems.md"


class Case(cli.TestCase):
    def forces(self, file):
        return self.succeeds("solve", file, "--method", "complete", "--json").json()["f"]

    def forms(self):
        """The problem in every form that a file has."""
        short, whole = self.file("short.json", SHORT), self.file("whole.json", cli.SOLVED)
        dat, hdf5 = self.file("problem.dat", DAT), self.folder / "problem.hdf5"
        self.succeeds("export", whole, "-o", hdf5, "--format", "fclib")
        return [short, whole, dat, hdf5]


class Forms(Case):
    def test_every_verb_takes_every_form(self):
        out, minimized = self.folder / "out", self.folder / "minimized"
        for file in [*self.forms(), SCENE]:
            for call in (["solve"], ["replay", "--max-drives", 20], ["certify", "-o", out], ["certify", "--safe"],
                         ["minimize", "-o", minimized], ["survey"], ["import", "-o", out]):
                with self.subTest(verb=call[0], file=file.name):
                    done = cli.run(call[0], file, *call[1:])
                    self.assertIn(done.code, (0, 1), done.err)  # 1: the block in the valley makes it loop
                    self.assertEqual(done.err, "")

    def test_every_form_is_the_same_problem(self):
        self.assertEqual([self.forces(file) for file in self.forms()], [FORCES] * 4)

    def test_export_and_check_take_every_form(self):
        certificate = self.folder / "certificate.json"
        self.succeeds("certify", self.file("whole.json", cli.SOLVED), "-o", certificate)
        for file in self.forms():
            self.succeeds("export", file, "-o", self.folder / "out", "--format", "siconos-fc")
            self.succeeds("check", certificate, "--problem", file)

    def test_content_decides_not_the_ending(self):
        self.assertEqual(self.forces(self.file("a.txt", DAT)), FORCES)
        self.assertEqual(self.forces(self.file("b.dat", json.dumps(SHORT))), FORCES)

    def test_a_finding_is_taken_from_its_store_by_its_signature_or_how_that_begins(self):
        store = self.folder / "a.store"
        self.succeeds("search", "--generator", "bodies", "--contacts", 2, "--mu", 1, "--problems", 20000,
                      "--store", store, "--finishing", 100)
        db = sqlite3.connect(store)
        rows = db.execute("SELECT signature, problem, minimized FROM findings WHERE kind = 'cycle'").fetchall()
        db.close()
        signature, problem, minimized = rows[0]
        written = self.folder / "finding.json"
        self.succeeds("import", f"{store}:{signature}", "-o", written)
        self.assertEqual(json.loads(written.read_text())["A"], json.loads(minimized or problem)["A"])
        self.assertEqual(self.succeeds("replay", f"{store}:{signature}", "--json").json()["outcome"], "cycle")
        self.assertEqual(self.succeeds("problem", store, signature).json()["A"], json.loads(minimized or problem)["A"])
        self.refuses("problem", store, signature, 1, says="goes without INDEX")
        self.refuses("solve", store, says=["found a store", f"{store}:FINDING", "report"])
        self.refuses("solve", f"{store}:nosuch", says=["0 findings that begin with 'nosuch'", "such as"])
        if len(rows) > 1:
            self.refuses("solve", f"{store}:cycle", says=[f"{len(rows)} findings", "expected one"])


class Page(Case):
    def test_every_example_of_the_page_is_read_and_solved(self):
        examples = re.findall(r"^```(json|dat)\n(.*?)^```", PAGE.read_text(), re.M | re.S)
        self.assertGreaterEqual(len(examples), 6)
        for number, (kind, text) in enumerate(examples):
            with self.subTest(example=text):
                answer = self.succeeds("solve", self.file(f"example-{number}.{kind}", text), "--json").json()
                self.assertEqual(answer["outcome"], "solved")

    def test_the_page_names_all_keys_and_kinds(self):
        page = PAGE.read_text()
        for word in ("format", "version", "name", "dimension", "contacts", "mu", "A", "b", "scene", "origin", "expect",
                     "bilateral", "frictionless", "static", "sliding"):
            self.assertIn(f"`{word}`", page)


class Short(Case):
    def whole(self, problem):
        out = self.folder / "whole.json"
        self.succeeds("import", self.file("mine.json", problem), "-o", out)
        return json.loads(out.read_text())

    def test_what_is_left_out_has_its_default(self):
        whole = self.whole(SHORT)
        self.assertEqual(whole, {**cli.SOLVED, "name": "mine"})
        left_out = {key: value for key, value in cli.SOLVED.items() if key in ("contacts", "A", "b")}
        self.assertEqual(self.whole(left_out), {**cli.SOLVED, "name": "mine"})

    def test_the_dimension_is_what_the_sizes_tell(self):
        def of(rows, mu):
            eye = [[int(i == j) for j in range(rows)] for i in range(rows)]
            return {"A": eye, "b": [-1] * rows, "mu": mu}
        for rows, mu, dimension in ((4, 1, 2), (3, 1, 3), (9, 0.5, 3), (6, [1, 1, 1], 2), (6, [1, 1], 3), (0, 1, 2)):
            whole = self.whole(of(rows, mu))
            self.assertEqual(whole["dimension"], dimension)
            self.assertEqual(len(whole["contacts"]), rows // dimension)
        in_doubt, out = self.file("six.json", of(6, 1)), self.folder / "out"
        self.refuses("import", in_doubt, "-o", out, says="dimension: found nothing, expected 2 or 3: 6 rows fit both")
        self.assertEqual(self.whole({**of(6, 1), "dimension": 3})["dimension"], 3)
        self.refuses("import", self.file("five.json", of(5, [1, 1])), "-o", out, says="5 rows fit neither")


class Faults(Case):
    def test_all_that_is_missing_or_wrong_is_told_at_once(self):
        wrong = {"contacts": [{"kind": "static"}, {"kind": "sticky", "mu": 1}, {"kind": "bilateral", "mu": 1}],
                 "b": [0, 0, "x"], "name": 7, "c": 1, "d": 2, "dimension": 4, "origin": "here"}
        done = self.refuses("solve", self.file("wrong.json", wrong), says=[
            "c, d: found unknown keys", "dimension: found 4", "contacts[0].mu: found nothing",
            "contacts[1].kind: found", "contacts[2].mu: found 1, expected no mu", "A: found nothing",
            'b[2]: found "x"', "name: found 7", "origin: found"])
        self.assertEqual(len(done.err.splitlines()), 1)

    def test_many_faults_are_counted(self):
        wrong = {**SHORT, "mu": ["x"] * 30}
        self.refuses("solve", self.file("wrong.json", wrong), says=["mu[0]: found", "and 2"])

    def test_every_refusal_names_the_next_step(self):
        certificate = self.folder / "certificate.json"
        self.succeeds("certify", self.file("p.json", cli.SOLVED), "-o", certificate)
        for file, says in (
                (self.file("inf.json", {**SHORT, "mu": "infinity"}), "mu: found \"infinity\""),
                (self.file("both.json", {**cli.SOLVED, "mu": 1}), "mu: found mu beside contacts, expected one"),
                (self.file("empty.json", {}), "an array of contacts, or mu of static ones"),
                (certificate, "stiction check verifies"),
                (self.file("c.json", {"format": "stiction-campaign", "version": 1}), "stiction search"),
                (self.file("notes.txt", "hello\n"), "corpus/formats/problems.md"),
                (self.file("nothing", ""), "corpus/formats/problems.md"),
                (cli.ROOT / "corpus/scenes/two-towers.json", "stiction assemble")):
            self.refuses("solve", file, says=says)

    def test_check_of_a_problem_says_what_writes_a_certificate(self):
        for problem in (cli.SOLVED, SHORT):
            done = cli.run("check", self.file("p.json", problem))
            self.assertEqual(done.code, 1)
            self.assertIn("found a problem, expected a certificate; stiction certify", " ".join(done.out.split()))


class Large(Case):
    """More rows than a dense matrix is made for: chains of springs between contacts, A in entries."""

    def problem(self, contacts, dimension):
        rows = contacts * dimension
        entries = [[i, i, 2] for i in range(rows)]
        entries += [[i, i - dimension, "-1/2"] for i in range(dimension, rows) if i % dimension == 0]
        b = [(-1 if i % dimension == 0 else Fraction(i % 7, 10)) for i in range(rows)]
        return {"A": {"size": rows, "entries": entries}, "b": [str(x) for x in b], "mu": "1/2", "dimension": dimension}

    def test_forces_are_printed_in_plane_and_space(self):
        for contacts, dimension in ((2100, 2), (1400, 3)):
            problem = self.problem(contacts, dimension)
            file = self.file(f"large-{dimension}.json", problem)
            answer = self.succeeds("solve", file, "--json", timeout=600).json()
            self.assertEqual((answer["outcome"], len(answer["f"])), ("solved", contacts * dimension))
            self.assertLessEqual(answer["residual"], 1e-8)
            self.assertTrue(all(f >= -1e-9 for f in answer["f"][::dimension]))
            text = self.succeeds("solve", file, timeout=600).out
            self.assertEqual(len(re.findall(r"^ *N\d+ ", text, re.M)), contacts)

    def test_what_is_imported_and_exported_stays_sparse(self):
        problem = self.problem(2100, 2)
        file, dat, back = self.file("large.json", problem), self.folder / "large.dat", self.folder / "back.json"
        self.succeeds("export", file, "-o", dat, "--format", "siconos-fc", "--storage", "triplet", "--round")
        self.succeeds("import", dat, "-o", back)
        again = json.loads(back.read_text())
        self.assertEqual(sorted(map(str, again["A"]["entries"])), sorted(map(str, (
            [i, j, str(x)] for i, j, x in problem["A"]["entries"]))))
        self.assertEqual(self.succeeds("solve", dat, "--json", timeout=600).json()["f"],
                         self.succeeds("solve", back, "--json", timeout=600).json()["f"])

    def test_what_needs_a_dense_matrix_says_which_verbs_do_not(self):
        file = self.file("large.json", self.problem(2100, 2))
        self.refuses("replay", file, says=["4200", "stiction solve"])
        self.refuses("solve", file, "--method", "lemke", says=["4200", "--method lemke"])


if __name__ == "__main__":
    cli.main()
