# SPDX-License-Identifier: Apache-2.0
"""certify --coq writes files for Coq: Headline.v is one; contacts of every kind; what it refuses.

coq_test.py PATH_TO_STICTION SOURCES

Where coqc and the compiled library are there, one file is given to Coq, which takes it, and refuses it altered. All
of the corpus is compiled by `./run prove` (certify/coq/corpus.py).
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv.pop(1)).resolve())
SOURCES = Path(sys.argv.pop(1)).resolve()
LIBRARY = SOURCES / "build" / "coq"

KINDS = {"dimension": 2, "contacts": [{"kind": "bilateral"}, {"kind": "frictionless"}, {"kind": "static", "mu": "1/2"},
                                      {"kind": "sliding", "mu": "3", "slip": "-1"}],
         "A": [[str(2 * (i == j)) for j in range(6)] for i in range(6)], "b": ["-1", "0", "2", "1/3", "-4", "0"]}


def certify(problem, *words):
    text = problem if isinstance(problem, str) else json.dumps(
        {"format": "stiction-problem", "version": 1, "name": "of-a-test", **problem})
    return subprocess.run([PROGRAM, "certify", "-", *words, "-o", "-"], input=text, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


def of_corpus(name, *words):
    return certify((SOURCES / "corpus" / f"{name}.json").read_text(), *words)


class Files(unittest.TestCase):
    def holds(self, done, *parts):
        self.assertEqual(done.returncode, 0, done.stderr)
        for part in parts:
            self.assertIn(part, done.stdout)

    def test_the_headline_is_what_is_written_of_it(self):
        done = of_corpus("cycle-every-policy-mu-1", "--claim", "counterexample", "--policy", "*", "--coq")
        self.holds(done)
        self.assertEqual(done.stdout, (SOURCES / "certify/coq/loops/Headline.v").read_text())

    def test_contacts_of_every_kind_and_the_witness_stand_in_a_file(self):
        self.holds(certify(KINDS, "--coq"),
                   "[Bilateral; Frictionless; Static (1 # 2); Sliding 3 [-1]]", "[-1; 0; 2; 1 # 3; -4; 0]",
                   "Definition forces : list Q := [1 # 2; 0; 0; 0; 2; 6].", "Theorem the_claim : solution_exists",
                   "Problem sha256:")

    def test_every_claim_has_its_theorem(self):
        self.holds(of_corpus("no-solution-scripted-wedge", "--coq"),
                   "no_solution the_problem", "[Break]", "[SlipMinus]")
        self.holds(of_corpus("two-contact-cycle", "--claim", "psd", "--coq"), "positive_semidefinite the_problem",
                   "Definition D : list Q := [7; 59 # 7; 58 # 59; 18 # 29]")
        self.holds(of_corpus("two-contact-cycle", "--claim", "h", "--coq"), "hypothesis_H the_problem")
        self.holds(of_corpus("two-contact-cycle", "--claim", "counterexample", "--coq"),
                   "loops_under_policies policies 4 the_problem", "(1, (3, 4))]",
                   "[Policy lowest restart lazy unfiled first drop_contact rescan by_sets kept]")

    def test_in_space_both_laws_have_a_theorem(self):
        name = "space/three-sliding-contacts"
        self.holds(of_corpus(name, "--law", "baraff", "--coq"), "Problem 3\n", "solution_exists the_problem")
        bound = json.loads(of_corpus(name).stdout)["witness"]["bound"].replace("/", " # ")
        self.holds(of_corpus(name, "--coq"), f"Definition bound : Q := {bound}.",
                   "Theorem the_claim : coulomb_solution_exists bound the_problem.")
        done = of_corpus(name, "--claim", "coulomb-exact", "--coq")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("coulomb-exact, expected with --coq one of solution-exists, coulomb-solution, no-solution, psd, h, "
                      "counterexample", " ".join(done.stderr.split()))

    def test_what_coq_has_no_theorem_for_is_refused(self):
        loop = of_corpus("three-contact-cycle-with-a-frictionless-one", "--claim", "counterexample", "--coq")
        self.assertEqual((loop.returncode, loop.stdout), (2, ""))
        self.assertIn("found frictionless, expected static", " ".join(loop.stderr.split()))
        for words, said in ((["--claim", "in-range"], "claim in-range"), (["--safe"], "found --coq with")):
            done = of_corpus("two-contact-cycle", *words, "--coq")
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn(said, done.stderr)

    @unittest.skipUnless(shutil.which("coqc") and (LIBRARY / "claims/Claims.vo").is_file(), "no coqc, or no library")
    def test_coq_takes_a_file_and_refuses_it_altered(self):
        text = of_corpus("two-contact-cycle", "--coq").stdout
        altered = text.replace("forces : list Q := [1;", "forces : list Q := [2;")
        self.assertNotEqual(text, altered)
        for body, taken in ((text, True), (altered, False)):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "Forces.v"
                path.write_text(body)
                done = subprocess.run(["coqc", "-q", "-w", "none", "-R", str(LIBRARY), "Stiction", str(path)],
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                self.assertEqual((done.returncode == 0, "Closed under the global context" in done.stdout),
                                 (taken, taken), done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
