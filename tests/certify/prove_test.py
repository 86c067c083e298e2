# SPDX-License-Identifier: Apache-2.0
"""certify/coq/prove.py refuses, before it asks Coq, sources that leave something unproved, and changed statements.

prove_test.py PATH_TO_STICTION SOURCES

Needs no Coq: what Coq refuses is tried by `./run prove` itself, on false proofs of its own.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

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


if __name__ == "__main__":
    unittest.main(verbosity=1)
