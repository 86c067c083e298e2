# SPDX-License-Identifier: Apache-2.0
"""stiction search --solver: what a solver under test does wrong is found, named and minimized, whatever happens to it."""

import json
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
        library = cls.common / ("-".join(("toy",) + bugs) + ".so")
        if not library.exists():
            subprocess.run(["cc", "-shared", "-fPIC", "-O1", f"-I{cli.ROOT}", *(f"-D{bug}" for bug in bugs), TOY, "-lm",
                            "-o", library], check=True)
        return library

    def search(self, solver, store, *options, contacts=(2, 3), problems=8000, generator="integers", unit=4000,
               finishing=100):
        campaign = self.folder / "campaign.json"
        campaign.write_text(json.dumps({"format": "stiction-campaign", "version": 1, "generators": [generator],
                                        "contacts": contacts, "unit_problems": unit}))
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
        done = self.search(solver, f"{kind}.store", **options)
        self.assertEqual(done.code, 0, done.err)
        found = self.findings(f"{kind}.store")
        self.assertTrue(found, done.out)
        self.assertEqual({finding["kind"] for finding in found}, {kind})
        for finding in found:
            self.assertTrue(finding["done"])
            self.assertTrue(finding["facts"]["alone"], finding["signature"])
            self.assertEqual(finding["facts"]["minimized"]["kind"], kind)
        least = min(found, key=lambda finding: len(finding["minimized"]["contacts"]))
        numbers = [Fraction(x) for row in self.matrix(least["minimized"]) for x in row]
        self.assertTrue(all(x.denominator == 1 and abs(x) <= 20 for x in numbers), least["minimized"])
        return least

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

    def test_a_leak_is_found(self):
        done = self.search(self.toy("BUG_LEAK"), "leak.store", contacts=(1,), problems=4000, finishing=0)
        self.assertEqual(done.code, 0, done.err)
        found = self.findings("leak.store")
        self.assertEqual([finding["signature"] for finding in found], ["leak-1c"], done.out)
        self.assertGreaterEqual(found[0]["facts"]["found"]["bytes"], 48)

    def test_a_solution_that_is_refused_stands_beside_the_finding(self):
        least = self.smallest(self.toy("BUG_REFUSES"), "refused-solvable")
        certificate = json.loads(least["existence"])
        self.assertEqual(certificate["claim"], "solution-exists")
        file = self.folder / "certificate.json"
        file.write_text(json.dumps(certificate))
        checked = subprocess.run(["python3", cli.ROOT / "certify/check_certificate.py", file], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)

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
        self.assertIn("projected Gauss-Seidel", refused.err)
        alone = cli.run("search", "--finish", "--store", self.folder / "a.store")
        self.assertEqual(alone.code, 2)
        self.assertIn("--solver", alone.err)

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
                                  ("print('{\"solved\": true, \"f\": [NaN, 0]}', flush=True)", "not-finite-1c")):
            name = signature + ".store"
            done = self.search(self.program(greeting + answer + "\n"), name, contacts=(1,), problems=1, unit=1,
                               finishing=0)
            self.assertEqual(done.code, 0, done.err)
            self.assertEqual([finding["signature"] for finding in self.findings(name)], [signature])

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
