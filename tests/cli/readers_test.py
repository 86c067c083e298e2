# SPDX-License-Identifier: Apache-2.0
"""What comes from outside: nothing crashes, no good answer is lost beside a bad file, and bad input is refused by name."""

import json
import os
import resource
import subprocess
import unittest

import cli

PROBLEMS = cli.ROOT / "tests" / "problems"
GOOD = cli.ROOT / "corpus" / "two-contact-cycle.json"


def run_bytes(*arguments):
    """Like cli.run, where names and outputs may be any bytes."""
    done = subprocess.run([cli.program.encode(), *(os.fsencode(a) for a in arguments)], stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=300)
    return done.returncode, done.stdout, done.stderr


def mass_block(n, touched):
    """Two contacts in the plane on a body of n velocities, whose masses are one dense block of fractions."""
    rows = [["1" if i == j else f"1/{999 + abs(i - j)}" for j in range(n)] for i in range(n)]
    entries = [[k % 2, k, 1] for k in touched]
    return {"factors": {"J": {"size": [2, n], "entries": entries}, "M": [rows], "w": [-1] * n}, "mu": 1}


class Readers(cli.TestCase):
    # ---- Crashes ---------------------------------------------------------------------------------------------

    def test_factors_whose_J_is_no_matrix_are_refused_by_name(self):
        file = PROBLEMS / "segv-factors-J.json"
        for verb in (["solve"], ["explain"], ["replay"], ["certify", "-o", "c.json"], ["export", "--format", "siconos-fc", "-o", "out.dat"],
                     ["import", "-o", "out.json"]):
            self.refuses(*verb, file, cwd=self.folder, says=f"{file}: factors.J: found 0, expected")
        done = self.succeeds("survey", file, "--json", code=2)
        self.assertIn("factors.J: found 0", done.json()[0]["error"])

    def test_an_A_of_zeros_with_a_load_ends_in_an_answer_by_every_method(self):
        for file in (PROBLEMS / "segv-newton-bodies.json", PROBLEMS / "segfault-explain-factors.json"):
            for method in ["newton-bodies", "auto", "fast", "complete", "lemke", "baraff", "enumerate", "proximal"]:
                done = cli.run("solve", file, "--method", method, "--json")
                self.assertIn(done.code, (1, 2, 3), (file.name, method, done.err))
            explained = self.succeeds("explain", file, "--json").json()
            self.assertIn("no-solution", [claim["certificate"] for claim in explained["claims"]])
            self.succeeds("explain", file)
            self.succeeds("survey", file, "--json")

    def test_a_survey_of_numbers_that_doubles_do_not_hold_says_what_was_not_tried(self):
        file = self.file("large.json", {"A": [[1, 0, 0], [0, 1, 0], [0, 0, "1e600"]], "b": [-1, 0, 0], "mu": 1})
        runs = self.succeeds("survey", file, "--json").json()[0]["runs"]
        self.assertEqual({run["outcome"] for run in runs}, {"not tried"})
        self.assertIn("in the range of double", runs[0]["reason"])
        self.assertIn("not tried", self.succeeds("survey", file).out)

    def test_explain_tells_what_else_is_known_of_numbers_that_doubles_do_not_hold(self):
        matrix = [[2, 1, 0], [1, 2, 0], [0, 0, "1e600"]]
        file = self.file("large.json", {"A": matrix, "b": [-1, 0, 0], "mu": 1, "dimension": 3})
        found = self.succeeds("explain", file, "--json").json()
        self.assertEqual((found["solve"]["outcome"], found["rank"]), ("not tried", 3))
        self.assertIn("A[2][2]", found["solve"]["reason"])
        self.assertNotIn("policies", found)
        self.assertIn("psd", [claim["certificate"] for claim in found["claims"]])
        self.assertNotIn("solve", [each["command"].split()[1] for each in found["next"]])
        text = cli.unwrapped(self.succeeds("explain", file).out)
        self.assertIn("Forces that meet the paper's conditions in space, (21) and (22), are found, exactly.", text)
        for claim, word in (("existence", "exists"), ("solution-exists", "solution-exists")):
            certificate = self.folder / f"{claim}.json"
            self.succeeds("certify", file, "--claim", claim, "-o", certificate)
            self.assertIn(f"accepted: {word},", self.succeeds("check", certificate, "--problem", file).out)

    def test_a_problem_of_no_contacts_has_a_method_a_sentence_and_a_survey(self):
        file = PROBLEMS / "empty.json"
        answer = self.succeeds("solve", file, "--json").json()
        self.assertEqual((answer["outcome"], answer["f"], answer["a"]), ("solved", [], []))
        self.assertNotEqual(answer["method"], "")
        self.assertIn("no contacts", cli.unwrapped(self.succeeds("solve", file).out))
        run = self.succeeds("survey", file, "--json").json()[0]["runs"][0]
        self.assertNotEqual(run["method"], "")
        for method in ["newton-bodies", "complete", "lemke", "baraff", "enumerate", "fast"]:
            done = cli.run("solve", file, "--method", method, "--json")
            if done.code != 2:
                answer = done.json()
                self.assertEqual((done.code, answer["outcome"], answer["method"]), (0, "solved", method))
                self.assertNotIn("reason", answer)
        self.succeeds("explain", file)

    # ---- Answers that are not lost ---------------------------------------------------------------------------

    def test_bytes_that_are_no_text_lose_no_answer(self):
        bad = self.folder / "bad.json"
        bad.write_bytes(b'{"A": [[1, 0], [0, 1]], "b": [-1, "\xff\xfe"], "mu": 1}')
        key = self.folder / "key.json"
        key.write_bytes(b'{"A": [[1, 0], [0, 1]], "b": [-1, 0], "mu": 1, "k\xffy": "\xc3"}')
        named = os.fsencode(self.folder) + b"/na\xffme.json"
        with open(named, "wb") as out:
            out.write(b'{"A": [[1, 0], [0, 1]], "b": [-1, 0], "mu": 1}')
        missing = os.fsencode(self.folder) + b"/none\xfe.json"
        code, out, _ = run_bytes("solve", "--json", GOOD, bad, key, named, missing, GOOD)
        answers = json.loads(out.decode())
        self.assertEqual(code, 2)
        self.assertEqual(["answer" in answer for answer in answers], [True, False, False, True, False, True])
        self.assertIn("\ufffd", answers[3]["file"])
        self.assertIn("none\ufffd.json: found nothing to read", answers[4]["error"])
        code, out, _ = run_bytes("survey", "--json", GOOD, bad, key, named, missing)
        self.assertEqual(code, 2)
        self.assertEqual(["runs" in entry for entry in json.loads(out.decode())], [True, False, False, True, False])
        code, out, _ = run_bytes("explain", "--json", named)
        self.assertEqual(code, 0)
        self.assertIn("\ufffd", json.loads(out.decode())["file"])
        for verb in ("solve", "explain", "replay", "certify"):
            for file in (bad, key, missing):
                code, out, err = run_bytes(verb, file)
                self.assertEqual((code, out), (2, b""), (verb, file, err))

    def test_numbers_that_are_not_finite_are_words_in_json(self):
        unit = PROBLEMS / "zero-work-unit-inf.json"  # whose errors are infinite over doubles
        for verb in ("survey", "explain"):
            self.succeeds(verb, unit, "--json")
        file = self.file("huge.json", {"A": [["1e-300", "1e300"], ["-1e300", 0]], "b": ["-1e300", "1e-300"], "mu": 1})
        other = self.file("beyond.json", {"A": [["1e400", 0], [0, "1e-400"]], "b": ["-1e900", "1e-900"], "mu": "1e500"})
        for verb in ("survey", "explain", "solve"):
            for name in (file, other):
                for more in ([], ["--method", "fast", "--arithmetic", "double"]) if verb == "solve" else ([],):
                    done = cli.run(verb, name, "--json", *more)
                    self.assertIn(done.code, (0, 1, 2, 3), (verb, name, done.err))
                    if done.code != 2:
                        json.loads(done.out, parse_constant=lambda word: self.fail(f"{word} is no JSON"))

    # ---- Numbers ---------------------------------------------------------------------------------------------

    def test_numbers_below_the_doubles_are_refused_or_kept(self):
        text = '{"A": [[%s, 0], [0, 1]], "b": [-1, 0], "mu": 1}'
        for number in ("1e-400", "-1e-99999", "2e-324"):
            self.refuses("solve", self.file("p.json", text % number),
                         says=[f"A[0][0]: found {number}, which is no double but 0", f'as a string, "{number}", it is exact'])
        self.refuses("solve", self.file("p.json", text % "1e-310"), says="A[0][0]: found 1e-310, where doubles have fewer")
        self.refuses("solve", self.file("p.json", text % "1e999"), says="A[0][0]: found 1e999, expected a number in the range")
        answer = self.succeeds("solve", self.file("p.json", text % '"1e-400"'), "--json").json()
        self.assertEqual(answer["f"][0], "1" + "0" * 400)
        scene = '{"format": "stiction-scene", "version": 1, "name": "s", "dimension": 2, "mu": %s, "bodies": []}'
        self.refuses("assemble", self.file("s.json", scene % "1e-400"), "-o", "-", says="mu: found 1e-400")
        self.refuses("solve", self.file("p.dat", "1 0 1 1 1 1\n1e-400\n-1\n"), says="found '1e-400'")
        factors = '{"factors": {"J": [[1, 0], [0, 1]], "M": [%s, 1], "w": [-1, 0]}, "mu": 1}'
        self.refuses("solve", self.file("p.json", factors % "1e-400"), says="factors.M[0]: found 1e-400")

    def test_options_take_fractions(self):
        scene = cli.ROOT / "corpus" / "scenes" / "stack.json"
        for name, step in (("fraction", "1/240"), ("decimal", repr(1 / 240))):
            self.succeeds("simulate", scene, "-o", self.folder / name, "--step", step, "--seconds", "1/60", "--no-svg")
        tables = [(self.folder / name / "bodies.csv").read_text() for name in ("fraction", "decimal")]
        self.assertEqual(*tables)
        for step in ("1/0", "1/-240", "1/", "1/1e3", "/240", "-1/240", "1/" + "9" * 400):
            self.refuses("simulate", scene, "-o", self.folder / "none", "--step", step, says=f"found '{step}'")

    # ---- Time ------------------------------------------------------------------------------------------------

    def test_a_store_with_times_below_zero_is_read_and_goes_on(self):
        store = self.folder / "a.store"
        search = ["search", "--store", store, "-g", "integers", "-c", "2", "--seed", "7"]
        self.succeeds(*search, "--problems", "200")
        times = json.dumps({name: -5 for name in ("generation", "doubles", "filtered", "exact", "compared", "finishing")})
        self.assertGreater(cli.change(store, "UPDATE work SET time = ?", (times,)), 0)
        self.succeeds("report", store, "-o", self.folder / "r", "--json")
        self.succeeds("status", store)
        self.succeeds("merge", self.folder / "b.store", store)
        self.succeeds(*search, "--problems", "400")

    def seconds_of(self, *arguments, code):
        """Of the processor."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = self.succeeds(*arguments, code=code, timeout=110)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return done, after.ru_utime - before.ru_utime

    def test_a_large_block_of_masses_in_fractions_is_read_without_its_inverse(self):
        done, seconds = self.seconds_of("solve", self.file("block.json", mass_block(100, [0, 1])), "--json", code=0)
        self.assertEqual(done.json()["outcome"], "solved")
        self.assertLess(seconds, 15)  # of a sanitized build too; a whole inverse takes a minute and more

    def test_seconds_end_the_reading_too(self):
        file = self.file("dense.json", mass_block(220, range(220)))
        done, seconds = self.seconds_of("solve", file, "--json", "--seconds", "1", code=3)
        self.assertEqual(done.json()["outcome"], "undecided")
        self.assertIn("stopped", done.json()["reason"])
        self.assertIn("stopped", self.succeeds("solve", file, "--seconds", "1", code=3, timeout=110).out)


class Extremes(cli.TestCase):
    """What is read and is beyond what can be said of it."""

    def test_a_scene_whose_problem_leaves_doubles_is_refused(self):
        pegs = {"format": "stiction-scene", "version": 1, "name": "x", "dimension": 2, "mu": "1",
                "bodies": [{"name": "pegs", "fixed": True}, {"name": "weight", "mass": "1", "inertia": "1/25"}],
                "contacts": [{"bodies": ["weight", "pegs"], "at": ["1/2", -1e300], "normal": ["0", "1"]}]}
        pin = {**pegs, "contacts": [], "joints": [{"kind": "pin", "bodies": ["weight", "pegs"], "at": [-1e300, "-2"]}]}
        for k, scene in enumerate((pegs, pin)):
            done = cli.run("simulate", self.file(f"{k}.json", scene), "-o", self.folder / f"run{k}", "--seconds", 0.05)
            self.assertEqual(done.code, 2, done.err)
            self.assertIn("beyond those that double holds", cli.unwrapped(done.err))

    def test_numbers_too_long_for_a_certificate_are_surveyed_and_explained(self):
        long = "1" * 41000 + "/" + "3" * 41001
        file = self.file("p.json", {"A": [[long, 0], [0, 1]], "b": [-1, 3], "mu": 1})
        for verb in ("survey", "explain"):
            done = cli.run(verb, file, "--json")
            self.assertIn(done.code, (0, 1, 3), done.err)
            self.assertIn("that a checker would take", done.out)
        self.refuses("certify", file, "--claim", "safe", "-o", self.folder / "c.json", says="no checker would take")


if __name__ == "__main__":
    cli.main()
