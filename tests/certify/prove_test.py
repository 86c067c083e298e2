# SPDX-License-Identifier: Apache-2.0
"""certify/coq/prove.py refuses, before it asks Coq, sources that leave something unproved, and changed statements.

So it does with proofs that have changed since they were checked, where it is asked for these alone.

prove_test.py PATH_TO_STICTION SOURCES

Needs no Coq: what Coq refuses is tried by `./run prove` itself, on false proofs of its own.
"""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path
from unittest import mock

SOURCES = Path(sys.argv.pop(2) if len(sys.argv) > 2 else Path(__file__).resolve().parents[2])
if len(sys.argv) > 1:
    sys.argv.pop(1)  # the program, which is not asked
COQ = SOURCES / "certify" / "coq"


class Scan(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.copy = Path(folder.name) / "coq"
        shutil.copytree(COQ, self.copy)

    def scan(self):
        return subprocess.run([sys.executable, "-B", str(COQ / "prove.py"), "--sources", str(self.copy), "--scan"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def refused(self, *said):
        done = self.scan()
        self.assertEqual(done.returncode, 1, done.stdout)
        for words in said:
            self.assertIn(words, done.stdout)

    def append(self, name, text):
        with open(self.copy / name, "a") as file:
            file.write(text)

    def test_the_sources_as_they_are_pass(self):
        done = self.scan()
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_problems_of_the_statements_are_those_of_the_corpus(self):
        text = (COQ / "loops/Statement.v").read_text()
        found = re.findall(r"\(\* corpus/(\S+\.json)[^*]*\*\)\nDefinition \w+ : problem rationals := Problem\s(.*?)\.\n",
                           text, re.S)
        self.assertEqual([name for name, _ in found], ["cycle-every-policy-mu-1.json", "endless/without-repetition.json"])
        for name, stated in found:
            problem = json.loads((SOURCES / "corpus" / name).read_text())
            numbers = [*(x for row in problem["A"] for x in row), *problem["b"], *(c["mu"] for c in problem["contacts"])]
            stated = stated.replace("(", "").replace(")", "").replace(" # ", "/")
            self.assertEqual(list(map(Fraction, re.findall(r"-?\d+(?:/\d+)?", stated))), list(map(Fraction, numbers)), name)
            self.assertEqual({contact["kind"] for contact in problem["contacts"]}, {"static"})

    def test_what_leaves_something_unproved_is_refused(self):
        for text in ("Lemma l : False. Proof. Admitted.", "Axiom a : False.", "Local Axiom a : False.",
                     "Parameter p : False.", "Parameters p q : False.", "Conjecture c : False.",
                     "Lemma l : False. Proof. admit. Admitted.",
                     "Variable v : False.", "Hypothesis h : False.", "Context (c : False).",
                     "Section S. End S. Variable v : False.", "Unset Guard Checking.", "Unset Universe Checking.",
                     "#[bypass_check(guard)] Fixpoint f (n : nat) : False := f n.", 'Load "other".',
                     "Extract Constant plus => \"0\".", "Lemma l : False. Proof. give_up. Qed."):
            with self.subTest(text=text):
                before = (self.copy / "loops/Laws.v").read_text()
                line = before.count("\n") + 1
                self.append("loops/Laws.v", text + "\n")
                self.refused(f"loops/Laws.v:{line}:")
                (self.copy / "loops/Laws.v").write_text(before)
        self.assertEqual(self.scan().returncode, 0)

    def test_words_in_comments_and_hypotheses_of_sections_are_none_of_it(self):
        self.append("loops/Laws.v", "(* Admitted. (* Axiom *) admit. *)\nSection S.\nVariable v : nat.\n"
                                    "Hypothesis h : v = 0.\nLemma l : v = 0. Proof. exact h. Qed.\nEnd S.\n")
        done = self.scan()
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_changed_statement_is_refused_until_it_is_accepted(self):
        for name in ("existence/Law.v", "existence/Statement.v", "driving/Statement.v", "driving/Rational.v",
                     "loops/Statement.v", "claims/Statement.v", "claims/Numbers.v"):
            with self.subTest(name=name):
                path = self.copy / name
                before = path.read_text()
                self.assertIn("0 <", before)
                path.write_text(before.replace("0 <", "1 <", 1))
                self.refused(f"{name}: has changed since it was read")
                path.write_text(before)
        self.append("loops/Statement.v", "\n(* read *)\n")
        self.refused("loops/Statement.v: has changed")
        subprocess.run([sys.executable, "-B", COQ / "prove.py", "--sources", self.copy, "--accept"], check=True)
        self.assertEqual(self.scan().returncode, 0)

    def test_a_missing_statement_and_a_file_without_a_head_are_refused(self):
        (self.copy / "loops/Statement.v").unlink()
        (self.copy / "loops/New.v").write_text("Definition n := 0.\n")
        self.refused("loops/Statement.v: is missing", "loops/New.v:1: has no head")

    def test_what_is_trusted_imports_only_what_is_trusted(self):
        path = self.copy / "existence/Law.v"
        path.write_text(path.read_text() + "From Stiction.existence Require Import Edge.\n")
        self.refused("existence/Law.v: must be read to be trusted, and imports existence/Edge.v")

    def test_without_digests_nothing_is_trusted(self):
        (self.copy / "digests.json").unlink()
        self.refused("existence/Law.v: has changed", "loops/Statement.v: has changed")


class IfChanged(unittest.TestCase):
    """A copy of `run` and of what it needs, where coqc only notes that it was called."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.coq, self.calls = self.root / "certify/coq", self.root / "calls"
        shutil.copytree(COQ, self.coq, ignore=shutil.ignore_patterns("__pycache__", "PROVED"))
        (self.root / "certify/claims").mkdir()
        for file in (SOURCES / "certify/claims").glob("coq_text.*"):
            shutil.copy(file, self.root / "certify/claims")
        shutil.copy(SOURCES / "run", self.root)
        tools = self.root / "tools"  # without dpkg-query no package is asked for
        tools.mkdir()
        for tool in ("awk", "bash", "dirname", "flock", "mkdir", "nproc", "readlink"):
            (tools / tool).symlink_to(shutil.which(tool))
        (tools / "python3").symlink_to(sys.executable)
        (tools / "coqc").write_text(f"#!/bin/sh\necho called >>{self.calls}\nexit 1\n")
        (tools / "coqc").chmod(0o755)
        self.environment = {**os.environ, "PATH": str(tools), "PYTHONDONTWRITEBYTECODE": "1"}
        spec = importlib.util.spec_from_file_location("prove", self.coq / "prove.py")
        self.prove = importlib.util.module_from_spec(spec)
        with mock.patch.object(sys, "path", [str(self.coq), *sys.path]):
            spec.loader.exec_module(self.prove)

    def proofs(self):
        self.calls.unlink(missing_ok=True)
        return subprocess.run([self.root / "run", "prove", "--if-changed"], env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)

    def is_run(self):
        done = self.proofs()
        self.assertIn("not those of certify/coq/PROVED", done.stdout)
        self.assertEqual(done.returncode, 1)  # this coqc proves nothing
        self.assertTrue(self.calls.exists())

    def test_they_are_run_where_a_proof_or_the_text_of_a_claim_has_changed(self):
        proved = self.coq / "PROVED"
        self.is_run()
        self.assertFalse(proved.exists())
        proved.write_text(self.prove.digest_of(self.coq) + "\n")
        done = self.proofs()
        self.assertEqual((done.returncode, self.calls.exists()), (0, False), done.stdout)
        self.assertIn("were checked as they stand", done.stdout)
        for name in ("coq/loops/Laws.v", "coq/claims/Tests.v", "coq/prove.py", "claims/coq_text.cpp"):
            with self.subTest(name=name):
                file = self.root / "certify" / name
                before = file.read_text()
                file.write_text(before + "\n")
                self.is_run()
                file.write_text(before)
        (self.coq / "loops/New.v").write_text((self.coq / "loops/Laws.v").read_text())
        self.is_run()
        (self.coq / "loops/New.v").unlink()
        (self.coq / "README.md").write_text("")  # proves nothing
        self.assertEqual(self.proofs().returncode, 0)

    def test_their_digest_is_written_where_all_has_passed(self):
        def run(*words, of_corpus=None):
            """With an answer of Coq in place of Coq."""
            with mock.patch.multiple(self.prove, self_test=mock.DEFAULT, check=mock.DEFAULT, tell=mock.DEFAULT,
                                     tell_corpus=mock.Mock(side_effect=of_corpus)), \
                    mock.patch.object(self.prove.Build, "compile"), mock.patch.object(sys, "argv", ["prove.py", *words]), \
                    mock.patch.dict(os.environ, self.environment):
                return self.prove.main()
        self.assertEqual(run(), 0)
        self.assertEqual(run("--program", "stiction", "--only", "loops"), 0)
        self.assertEqual(run("--program", "stiction", "--family"), 0)  # the night leaves the tree as it is
        self.assertEqual(run("--program", "stiction", of_corpus=self.prove.Failed("refused")), 1)
        self.assertFalse(self.prove.is_proved(self.coq))
        self.assertEqual(run("--program", "stiction"), 0)
        self.assertTrue(self.prove.is_proved(self.coq))


if __name__ == "__main__":
    unittest.main(verbosity=1)
