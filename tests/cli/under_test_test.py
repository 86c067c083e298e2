# SPDX-License-Identifier: Apache-2.0
"""stiction search --solver: what a solver under test does wrong is found, named and minimized, whatever happens to it."""

import json
import re
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import cli

TOY = Path(__file__).with_name("toy_solver.c")
EXAMPLE = cli.ROOT / "search/under_test/examples/projected_gauss_seidel.py"


class UnderTest(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.common = Path(tempfile.mkdtemp(prefix="stiction-under-test-"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.common)

    @classmethod
    def toy(cls, *bugs):
        """The toy solver with these bugs."""
        library = cls.common / ("-".join(("toy",) + bugs).replace('"', "") + ".so")
        if not library.exists():
            subprocess.run(["cc", "-shared", "-fPIC", "-O1", f"-I{cli.ROOT}", *(f"-D{bug}" for bug in bugs), TOY, "-lm",
                            "-o", library], check=True)
        return library

    def search(self, solver, store, *options, contacts=(2, 3), problems=8000, generator="integers", unit=4000,
               finishing=100):
        campaign = self.folder / "campaign.json"
        campaign.write_text(json.dumps({"format": "stiction-campaign", "version": 1, "generators": [generator],
                                        "contacts": contacts, "first_unit_problems": unit, "unit_problems": unit}))
        return cli.run("search", campaign, "--solver", solver, "--store", self.folder / store, "--problems", problems,
                       "--finishing", finishing, *options)

    def findings(self, store):
        with sqlite3.connect(self.folder / store) as db:
            rows = db.execute("SELECT kind, signature, done, minimized, facts, minimized_existence FROM findings").fetchall()
        db.close()
        return [{"kind": kind, "signature": signature, "done": done, "facts": json.loads(facts),
                 "minimized": json.loads(minimized) if minimized else None, "existence": existence}
                for kind, signature, done, minimized, facts, existence in rows]

    def smallest(self, solver, kind, **options):
        """The minimized problem of what a solver is found to do, which is of this kind alone."""
        store = f"{kind}.store"
        done = self.search(solver, store, **options)
        self.assertEqual(done.code, 0, done.err)
        found = self.findings(store)
        self.assertTrue(found, done.out)
        self.assertEqual({finding["kind"] for finding in found}, {kind})
        for finding in found:
            self.assertTrue(finding["done"])
            self.assertTrue(finding["facts"]["alone"], finding["signature"])
            self.assertEqual(finding["facts"]["minimized"]["kind"], kind)
        least = min(found, key=lambda finding: len(finding["minimized"]["contacts"]))
        numbers = [Fraction(x) for row in self.matrix(least["minimized"]) for x in row]
        self.assertTrue(all(x.denominator == 1 and abs(x) <= 20 for x in numbers), least["minimized"])
        for language in ("c", "python"):
            self.assertIn("WRONG", self.reproduced(store, least["signature"], language, solver), language)
        return least

    def reproducer(self, store, finding, language):
        """The program that `export` writes; it fits a screen."""
        file = self.folder / f"{finding}-{language}.{'py' if language == 'python' else 'c'}"
        self.succeeds("export", f"{self.folder / store}:{finding}", "--reproducer", language, "-o", file)
        self.assertLessEqual(len(file.read_text().splitlines()), 60)
        self.assertIn(finding, file.read_text().split("\n")[0 if language == "c" else 1])
        return file

    def reproduced(self, store, finding, language, solver, wrong=True):
        """What the program says of a solver; it is held against the exit code."""
        file = self.reproducer(store, finding, language)
        command = ["python3", file, solver]
        if language == "c":
            command = [file.with_suffix("")]
            subprocess.run(["cc", "-Wall", "-Wextra", "-Werror", f"-I{cli.ROOT}/search/under_test", file, solver, "-lm", "-o",
                            *command], check=True)
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (int(wrong), ""), done.stdout)
        return done.stdout

    @staticmethod
    def matrix(problem):
        A = problem["A"]
        return A if isinstance(A, list) else [[x for *_, x in A["entries"]]]

    # ---- Bugs that are planted ----

    def test_a_right_solver_passes_and_its_number_is_told(self):
        done = self.search(self.toy(), "right.store", "--json")
        self.assertEqual(done.code, 0, done.err)
        told = done.json()
        self.assertEqual(told["solver"], {"name": "toy", "version": "1", "law": "frictionless", "accuracy": "1e-06"})
        self.assertGreaterEqual(told["counts"]["problems"], 8000)
        self.assertEqual(told["counts"]["passed"], told["counts"]["problems"])
        self.assertEqual(told["passed"]["count"], told["counts"]["problems"])
        self.assertLess(told["passed"]["low"], 1)
        self.assertGreater(told["passed"]["low"], 0.999)
        self.assertEqual(told["groups"], [])
        text = cli.run("status", self.folder / "right.store")
        self.assertIn("failures: no failure", text.out)

    def test_a_wrong_sign_at_a_tie_is_found_and_named_after_what_it_breaks(self):
        least = self.smallest(self.toy("BUG_TIE"), "silent-wrong")
        self.assertIn(least["facts"]["minimized"]["what"], ("pulls", "moves-inward"))
        self.assertEqual(len(least["minimized"]["contacts"]), 2)
        self.assertIn("solution-exists", least["existence"])

    def test_a_rare_nan_is_found(self):
        least = self.smallest(self.toy("BUG_NAN"), "not-finite")
        self.assertEqual(len(least["minimized"]["contacts"]), 2)
        A = self.matrix(least["minimized"])
        self.assertEqual(A[0][0], A[1][1])
        self.assertEqual(A[0][1], "1")

    def test_a_crash_is_found_and_the_search_goes_on(self):
        least = self.smallest(self.toy("BUG_CRASH"), "crash")
        self.assertIn("crash-sigsegv", least["signature"])

    def test_a_hang_is_found_by_its_processor_time(self):
        least = self.smallest(self.toy("BUG_HANG"), "hang", contacts=(3,), problems=2000, unit=4000)
        self.assertEqual(len(least["minimized"]["contacts"]), 3)

    def test_a_leak_is_found_and_its_problem_made_small(self):
        least = self.smallest(self.toy("BUG_LEAK"), "leak", contacts=(2,), problems=2000, unit=4000)
        self.assertEqual(len(least["minimized"]["contacts"]), 1)
        self.assertGreaterEqual(least["facts"]["minimized"]["bytes"], 48)

    # ---- Leaks ----

    GREETING = ("import json, sys\ndef answer(): print(json.dumps(dict(solved=False)), flush=True)\nkept = []\n"
                "print(json.dumps(dict(protocol=1, solver='x', version='1', law='box', accuracy=1e-6%s)), flush=True)\n"
                "for line in sys.stdin: answer(); ")

    def leaks(self, body, *options, greeting=""):
        """The leaks that are found of a program that gives up on every problem."""
        store = f"{len(list(self.folder.glob('*.store')))}.store"
        done = self.search(self.program(self.GREETING % greeting + body + "\n"), store, *options, contacts=(1,), problems=4000,
                           unit=4000, finishing=0, generator="psd")
        self.assertEqual(done.code, 0, done.err)
        return [finding["signature"] for finding in self.findings(store) if finding["kind"] == "leak"]

    def test_a_leak_of_a_program_is_found(self):
        self.assertEqual(self.leaks("kept.append(bytes(20000))"), ["leak-1c"])

    def test_what_is_kept_for_a_while_is_no_leak(self):
        self.assertEqual(self.leaks("kept.append(bytes(20000)); kept = kept[-1000:]"), [])  # full after a thousand calls
        self.assertEqual(self.leaks("kept = [] if len(kept) > 900 else kept + [bytes(20000)]"), [])  # collected in turns

    def test_leaks_are_not_looked_for_where_that_is_asked(self):
        self.assertEqual(self.leaks("kept.append(bytes(20000))", "--no-leaks"), [])
        self.assertEqual(self.leaks("kept.append(bytes(20000))", greeting=", leaks=False"), [])
        refused = cli.run("search", "--solver", self.program(self.GREETING % ", leaks=1"), "--problems", 1, cwd=self.folder)
        self.assertEqual(refused.code, 2)
        self.assertIn("leaks: found 1, expected true or false", refused.err)

    @unittest.skipUnless(shutil.which("node"), "needs node")
    def test_a_collector_is_not_called_a_leak(self):
        file = self.folder / "collected.js"
        file.write_text(
            "#!/usr/bin/env node\nconst rl = require('readline').createInterface({input: process.stdin});\n"
            "console.log(JSON.stringify({protocol: 1, solver: 'js', version: '1', law: 'box', accuracy: 1e-6}));\n"
            "rl.on('line', line => {const p = JSON.parse(line); let f = p.b.map(() => 0);\n"
            "  for (let k = 0; k < 200; k++) f = p.b.map((b, i) => f[i] - 0.1 * p.A[i].reduce((a, x, j) => a + x * f[j], b));\n"
            "  console.log(JSON.stringify({solved: false, f}))});\n")
        file.chmod(0o755)
        done = self.search(file, "js.store", contacts=(1,), problems=8000, unit=8000, finishing=0, generator="psd")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual([finding["signature"] for finding in self.findings("js.store") if finding["kind"] == "leak"], [])

    # ---- What is minimized ----

    def test_what_is_minimized_is_clear_and_what_bodies_make(self):
        for contacts in (1, 2):
            store = f"noise-{contacts}.store"
            done = self.search(self.toy("BUG_NOISE"), store, contacts=(contacts,), problems=2000, unit=2000)
            self.assertEqual(done.code, 0, done.err)
            found = [finding for finding in self.findings(store) if finding["minimized"]]
            self.assertTrue(found, done.out)
            for finding in found:
                facts, problem = finding["facts"], finding["minimized"]
                self.assertGreaterEqual(facts["minimized"]["error"], min(1e-5, facts["found"]["error"]))
                self.assertTrue(any(Fraction(x) != 0 for x in problem["b"]), problem)
                A = problem["A"]
                diagonal = ([A[i][i] for i in range(len(A))] if isinstance(A, list) else
                            [x for i, j, x in A["entries"] if i == j])
                self.assertEqual(len(diagonal), len(problem["b"]), problem)
                self.assertTrue(all(Fraction(x) > 0 for x in diagonal), problem)
                file = self.file("small.json", problem)
                for claim in ("psd", "in-range"):
                    self.succeeds("certify", file, "--claim", claim, "-o", self.folder / "c.json")

    def test_a_rate_is_never_beyond_a_million_in_a_million(self):
        done = self.search(self.toy("BUG_LIES"), "lies.store", problems=4000, finishing=0)
        rates = re.findall(r"\[([\d.,]+), ([\d.,]+)\] in a million", done.out)
        self.assertTrue(rates, done.out)
        for _, high in rates:
            self.assertLessEqual(float(high.replace(",", "")), 1e6)

    def test_a_solution_that_is_refused_stands_beside_the_finding(self):
        least = self.smallest(self.toy("BUG_REFUSES"), "refused-solvable")
        certificate = json.loads(least["existence"])
        self.assertEqual(certificate["claim"], "solution-exists")
        file = self.folder / "certificate.json"
        file.write_text(json.dumps(certificate))
        checked = subprocess.run(["python3", cli.ROOT / "certify/check_certificate.py", file], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)

    # ---- What is kept ----

    def test_what_is_kept_of_packages_is_a_problem_with_its_program_and_right_forces(self):
        programs = sorted((cli.ROOT / "corpus/peers/minimized").glob("*.cc"))
        solvers = {re.split("-(?:leak|not-finite|refused|silent)", program.name)[0] for program in programs}
        self.assertEqual(solvers, {"bullet-dantzig", "bullet-dantzig-frictionless", "bullet-lemke", "dart",
                                   "dart-frictionless", "ode", "ode-frictionless", "siconos-lemke", "siconos-nsgs",
                                   "siconos-nsn-ac"})
        for program in programs:
            with self.subTest(program=program.name):
                problem = json.loads(program.with_suffix(".json").read_text())
                text = program.read_text()
                self.assertLessEqual(len(text.splitlines()), 60)
                arrays = {name: values.replace(". /", "/").split(",") for name, values in
                          re.findall(r"(\w+)\[\] = \{([^}]*)\}", text)}
                exact = {name: [Fraction(x.replace(" ", "").rstrip(".")) for x in arrays[name]] for name in ("A", "b", "right")}
                A = [Fraction(x) for row in self.matrix(problem) for x in row]
                self.assertEqual((exact["A"], exact["b"]), (A, [Fraction(x) for x in problem["b"]]))
                f, n = exact["right"], len(exact["b"])
                a = [exact["b"][i] + sum(A[i * n + j] * f[j] for j in range(n)) for i in range(n)]
                # Exact, but for what is right in space; findex has a bound of its own, which is not looked at.
                error = 0 if "/* exact, and verified */" in text else Fraction(1, 10**7)
                mu = [Fraction(contact.get("mu", 0)) for contact in problem["contacts"] for _ in
                      range(problem["dimension"] if contact["kind"] == "static" else 1)]
                for i in range(n):
                    if "INFINITY" in arrays["high"][i]:  # a normal
                        normal = i
                        self.assertTrue(f[i] >= -error and a[i] >= -error and abs(f[i] * a[i]) <= error, (f, a))
                        continue
                    self.assertLessEqual(f[i] * a[i], error, (f, a))
                    if program.name.startswith("siconos"):
                        self.assertLessEqual(abs(f[i]), mu[i] * f[normal] + error, (f, a))

    # ---- Scenes ----

    def test_what_a_scene_shows_is_shown_by_a_simpler_scene(self):
        liar = self.toy("BUG_LIES")
        done = self.search(liar, "scenes.store", generator="scenes", contacts=(3,), problems=20, unit=20)
        self.assertEqual(done.code, 0, done.err)
        store = self.folder / "scenes.store"
        of_scenes = [finding for finding in self.findings("scenes.store") if "scene" in finding["facts"]]
        self.assertTrue(of_scenes, done.out)
        for finding in of_scenes:
            facts, file = finding["facts"], self.folder / "scene.json"
            self.assertEqual(facts["scene"]["contacts"], 1)
            self.assertEqual(facts["scene"]["mu"], "0")  # toy's law has no friction
            self.succeeds("problem", store, finding["signature"], "--scene", "-o", file)
            problem = json.loads(file.read_text())
            self.assertEqual(len(problem["contacts"]), facts["scene"]["contacts"])
            self.assertEqual({contact["kind"] for contact in problem["contacts"]}, {"frictionless"})
            self.assertEqual(problem["scene"]["format"], "stiction-scene")
            scene = self.folder / "alone.json"
            scene.write_text(json.dumps(problem["scene"]))
            self.succeeds("import", scene, "-o", self.folder / "assembled.json")
            self.assertLess(Fraction(problem["b"][0]), 0)  # it moves inward without forces
        self.assertIn("as a scene to", self.succeeds("status", store).out)
        self.search(liar, "integers.store", contacts=(2,), problems=20, unit=20)
        finding = self.findings("integers.store")[0]["signature"]
        self.refuses("problem", self.folder / "integers.store", finding, "--scene", says=["scene"])
        self.refuses("problem", store, 0, 0, "--scene", says=["--scene", "SIGNATURE"])

    # ---- Reproducers ----

    def test_a_solver_that_is_mended_is_not_called_wrong(self):
        self.search(self.toy("BUG_TIE"), "tie.store", problems=4000)
        finding = self.findings("tie.store")[0]["signature"]
        for language in ("c", "python"):
            said = self.reproduced("tie.store", finding, language, self.toy(), wrong=False)
            self.assertIn("not seen here", said)

    def test_right_forces_hold_under_every_law(self):
        for law, generator in (("box", "integers"), ("findex", "psd"), ("pyramid", "integers"), ("coulomb", "integers"),
                               ("coulomb", "space")):
            store, liar = f"{law}-{generator}.store", self.toy("BUG_LIES", f'LAW="{law}"')
            self.search(liar, store, generator=generator, contacts=(2,), problems=40, unit=40, finishing=0)
            finding = self.findings(store)[0]["signature"]
            for language in ("c", "python"):
                self.assertIn("WRONG: row", self.reproduced(store, finding, language, liar))
            text = self.reproducer(store, finding, "python").read_text()
            scope = {}
            exec(text[:text.index("\nclass Problem")] + text[text.index("def misses"):text.index("solved, f = ")], scope)
            right = scope["RIGHT"]
            self.assertTrue(right, store)
            a = [b + sum(Fraction(x) * y for x, y in zip(row, right)) for row, b in zip(scope["A"], map(Fraction, scope["B"]))]
            by, what = max(scope["misses"]([float(x) for x in right], [float(x) for x in a]))
            self.assertLess(by, 1e-7, (store, what, right))

    def test_what_has_no_reproducer_is_refused(self):
        self.search(self.toy("BUG_LIES", 'LAW="box"'), "box.store", problems=40, unit=40, finishing=0)
        finding = f"{self.folder}/box.store:{self.findings('box.store')[0]['signature']}"
        out = ("-o", self.folder / "out.c")
        self.refuses("export", finding, "--reproducer", "ode", *out, says=["box", "frictionless or findex"])
        self.refuses("export", finding, "--reproducer", "fortran", *out, says=["--reproducer", "python"])
        self.refuses("export", finding, *out, says=["--format", "--reproducer"])
        self.refuses("export", finding, "--reproducer", "c", "--format", "fclib", *out, says=["--reproducer", "--format"])
        self.refuses("export", self.file("p.json", cli.REFERENCE), "--reproducer", "c", *out, says=["STORE:FINDING"])
        self.search(self.program("import sys\nprint('{\"protocol\": 1, \"solver\": \"x\", \"version\": \"1\", \"law\": "
                                 "\"box\", \"accuracy\": 1}', flush=True)\nsys.stdin.readline()\n"), "p.store",
                    contacts=(1,), problems=1, unit=1, finishing=0)
        self.refuses("export", f"{self.folder}/p.store:crash", "--reproducer", "c", *out, says=["program", "python"])

    # ---- Objectives ----

    def test_what_a_solver_calls_solved_is_made_worse(self):
        options = ("--objective", "error", "--json")
        one, two = (self.search(self.toy("BUG_TIE"), store, *options, "--threads", threads, contacts=(2,), unit=1000,
                                finishing=0) for store, threads in (("one", 1), ("two", 2)))
        self.assertEqual(one.code, 0, one.err)
        self.assertSameContent(self.folder / "two", self.folder / "one")
        told = one.json()
        self.assertGreater(told["best"][0]["value"], -1)  # random problems: -16, and at a tie what it breaks
        self.assertIn("silent-wrong", {group["kind"] for group in told["groups"]})
        best = self.folder / "best.json"
        self.succeeds("problem", self.folder / "one", "--best", "-o", best)
        problem = json.loads(best.read_text())
        self.assertEqual((problem["A"][0][0], problem["b"][0]), (problem["A"][2][2], problem["b"][2]))
        self.assertIn("WRONG", self.reproduced("one", told["groups"][0]["signature"], "c", self.toy("BUG_TIE")))
        self.assertIn("failures of", self.succeeds("status", self.folder / "one").out)
        self.refuses("report", self.folder / "one", self.folder / "two", says=["optimized"])

    def test_a_solver_is_made_worse_in_space(self):
        liar = self.toy("BUG_LIES", 'LAW="coulomb"')
        done = self.search(liar, "space", "--objective", "error", "--json", contacts=(2,), problems=200, unit=200,
                           generator="space", finishing=0)
        self.assertEqual(done.code, 0, done.err)
        self.assertGreater(done.json()["best"][0]["value"], -3)
        best = self.folder / "best.json"
        self.succeeds("problem", self.folder / "space", "--best", "-o", best)
        self.assertEqual(json.loads(best.read_text())["dimension"], 3)

    def test_a_solver_is_made_slow(self):
        done = self.search(self.toy("BUG_SLOW"), "slow", "--objective", "time", "--json", contacts=(2,), problems=200,
                           unit=200, finishing=0)
        self.assertGreater(done.json()["best"][0]["value"], -5)

    def test_objectives_have_their_searches(self):
        refused = self.search(self.toy(), "no", "--objective", "steps", problems=1)
        self.assertEqual(refused.code, 2)
        self.assertIn("expected error or time", refused.err)
        self.refuses("search", "--objective", "error", "--store", self.folder / "no", says=["error", "--solver"])

    # ---- Side by side ----

    def test_solvers_side_by_side(self):
        solvers = {"right": self.toy(), "tie": self.toy("BUG_TIE"), "refuses": self.toy("BUG_REFUSES")}
        for name, solver in solvers.items():
            self.search(solver, name, problems=4000, unit=250, finishing=100 if name == "tie" else 0)
        stores = [self.folder / name for name in solvers]
        out = self.folder / "page"
        told = self.succeeds("report", *stores, "-o", out, "--json").json()
        self.assertEqual(told["differences"], ["none: all were given the same problems, as far as each search went"])
        rows = [dict(zip(told["failures"]["columns"], row)) for row in told["failures"]["rows"]]
        by = {(row["family"], row["solver"].split("(")[1].split("/")[-1].rstrip(")")): row for row in rows}
        self.assertEqual(by["all", "right"]["silent_wrong"], 0)
        self.assertGreater(by["all", "tie"]["silent_wrong"], 0)
        self.assertGreater(by["integers, 2", "refuses"]["refused_solvable"], 0)
        count, of = by["all", "tie"]["silent_wrong"], by["all", "tie"]["problems"]
        self.assertEqual(sum(by[f"integers, {n}", "tie"]["silent_wrong"] for n in (2, 3)), count)
        self.assertLess(by["all", "tie"]["silent_wrong_low"], 1e6 * count / of)
        self.assertGreater(by["all", "tie"]["silent_wrong_high"], 1e6 * count / of)
        least = [dict(zip(told["smallest"]["columns"], row)) for row in told["smallest"]["rows"]]
        self.assertEqual({row["kind"] for row in least}, {"silent-wrong", "refused-solvable"})
        wrong = next(row for row in least if row["kind"] == "silent-wrong")
        self.assertEqual((wrong["contacts"], wrong["minimized"]), (2, "yes"))
        self.assertRegex(wrong["problem"], r"^A = -?\d+ -?\d+, -?\d+ -?\d+; b = -?\d+ -?\d+$")
        self.assertEqual(sorted(file.name for file in out.iterdir()),
                         [".stiction-files", "SHA256SUMS", "failures.csv", "index.html", "smallest.csv", "solvers.csv", "solvers.txt"])
        page = (out / "index.html").read_text()
        self.assertIn(wrong["problem"], page)
        self.assertNotIn("{{", page)
        text = subprocess.run(["env", "COLUMNS=80", cli.program, "report", *stores], capture_output=True, text=True,
                              check=True).stdout
        self.assertEqual((out / "solvers.txt").read_text(), text)
        self.assertIn("silent-wrong", text)

    def test_what_cannot_stand_side_by_side_is_refused(self):
        self.search(self.toy(), "a.store", problems=1)
        own = self.folder / "own.store"
        cli.run("search", "-g", "psd", "-c", 2, "--problems", 1, "--store", own)
        self.refuses("report", self.folder / "a.store", own, says=[own, "one that tests a solver"])
        self.refuses("report", own, self.folder / "a.store", says=["a.store", "published algorithm"])
        self.refuses("report", own, own, own, says=["found 3 stores"])

    # ---- A campaign as all are ----

    def test_threads_and_interruptions_do_not_matter(self):
        solver = self.toy("BUG_TIE", "BUG_NAN")
        for store, threads, sizes in (("one", 1, [3000]), ("two", 2, [3000]), ("resumed", 2, [1, 1500, 3000])):
            for problems in sizes:
                done = self.search(solver, store, "--threads", threads, problems=problems, unit=1000)
                self.assertEqual(done.code, 0, done.err)
        self.assertGreater(len(self.findings("one")), 1)
        self.assertSameContent(self.folder / "two", self.folder / "one")
        self.assertSameContent(self.folder / "resumed", self.folder / "one")

    def test_a_store_of_another_solver_is_refused(self):
        self.search(self.toy(), "a.store", problems=1)
        refused = self.search(EXAMPLE, "a.store", problems=1)
        self.assertEqual(refused.code, 2)
        self.assertIn("solver name toy, not projected Gauss-Seidel", refused.err)
        self.assertNotIn("{", refused.err)
        alone = cli.run("search", "--finish", "--store", self.folder / "a.store")
        self.assertEqual(alone.code, 2)
        self.assertIn("--solver", alone.err)

    def test_what_is_not_finished_is_finished_by_the_command_that_is_told(self):
        told = self.search(self.toy("BUG_LIES"), "a.store", problems=4000, finishing=0)
        self.assertEqual(told.code, 0, told.err)
        status = cli.run("status", self.folder / "a.store")
        command = rf"    stiction (search --store {re.escape(str(self.folder))}/a\.store --finish --solver )(\S+)\n"
        for text, solver in ((told.out, str(self.toy("BUG_LIES"))), (status.out, "FILE")):
            found = re.search("What is not finished is finished by:\n" + command, text)
            self.assertIsNotNone(found, text)
            self.assertEqual(found[2], solver)
        done = cli.run(*(found[1] + str(self.toy("BUG_LIES"))).split())
        self.assertEqual(done.code, 0, done.err)
        self.assertTrue(all(finding["done"] for finding in self.findings("a.store")))
        self.assertNotIn("not finished", done.out)

    def test_more_problems_than_fill_whole_units_go_on(self):
        for asked, fill, units in ((10, 4000, 1), (4001, 6000, 2)):
            done = self.search(self.toy(), "a.store", problems=asked)
            self.assertEqual(done.code, 0, done.err)
            self.assertEqual(cli.run("status", self.folder / "a.store", "--json").json()["units"], units)
            self.assertIn(f"{asked:,} problems were asked for, {fill:,} fill whole units; the same command with --problems "
                          f"above {fill} goes on", done.err)

    # ---- Programs ----

    def test_the_example_is_a_program_and_converges_slowly(self):
        done = self.search(EXAMPLE, "python.store", "--json", contacts=(1, 2), problems=300, unit=100)
        self.assertEqual(done.code, 0, done.err)
        told = done.json()
        self.assertEqual(told["solver"]["law"], "pyramid")
        self.assertGreater(told["counts"]["passed"], told["counts"]["problems"] // 2)
        text = subprocess.run(["env", "COLUMNS=80", cli.program, "status", self.folder / "python.store"],
                              capture_output=True, text=True, check=True).stdout
        self.assertEqual([line for line in text.splitlines() if len(line) > 80 and not line.startswith("    ")
                          and str(self.folder) not in line], [])
        self.assertIn(" in a million", text)

    def program(self, body):
        file = self.folder / "program.py"
        file.write_text("#!/usr/bin/env python3\n" + body)
        file.chmod(0o755)
        return file

    def test_what_is_no_answer_is_a_finding(self):
        greeting = ("import json, sys\nprint(json.dumps(dict(protocol=1, solver='x', version='1', law='box', accuracy=1e-6)),"
                    " flush=True)\nfor line in sys.stdin: ")
        for answer, signature in (("print('hm', flush=True)", "crash-garbled-1c"), ("sys.exit(3)", "crash-exit-3-1c"),
                                  ("print('{\"solved\": true, \"f\": [NaN, 0]}', flush=True)", "not-finite-1c"),
                                  ("print('{\"solved\": true, \"f\": [1e999, 0]}', flush=True)", "not-finite-out-of-range-1c")):
            name = signature + ".store"
            done = self.search(self.program(greeting + answer + "\n"), name, contacts=(1,), problems=1, unit=1,
                               finishing=0)
            self.assertEqual(done.code, 0, done.err)
            self.assertEqual([finding["signature"] for finding in self.findings(name)], [signature])
            self.assertIn("WRONG", self.reproduced(name, signature, "python", self.folder / "program.py"))

    def test_what_cannot_be_run_is_refused_by_its_name(self):
        nothing = self.folder / "nothing.so"
        nothing.write_text("")
        for file in (self.folder / "missing.py", nothing, self.program("print('hello', flush=True)\n")):
            refused = self.search(file, "none.store", problems=1)
            self.assertEqual(refused.code, 2, refused.err)
            self.assertIn(file.name, refused.err)
            self.assertFalse((self.folder / "none.store").exists())


if __name__ == "__main__":
    cli.main()
