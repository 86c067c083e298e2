# SPDX-License-Identifier: Apache-2.0
"""stiction certify, check and minimize on files; the independent checker agrees."""

import json
import subprocess
import sys

import cli


class Certificates(cli.TestCase):
    def check(self, certificate, accepted):
        """Both checkers say the same."""
        done = self.succeeds("check", certificate, "--json", code=0 if accepted else 1)
        self.assertEqual([entry["accepted"] for entry in done.json()], [accepted])
        independent = subprocess.run([sys.executable, cli.ROOT / "certify/check_certificate.py", certificate],
                                     capture_output=True, text=True)
        self.assertEqual(independent.returncode, 0 if accepted else 1, independent.stdout + independent.stderr)
        return done.json()[0]

    def test_every_claim_and_its_negation(self):
        asymmetric = {**cli.SOLVED, "A": [["2", "1"], ["0", "3"]]}
        indefinite = {**cli.SOLVED, "A": [["1", "2"], ["2", "1"]]}
        outside = {**cli.SOLVED, "A": [["1", "1"], ["1", "1"]]}
        for problem, claim, certified in [
            (cli.SOLVED, "solution-exists", "solution-exists"),
            (cli.REFERENCE, "solution-exists", "solution-exists"),
            (cli.REFERENCE, "cycle", "cycle"),
            (cli.SOLVED, "symmetric", "symmetric"), (asymmetric, "symmetric", "not-symmetric"),
            (cli.SOLVED, "psd", "psd"), (indefinite, "psd", "not-psd"),
            (cli.SOLVED, "definite", "definite"), (outside, "definite", "not-definite"),
            (cli.REFERENCE, "counterexample", "counterexample"),
            (cli.SOLVED, "in-range", "in-range"), (outside, "in-range", "not-in-range"),
            (cli.SOLVED, "h", "h"), (outside, "h", "not-h"),
            (cli.SOLVED, "exists", "exists"), (cli.REFERENCE, "exists", "exists"),
        ]:
            with self.subTest(problem=problem["name"], claim=claim):
                file, out = self.file("p.json", problem), self.folder / "c.json"
                done = self.succeeds("certify", file, "-o", out, "--claim", claim, "--json").json()
                state = "proved" if claim == certified else "disproved"
                self.assertEqual((done["asked"], done["claim"], done["state"]), (claim, certified, state))
                self.assertEqual(json.loads(out.read_text())["claim"], certified)
                self.assertEqual(self.check(out, accepted=True)["claim"], certified)
                text = self.succeeds("certify", file, "-o", out, "--claim", claim).out
                named = "proved: " if claim == certified else f"disproved, {certified}: "
                self.assertRegex(text, f"^{out}: {claim}: {named}[^ ].*\n$")
                self.assertIn(f"{out}: accepted: {certified}", self.succeeds("check", out).out)

    def test_existence_without_forces(self):
        out = self.folder / "c.json"
        outside = self.file("p.json", {**cli.SOLVED, "A": [["1", "1"], ["1", "1"]]})
        indefinite = self.file("q.json", {**cli.SOLVED, "A": [["1", "2"], ["2", "1"]]})
        for file in (outside, indefinite):
            done = self.succeeds("certify", file, "-o", out, "--claim", "exists")
            self.assertRegex(done.out, f"^{out}: exists: disproved, no-solution: ")
            out.unlink()
        open_one = cli.ROOT / "tests/problems/rota.json"
        done = self.succeeds("certify", open_one, "-o", out, "--claim", "exists", code=3)
        self.assertRegex(done.out + done.err, "exists: not decided: ")
        asymmetric = self.file("r.json", {**cli.SOLVED, "A": [["2", "1"], ["0", "3"]]})
        sliding = cli.ROOT / "corpus/sliding/rod-without-solution.json"
        for file, says in [(asymmetric, "A[0][1]"), (sliding, "contacts[0].kind: found sliding")]:
            self.refuses("certify", file, "-o", out, "--claim", "exists", says=says)
        self.assertFalse(out.exists())

    def test_no_claim_is_made_without_a_witness(self):
        out = self.folder / "c.json"
        for problem, claim in [(cli.SOLVED, "cycle"), (cli.SOLVED, "counterexample")]:
            file = self.file("p.json", problem)
            done = self.succeeds("certify", file, "-o", out, "--claim", claim, code=1)
            self.assertRegex(done.out, f"^{claim}: disproved: under paper the published algorithm ends in solved after")
            self.assertIn(f"stiction replay {file}", done.out)
            done = self.succeeds("certify", file, "-o", out, "--claim", claim, "--json", code=1).json()
            self.assertEqual((done["asked"], done["state"], done["claim"]), (claim, "disproved", None))
            self.assertFalse(out.exists())

    def test_a_cycle_under_all_policies_that_show_it(self):
        out = self.folder / "c.json"
        file = self.file("p.json", cli.REFERENCE)
        counts = self.succeeds("replay", file, "--all-policies", "--json", code=1).json()["counts"]
        cycles, grid = counts["cycle"], sum(counts.values())
        for claim in ("cycle", "counterexample"):
            words = ("certify", file, "-o", out, "--claim", claim, "--policy", "*")
            said = self.succeeds(*words, code=1).out  # it does not hold of all
            self.assertIn(f"{claim}: disproved: {cycles:,} of {grid:,} policies loop; {grid - cycles} end in solved", said)
            self.assertEqual(self.succeeds("check", out, "--json").json()[0]["facts"]["policies"], cycles)
            done = self.succeeds(*words, "--json", code=1).json()
            self.assertEqual((done["state"], done["claim"]), ("disproved", claim))
            example = done["policies"].pop("example")
            self.assertEqual(done["policies"], {"asked": grid, "so": cycles, "certified": cycles,
                                                "otherwise": {"solved": grid - cycles}})
            self.assertEqual(self.succeeds("replay", file, "--policy", example, "--json").json()["outcome"], "solved")
        whole = cli.ROOT / "corpus/cycle-every-policy-mu-1.json"
        said = self.succeeds("certify", whole, "-o", out, "--claim", "cycle", "--policy", "*").out
        self.assertIn(f"cycle: proved: all {grid:,} policies loop", said)

    def test_the_counterexample_of_the_corpus(self):
        file, problem = cli.ROOT / "corpus/certificates/counterexample.json", cli.ROOT / "corpus/cycle-every-policy-mu-1.json"
        report = self.succeeds("check", file, "--problem", problem, "--json").json()[0]
        self.assertEqual((report["claim"], report["facts"]["policies"]), ("counterexample", 1536))
        for script in ("check_certificate.py", "check_runs.py"):
            done = subprocess.run([sys.executable, cli.ROOT / "certify" / script, file, "--problem", problem],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn(report["problem"], done.stdout)
        again = self.folder / "again.json"
        self.succeeds("certify", problem, "--claim", "counterexample", "--policy", "*", "-o", again)
        self.assertEqual(again.read_bytes(), file.read_bytes())

    def test_a_changed_certificate_is_rejected(self):
        out, bad = self.folder / "c.json", self.folder / "bad.json"
        self.succeeds("certify", self.file("p.json", cli.REFERENCE), "-o", out, "--claim", "cycle")
        text = out.read_text()
        for old, new in [('"65/63"', '"64/63"'), ('"cycle"', '"stall"'), ('"version": 1', '"version": 2')]:
            self.assertIn(old, text)
            bad.write_text(text.replace(old, new, 1))
            self.assertTrue(self.check(bad, accepted=False)["reason"])
        # One of several.
        done = self.succeeds("check", out, bad, out, code=1).out.splitlines()
        self.assertEqual([": REJECTED: " in line for line in done], [False, True, False])
        done = self.succeeds("check", out, bad, "--json", code=1).json()
        self.assertEqual([entry["accepted"] for entry in done], [True, False])

    def test_quietly_only_what_is_refused_is_told(self):
        out, bad = self.folder / "c.json", self.file("bad.json", {**cli.SOLVED})
        self.succeeds("certify", self.file("p.json", cli.SOLVED), "-o", out)
        self.assertEqual(self.succeeds("check", "--quiet", out, out).out, "")
        self.assertEqual(self.succeeds("check", "-q", out, "--json").json(), [])
        done = self.succeeds("check", "-q", out, bad, out, code=1)
        self.assertEqual([line.split(": ")[:2] for line in done.out.splitlines()], [[str(bad), "REJECTED"]])

    def test_json_that_is_no_certificate_is_rejected(self):
        for value in [{}, [], 3, None, cli.REFERENCE, {"format": "stiction-certificate", "version": 1}]:
            self.check(self.file("c.json", json.dumps(value)), accepted=False)

    def test_standard_output_holds_the_certificate_alone(self):
        file = self.file("p.json", cli.SOLVED)
        for arguments in [(), ("--json",)]:
            done = self.succeeds("certify", file, "-o", "-", *arguments)
            self.assertEqual(done.json()["claim"], "solution-exists")
            self.assertNotEqual(done.err, "")

    def test_a_certificate_that_cannot_be_written(self):
        file = self.file("p.json", cli.SOLVED)
        for verb in ("certify", "minimize"):
            for out in [self.folder / "no/such/c.json", self.folder]:
                self.refuses(verb, file, "-o", out, says=[out, "cannot be written"])
            done = cli.run(verb, file, "-o", "/dev/full")
            self.assertEqual(done.code, 74, done.err)
            self.assertIn("/dev/full: cannot be written", done.err)

    def test_a_claim_is_made_of_problems_of_its_kind_alone(self):
        sliding = cli.ROOT / "corpus" / "sliding" / "rod-without-solution.json"
        space = cli.ROOT / "corpus" / "space" / "cycle-under-both-slips.json"
        plane, out = self.file("p.json", cli.SOLVED), self.folder / "c.json"
        for file, words, says in [
                (sliding, ("--claim", "safe"), ["contacts[0].kind", "sliding", "frictionless or static: safety"]),
                (sliding, ("--claim", "safe-by-condition"), ["contacts[0].kind", "safety"]),
                (space, ("--claim", "safe"), ["dimension", "the plane only"]),
                (space, ("--claim", "counterexample"), ["dimension", "the plane only"]),
                (plane, ("--claim", "coulomb-solution"), ["dimension", "solution-exists"])]:
            self.refuses("certify", file, "-o", out, *words, says=[file, *says])
        for words in (("--safe",), ("--robust",)):
            self.refuses("certify", sliding, *words, says=["contacts[0].kind", "frictionless or static"])
        self.refuses("certify", space, "--all", says=["dimension", "the plane only"])

    def test_an_asymmetric_matrix_is_not_called_semidefinite(self):
        file = self.file("p.json", {**cli.SOLVED, "A": [["2", "1"], ["0", "3"]]})
        self.refuses("certify", file, "-o", self.folder / "c.json", "--claim", "psd")


class Minimize(cli.TestCase):
    def minimize(self, problem, *arguments):
        out = self.folder / "m.json"
        done = self.succeeds("minimize", self.file("p.json", problem), "-o", out, "--json", *arguments)
        return out, done.json()

    def test_the_result_shows_the_same_and_says_so(self):
        out, done = self.minimize(cli.REFERENCE)
        self.assertEqual(done["keep"], "cycle")
        key = ["contacts", "rows", "nonzeros", "bits"]
        self.assertLessEqual([done["after"][k] for k in key], [done["before"][k] for k in key])
        self.assertGreater(done["accepted"], 0)
        self.assertEqual(json.loads(out.read_text())["expect"], {"paper": "cycle"})
        self.succeeds("replay", out)
        self.assertEqual(self.succeeds("solve", out, "--json", "--method", "baraff", code=1).json()["assumptions"], [])

    def test_minimizing_again_changes_nothing(self):
        out, done = self.minimize(cli.REFERENCE)
        once = json.loads(out.read_text())
        again, done = self.minimize(once)
        self.assertEqual(done["accepted"], 0)
        twice = json.loads(again.read_text())
        for key in ("contacts", "A", "b"):
            self.assertEqual(twice[key], once[key])

    def test_another_policy_and_outcome(self):
        policy = "give-up=second"
        outcome = cli.run("solve", self.file("p.json", cli.REFERENCE), "--json", "--method", "baraff", "--policy", policy).json()["outcome"]
        out, done = self.minimize(cli.REFERENCE, "--policy", policy)
        self.assertEqual(done["keep"], outcome)
        self.succeeds("replay", out, "--policy", policy)

    def test_the_signature_can_be_kept(self):
        out, _ = self.minimize(cli.REFERENCE, "--keep-signature")
        result = self.succeeds("replay", out, "--json").json()
        self.assertEqual((result["period"], len([p for p in result["pivots"] if p["drive"] > result["start"]])), (4, 10))

    def test_the_whole_grid(self):
        out, done = self.minimize(cli.SOLVED, "--keep", "solved:*")
        self.assertEqual(done["after"]["contacts"], 0)
        self.assertEqual(json.loads(out.read_text())["expect"], {"*": "solved"})
        self.succeeds("replay", out, "--all-policies")
        self.refuses("minimize", self.file("p.json", cli.REFERENCE), "-o", "-", "--keep", "cycle:*",
                     says="not every policy")

    def test_standard_output_holds_the_problem_alone(self):
        done = self.succeeds("minimize", self.file("p.json", cli.REFERENCE), "-o", "-", "--json")
        self.assertEqual(done.json()["format"], "stiction-problem")
        self.assertEqual(json.loads(done.err)["keep"], "cycle")

    def test_what_the_problem_does_not_show_cannot_be_kept(self):
        self.refuses("minimize", self.file("p.json", cli.REFERENCE), "-o", "-", "--keep", "solved",
                     says="ends in cycle, not in solved")
        indefinite = {**cli.SOLVED, "A": [["1", "2"], ["2", "1"]]}
        self.refuses("minimize", self.file("p.json", indefinite), "-o", "-", says="minimize:")


if __name__ == "__main__":
    cli.main()
