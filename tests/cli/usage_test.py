# SPDX-License-Identifier: Apache-2.0
"""Help, bad usage, and what happens to output that nobody reads."""

import math
import subprocess

import cli

VERBS = ["search", "replay", "report", "solve", "certify", "check", "minimize", "status", "merge", "problem", "import",
         "export", "survey", "assemble", "simulate", "draw", "policies", "records", "bench", "slurm", "methods", "words", "manual"]

# The first value is the reference policy.
SWITCHES = {
    "scan": ["lowest", "normals-first", "most-violated", "highest"],
    "resume": ["restart", "round"],
    "admit": ["lazy", "eager"],
    "file": ["no", "yes"],
    "give-up": ["first", "previous", "second"],
    "drop": ["contact", "variable"],
    "rezero": ["rescan", "continue"],
    "ties": ["sets", "contacts"],
    "apex": ["kept", "suspended"],
    "slip": ["literal", "redirect", "polygon"],
}


def all_verbs():
    return [verb["verb"] for verb in cli.run("manual", "--json").json()]


class Usage(cli.TestCase):
    def test_help_of_the_program_names_every_verb_and_the_exit_codes(self):
        done = self.succeeds("--help")
        self.assertEqual(done.err, "")
        self.assertLessEqual(set(VERBS), set(all_verbs()))
        for verb in all_verbs():
            self.assertRegex(done.out, rf"(?m)^  {verb} ")
        self.assertIn("Exit: 0", done.out)

    def test_help_of_every_verb(self):
        for verb in all_verbs():
            with self.subTest(verb=verb):
                done = self.succeeds(verb, "--help")
                self.assertIn("Usage:", done.out)
                self.assertEqual(done.err, "")
                self.assertEqual(self.succeeds(verb, "-h").out, done.out)

    def test_no_line_of_a_help_is_wider_than_a_terminal(self):
        for verb in [(), *((verb,) for verb in all_verbs())]:
            for line in self.succeeds(*verb, "--help").out.splitlines():
                self.assertLessEqual(len(line), 80, f"{verb}: {line}")

    def test_help_says_range_unit_default_and_choices(self):
        text = " ".join(self.succeeds("solve", "--help").out.split())
        self.assertIn("--max-pivots INTEGER budget of a run (steps; 1 to 1e+12; default 100000)", text)
        self.assertIn("lemke: Lemke's complementary pivoting, lexicographic", text)
        self.assertIn("no-solution, cycle, ray, singular (exit 1); limit, undecided (exit 3)", text)
        self.assertIn("-o, --output TEXT certificate to write", " ".join(self.succeeds("certify", "--help").out.split()))

    def test_version(self):
        self.assertRegex(self.succeeds("--version").out, r"^stiction \d+\.\d+\.\d+ [0-9a-z-]+, .+\n$")

    def test_a_mistyped_word_is_named_with_the_nearest_one(self):
        for arguments, says in [(("serch",), "did you mean search?"), (("minimise", "x"), "minimize"), (("status", "x", "--jsn"), "--json"),
                                (("search", "--minuets", 1), "--minutes"), (("status", "x", "y"), "'y'")]:
            with self.subTest(arguments=arguments):
                self.refuses(*arguments, says=[f"found '{arguments[0]}'" if len(arguments) == 1 else "found", says])
        self.assertNotIn("did you mean", self.refuses("xyzzy").err)
        self.assertNotIn("did you mean", self.refuses("status", "x", "--entirely-else").err)

    def test_a_number_that_is_none_or_out_of_range(self):
        for option, value, says in [("--max-drives", "0", "from 1 to 1e+12"), ("--max-bits", "7x", "an integer"),
                                    ("--force-tolerance", "1", "a number from 0 to 0.01"), ("--sides", "1.5", "an integer")]:
            with self.subTest(option=option, value=value):
                self.refuses("solve", "x", option, value, says=[option, f"found '{value}'", says])

    def test_bad_usage(self):
        problem = self.file("problem.json", cli.SOLVED)
        for arguments in [
            ("solv",), ("--nonsense",), ("help", "slove"),
            ("solve",), ("replay",), ("certify",), ("check",), ("minimize",), ("status",), ("merge",), ("report",),
            ("solve", problem, "--nonsense"), ("replay", problem, problem),
            ("certify", problem), ("minimize", problem), ("merge", self.folder / "out"),
            ("report", self.folder / "a.store"),
            ("solve", problem, "--policy"), ("solve", problem, "--policy", "scan=lowst"),
            ("replay", problem, "--policy", "*"), ("replay", problem, "--policy", "scan=lowest,scan=highest"),
            ("solve", problem, "--max-drives", "0"), ("solve", problem, "--max-bits", "x"),
            ("solve", problem, "--force-tolerance", "-1"), ("solve", problem, "--force-tolerance", "nan"),
            ("certify", problem, "-o", self.folder / "c", "--claim", "nonsense"),
            ("minimize", problem, "-o", self.folder / "m", "--keep", "nonsense"),
            ("policies", "x"), ("bench", "--suite", "nonsense"), ("bench", "--contacts", "9"), ("bench", "--repeat", "0"),
            ("bench", "--seed", "-1"), ("bench", "--generator", "nonsense"), ("bench", "--problems", "0"),
        ]:
            with self.subTest(arguments=arguments):
                self.refuses(*arguments)

    def test_wrong_uses_end_in_one_line_that_says_what_was_found_and_what_was_expected(self):
        problem, out = self.file("problem.json", cli.SOLVED), self.folder / "out"
        number = iter(range(100))

        def changed(**keys):
            return self.file(f"changed-{next(number)}.json", dict(cli.SOLVED, **keys))

        folder = self.folder / "folder"
        folder.mkdir()
        nothing, text, empty = self.folder / "none", self.file("text.json", "hello"), self.file("empty.json", "")
        uses = [
            (("help", "slove"), ["'slove'", "solve?"]),
            (("solv", problem), ["'solv'", "solve?"]),
            (("--nonsense",), ["'--nonsense'", "expected a verb"]),
            (("solve",), ["solve: found no FILE", "expected it"]),
            (("merge", out), ["merge: found no STORE"]),
            (("report", nothing), ["report: found none of -o"]),
            (("report", nothing, "--text", "--files", "3"), ["report: found --files alone", "expected -o"]),
            (("report", nothing, "--package", out, "--latex"), ["report: found --latex alone", "expected -o"]),
            (("report", nothing, nothing, "--files", "3"), ["report: found two stores", "--files"]),
            (("survey",), ["survey: found no PATH"]),
            (("solve", problem, "--nonsense"), ["--nonsense", "none of its options"]),
            (("solve", problem, "--polcy", "paper"), ["--polcy", "--policy?"]),
            (("replay", problem, problem), ["expected nothing more"]),
            (("policies", "x"), ["'x'", "expected nothing more"]),
            (("solve", nothing), [nothing, "No such file", "expected a file"]),
            (("solve", self.folder), ["a directory", "expected a file"]),
            (("solve", text), [text, "line 1, column 1", "expected JSON"]),
            (("solve", empty), [empty, "line 1, column 1"]),
            (("draw", text, "-o", out), ["line 1, column 1"]),
            (("solve", problem, "--policy"), ["--policy: found nothing behind it"]),
            (("solve", problem, "--policy", "scan=lowst"), ["'lowst'", "lowest"]),
            (("solve", problem, "--policy", "scna=lowest"), ["'scna=lowest'", "scan"]),
            (("solve", problem, "--method", "lemk"), ["'lemk'", "did you mean lemke?"]),
            (("solve", problem, "--arithmetic", "doubel"), ["'doubel'", "did you mean double?"]),
            (("solve", problem, "--max-drives", "0"), ["--max-drives: found '0'", "from 1"]),
            (("solve", problem, "--max-bits", "x"), ["--max-bits: found 'x'", "an integer"]),
            (("solve", problem, "--force-tolerance", "nan"), ["found 'nan'", "a number"]),
            (("solve", problem, "--seconds", "-1"), ["found '-1'", "from 0"]),
            (("solve", problem, "--residual", "two"), ["found 'two'", "a number"]),
            (("solve", problem, "--sides", "5"), ["found '5'", "a multiple of 4"]),
            (("solve", changed(contacts=[{"kind": "static", "mu": "-1"}])), ["contacts[0].mu", '"-1"', "mu >= 0"]),
            (("solve", changed(contacts=[{"kind": "static"}])), ["contacts[0].mu", "found nothing"]),
            (("solve", changed(contacts=[{"kind": "statik", "mu": "1"}])), ["contacts[0].kind", '"statik"', "static"]),
            (("solve", changed(b=["1"])), ["b: found 1 numbers", "expected 2"]),
            (("solve", changed(A=[["1", "2"]])), ["A: found 1 rows", "expected 2"]),
            (("solve", changed(b=["one", "1"])), ["b[0]", '"one"', "a number"]),
            (("solve", changed(b=["1/0", "1"])), ["b[0]", '"1/0"', "denominator"]),
            (("solve", changed(friction=1)), ["friction: found an unknown key"]),
            (("solve", changed(version=9)), ["version: found 9", "expected 1"]),
            (("solve", changed(format="stiction-scene")), ["A, b: found unknown keys", "bodies"]),
            (("solve", changed(format="stiction-certificate")), ['"stiction-problem"', "stiction check"]),
            (("replay", problem, "--policy", "*"), ["found '*'"]),
            (("replay", problem, "--method", "enumerate"), ["'enumerate'", "expected one of"]),
            (("replay", problem, "--all-policies", "--method", "lemke"), ["expected --method baraff"]),
            (("replay", problem, "--record", "x"), ["--record", "--all-policies"]),
            (("certify", problem), ["expected -o CERT"]),
            (("certify", problem, "-o", out, "--claim", "solution"), ["'solution'", "expected one of"]),
            (("minimize", problem, "-o", out, "--keep", "cycel"), ["'cycel'", "cycle"]),
            (("minimize", problem, "-o", out, "--keep", "cycle"), ["solved, not in cycle"]),
            (("search", "--minutes", "0"), ["--minutes: found '0'", "above 0"]),
            (("search", "--problems", "1e3"), ["--problems: found '1e3'", "an integer"]),
            (("search", "--generator", "integer", "--store", out), ["'integer'", "did you mean integers?"]),
            (("search", "--generator", "integers,psd", "--store", out), ["'integers,psd'", "blanks between them"]),
            (("search", "--contacts", "9", "--store", out), ["found '9'", "from 1 to 8"]),
            (("search", "--mu", "-1", "--problems", "1", "--store", out), ["found '-1'", "p/q"]),
            (("search", "--shard", "2/2", "--problems", "1", "--store", out), ["found '2/2'", "0 <= i < N"]),
            (("search", problem, "--problems", "1", "--store", out), ['"stiction-problem"', '"stiction-campaign"']),
            (("status", nothing), [nothing, "found no such store", "stiction search --store"]),
            (("status", text), [text, "expected a store"]),
            (("slurm", "x.json", "--shards", "0", "--problems", "1", "-o", out), ["--shards: found '0'"]),
            (("problem", nothing, "0"), ["expected either STORE UNIT INDEX"]),
            (("export", problem, "-o", out, "--format", "siconos"), ["'siconos'", "siconos-lcp"]),
            (("assemble", problem, "-o", out), ["scene: found nothing", "expected the scene"]),
            (("manual", "--format", "html"), ["'html'", "man, man-bench, bash"]),
            (("--vesion",), ["'--vesion'", "did you mean --version?"]),
            (("solve", ""), ["''", "No such file", "expected a file"]),
            (("replay", problem, "-"), ["'-'", "expected nothing more"]),
            (("replay", "--", problem, problem), ["expected nothing more"]),
            (("solve", problem, "--json=maybe"), ["--json: found a value", "expected none"]),
            (("solve", problem, "--json=1"), ["--json: found a value", "expected none"]),
            (("solve", problem, "--method="), ["--method: found nothing behind it"]),
            (("solve", problem, "--policy", "scan=highst"), ["'highst'", "did you mean highest?"]),
            (("solve", problem, "--policy", "file=yes,dorp=contact"), ["'dorp=contact'", "did you mean drop?"]),
            (("solve", problem, "--policy", "papr"), ["'papr'", "did you mean paper?"]),
            (("solve", problem, "--policy", ""), ["found ''", "expected 'paper' or switches"]),
            (("minimize", problem, "-o", out, "--keep", "cylce:*"), ["'cylce:*'", "did you mean cycle?"]),
            (("survey", folder), [f"found no problem file in {folder}", "expected files named *.json"]),
            (("survey", folder, folder, "--json"), ["found no problem file in", "expected"]),
            (("survey", nothing), [nothing, "No such file", "expected a file"]),
            (("survey", problem, "--rows", "-1"), ["--rows: found '-1'", "from 0"]),
            (("search", "--problems", "1", "--store", folder), [folder, "a directory"]),
            (("search", "--problems", "1", "--store", nothing / "a.store"), [nothing, "No such file"]),
            (("search", "--problems", "1", "--store", text), ["expected a store"]),
            (("search", "--problems", "1", "--store", "-"), ["found standard input", "expected a store in a file"]),
            (("search", "--objective", "fold", "--store", out), ["'fold'", "did you mean folds?"]),
            (("search", "--seed", "-1", "--store", out), ["--seed: found '-1'", "2^64"]),
            (("search", nothing), [nothing, "expected a file"]),
            (("search", "--minutes", "inf", "--store", out), ["--minutes: found 'inf'"]),
            (("status", "-"), ["found standard input", "expected a store in a file"]),
            (("merge", out, "-"), ["found standard input", "expected a store in a file"]),
            (("report", "-", "--text"), ["found standard input", "expected a store in a file"]),
            (("report", text, "--text"), ["expected a store"]),
            (("problem", "-", "0", "0"), ["found standard input", "expected a store in a file"]),
            (("problem", nothing, "one", "0"), ["UNIT: found 'one'", "an integer"]),
            (("records", "--chek"), ["--chek", "did you mean --check?"]),
            (("words", "fold"), ["words: found 'fold'", "expected nothing more"]),
            (("check", nothing), [nothing, "expected a file"]),
            (("simulate", problem, "-o", out), ["scene: found nothing", "expected the scene"]),
            (("simulate", problem, "-o", out, "--frames", "0"), ["--frames: found '0'", "from 1"]),
            (("draw", problem), ["draw: found no --output"]),
            (("bench", "--suite", "searhc"), ["'searhc'", "did you mean search?"]),
            (("bench", "--sute", "search"), ["--sute", "did you mean --suite?"]),
            (("bench", "--generator", "smal"), ["'smal'", "did you mean small?"]),
            (("bench", "--", "x", "--suite"), ["found '--suite'", "expected nothing more"]),
            (("bench", "search"), ["bench: found 'search'", "expected nothing more"]),
            (("bench", "--suite", "search", "--contacts", "9"), ["--contacts: found 9", "expected 1 to 8"]),
            (("bench", "--suite", "problems", "--families", "tower"), ["tower", "expected"]),
            (("bench", "--suite", "scenes", "--scenes", nothing), [nothing, "expected a folder"]),
            (("bench", "--repeat", "many"), ["--repeat: found 'many'", "an integer from 1 to 1000"]),
        ]
        self.assertGreaterEqual(len(uses), 50)
        for arguments, says in uses:
            with self.subTest(arguments=arguments):
                err = self.refuses(*arguments, says=says).err
                self.assertRegex(err, r"^stiction: [^\n]+\n$")
                self.assertFalse(out.exists())

    def test_a_hyphen_is_standard_input_wherever_a_file_is_read(self):
        def reads(text, *arguments, code=0):
            done = subprocess.run([cli.program, *map(str, arguments)], input=text, text=True, capture_output=True,
                                  cwd=self.folder)
            self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr}")
            return done.stdout

        problem, scene = cli.ROOT / "corpus/two-contact-cycle.json", cli.ROOT / "corpus/scenes/block-in-a-valley.json"
        self.succeeds("certify", problem, "-o", self.folder / "c.json")
        self.succeeds("export", problem, "-o", self.folder / "x.dat", "--format", "siconos-fc")
        campaign = (cli.ROOT / "search/campaigns/scenes.json").read_text()
        problem, scene = problem.read_text(), scene.read_text()
        for arguments in [("solve", "-"), ("replay", "-"), ("replay", "-", "--all-policies"), ("survey", "-"),
                          ("certify", "-", "-o", "c2.json"), ("minimize", "-", "-o", "m.json"),
                          ("check", "c.json", "--problem", "-"), ("export", "-", "-o", "y.dat", "--format", "siconos-fc")]:
            reads(problem, *arguments)
        for arguments in [("assemble", "-", "-o", "a.json"), ("draw", "-", "-o", "d.svg"), ("replay", "-"),
                          ("simulate", "-", "-o", "run", "--seconds", 0.01)]:
            reads(scene, *arguments, code=1 if arguments[0] == "replay" else 0)
        self.assertIn("accepted", reads((self.folder / "c.json").read_text(), "check", "-"))
        reads((self.folder / "x.dat").read_text(), "import", "-", "-o", "i.json")
        reads(campaign, "slurm", "-", "--shards", 2, "--problems", 100_000_000, "-o", "jobs")
        reads(campaign, "search", "-", "--problems", 1, "--finishing", 0, "--store", "a.store")

    def test_behind_two_hyphens_no_word_is_an_option(self):
        self.file("--problem", cli.SOLVED)
        self.assertIn("solved", self.succeeds("solve", "--", "--problem", cwd=self.folder).out)

    def test_files_that_cannot_be_read(self):
        out = self.folder / "out"
        broken = self.file("broken.json", '{"format": ')
        for before, after in [(["solve"], []), (["replay"], []), (["replay", "--all-policies"], []),
                              (["certify"], ["-o", out]), (["minimize"], ["-o", out]), (["check"], [])]:
            for file, says in [(self.folder / "none.json", "No such file"), (self.folder, "a directory"),
                               (broken, "line 1, column 12"), (self.file("empty.json", ""), "line 1, column 1"),
                               (self.file("nul.json", "{\0}"), "NUL")]:
                with self.subTest(verb=before, file=file.name):
                    self.refuses(*before, file, *after, says=[file, says])
                    self.assertFalse(out.exists())

    def test_an_unreadable_file(self):
        file = self.file("secret.json", cli.SOLVED)
        file.chmod(0)
        try:
            file.read_text()
            self.skipTest("this user may read everything")
        except PermissionError:
            self.refuses("solve", file, says=[file, "Permission denied"])

    def test_policies_are_those_of_the_specification(self):
        rows = self.succeeds("policies", "--json").json()
        self.assertEqual([row["switch"] for row in rows], list(SWITCHES))
        for row in rows:
            values = [value["value"] for value in row["values"]]
            self.assertEqual(sorted(values), sorted(SWITCHES[row["switch"]]))
            self.assertEqual(values[0], SWITCHES[row["switch"]][0])
            self.assertTrue(row["reads"] and row["question"] and all(v["meaning"] for v in row["values"]))
        self.assertEqual([row["switch"] for row in rows if not row["planar"]], ["slip"])
        grid = math.prod(len(row["values"]) for row in rows if row["planar"])
        text = self.succeeds("policies").out
        self.assertIn(f"Planar grid: {grid} policies", " ".join(text.split()))
        for values in SWITCHES.values():
            for value in values:
                self.assertIn(f"    {value} ", text)

    def test_output_that_cannot_be_written_is_not_success(self):
        problem = self.file("problem.json", cli.SOLVED)
        for arguments in [("policies",), ("policies", "--json"), ("solve", problem, "--json"), ("replay", problem)]:
            with self.subTest(arguments=arguments):
                with open("/dev/full", "w") as full:
                    done = subprocess.run([cli.program, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE)
                self.assertEqual(done.returncode, 74, done.stderr)
                self.assertIn(b"output", done.stderr)

    def test_a_reader_that_goes_away_is_no_internal_error(self):
        problem = self.file("problem.json", cli.REFERENCE)
        done = subprocess.run(["bash", "-c", '"$0" replay --all-policies "$1" | head -n 1; echo ${PIPESTATUS[0]}',
                               cli.program, problem], capture_output=True, text=True)
        self.assertNotIn("internal error", done.stderr)
        self.assertIn(done.stdout.split()[-1], ["1", "141"])  # all was written before, or SIGPIPE

    def test_a_note_that_is_no_line_is_refused_with_what_was_found(self):
        self.refuses("search", "--note", "two\nlines", "--store", self.folder / "a.store",
                     says=["--note: found", "expected one line of text"])
        self.assertFalse((self.folder / "a.store").exists())


if __name__ == "__main__":
    cli.main()
