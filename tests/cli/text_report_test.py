# SPDX-License-Identifier: Apache-2.0
"""stiction report --text, and report A B: what is printed, what is written, and the exit code."""

import csv
import hashlib
import json
import os
import re
import shutil
import subprocess

import cli


class TextReport(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = cli.Path(cli.tempfile.mkdtemp(prefix="stiction-text-"))
        cls.addClassCleanup(shutil.rmtree, cls.made, ignore_errors=True)
        for name, arguments in {"low": ("--mu", "1/4", "--seed", 1), "high": ("--mu", "5", "--seed", 2),
                                "again": ("--mu", "5", "--seed", 3)}.items():
            cls.search(name, "--generator", "conditioned", "--contacts", 2, "--problems", 20000, "--finishing", 100, *arguments)
        cls.search("best", "--objective", "period", "--generator", "psd", "--contacts", 2, "--problems", 100)

    @classmethod
    def search(cls, name, *arguments):
        done = cli.run("search", "--store", cls.made / f"{name}.store", *arguments)
        assert done.code == 0, done.err
        setattr(cls, name, cls.made / f"{name}.store")
        setattr(cls, f"said_by_{name}", done.out)

    def test_a_search_ends_with_the_sentences_of_the_report(self):
        text = self.succeeds("report", self.high, "--text").out
        summary = self.succeeds("status", self.high).out
        self.assertEqual(self.said_by_high, summary)
        common = [line for line in summary.splitlines() if line in text.splitlines()]
        self.assertGreater(len(common), 10)
        loops = sum(count for signature, count in cli.total(self.high)[1].items() if signature.startswith("cycle-"))
        self.assertGreater(loops, 1)
        said = f" The published algorithm, under the policy paper, loops for ever in {loops} runs: "
        self.assertIn(said, " ".join(text.split()))
        self.assertIn(said, " ".join(summary.split()))
        self.assertLess(text.index("loops for ever"), text.index("Complete driving never failed"))
        more = summary[summary.index("\nMore as text") + 1:].splitlines()  # what stands before commands speaks of them
        self.assertRegex(more[0], "to check:$")
        self.assertEqual([line.split()[:2] for line in more[1:3]], [["stiction", "report"]] * 2)
        self.assertEqual(more[3:], ["More --minutes or --problems go on from here."])

    def test_the_text_fits_two_screens_and_all_of_it_is_asked_for(self):
        many = self.made / "many.store"
        if not many.exists():  # every usual generator, two policies
            campaign = self.file("c.json", {"format": "stiction-campaign", "version": 1, "unit_problems": 200,
                                            "policies": ["paper", "ties=contacts"]})
            self.search("many", campaign, "--problems", 5000, "--finishing", 1)
        for store in (self.high, many):
            said = subprocess.run([cli.program, "report", store, "--text"], capture_output=True, text=True,
                                  env=dict(os.environ, COLUMNS="80")).stdout
            self.assertLessEqual(len(said.splitlines()), 100)
            self.assertIn(f"report {store} --text --all", said)
            whole = self.succeeds("report", store, "--text", "--all").out
            self.assertIn("The same by friction coefficient", whole)
            self.assertIn("unit_problems: ", whole)
            self.assertNotIn("unit_problems: ", said)
        self.assertNotIn("Policy ties=contacts:", said)
        self.assertIn("Policy ties=contacts:", whole)
        self.refuses("report", self.high, "--all", "-o", self.folder / "out", says="found --all without --text")

    def test_the_commands_of_the_text_replay_its_loop(self):
        text = self.succeeds("report", self.high, "--text").out
        commands = [line.split() for line in text.splitlines() if line.startswith("    stiction ")]
        self.assertGreaterEqual(len(commands), 4)
        for command in commands:  # a replay that ends as its file expects exits with 0
            self.succeeds(*command[1:], cwd=self.folder)
        self.assertTrue((self.folder / "loop.html").exists())

    def test_commands_begin_as_the_program_was_called(self):
        called = dict(os.environ, STICTION_PROGRAM="../run")
        lopsided = self.file("lopsided.json", {"A": [[1, 0], [1, 1]], "b": [-1, 0], "mu": 1})
        for verb, words in (("report", ("report", self.high, "--text")), ("report", ("status", self.high)),
                            ("report", ("status", self.best)), ("certify", ("explain", lopsided)),
                            ("certify", ("solve", lopsided)), ("help", ("solve",)), ("search", ("status", "none.store"))):
            said = subprocess.run([cli.program, *words], env=called, capture_output=True, text=True)
            self.assertIn(f"../run {verb} ", said.stdout + said.stderr)
            plain = cli.run(*words)
            self.assertEqual((said.stdout + said.stderr).replace("../run ", "stiction "), plain.out + plain.err)

    def test_a_difference_that_is_more_than_noise_exits_with_1(self):
        out = self.folder / "comparison"
        done = self.succeeds("report", self.low, self.high, "-o", out, code=1)
        self.assertIn("tests find a difference that is more than noise:", done.out)
        self.assertIn("runs that loop, confirmed exactly: more in B", " ".join(done.out.split()))
        narrow = subprocess.run([cli.program, "report", self.low, self.high], capture_output=True, text=True,
                                env=dict(os.environ, COLUMNS="80"))
        self.assertEqual((out / "comparison.txt").read_text(), narrow.stdout)
        with open(out / "comparison.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        loops = next(row for row in rows if row["measure"] == "loops" and not row["friction"])
        for side, store in (("a", self.low), ("b", self.high)):
            tally, = cli.total(store)[0].values()
            self.assertEqual(int(loops[f"{side}_of"]), tally["problems"])
        self.assertEqual(loops["more_than_noise"], "yes")
        for line in (out / "SHA256SUMS").read_text().splitlines():
            self.assertEqual(hashlib.sha256((out / line[66:]).read_bytes()).hexdigest(), line[:64])
        self.assertEqual(self.succeeds("report", self.low, self.high, code=1).out, done.out)

    def compared(self, a, b, out, code):
        self.succeeds("report", a, b, "-o", out, code=code)
        page = (out / "index.html").read_text()
        return page, json.loads(re.search(r'id="data">(.*?)</script>', page, re.S)[1])["figures"]

    def test_the_page_draws_the_cells_of_the_tables(self):
        out = self.folder / "comparison"
        page, figures = self.compared(self.low, self.high, out, 1)
        for name in ("comparison", "comparison_steps"):
            with open(out / f"{name}.csv", newline="") as file:
                columns, *rows = csv.reader(file)
            drawn = [["" if cell is None else str(cell) for cell in row] for row in figures[name]["rows"]]
            self.assertEqual((figures[name]["columns"], len(drawn)), (columns, len(rows)))
            for row, cells in zip(drawn, rows):
                self.assertEqual([cell if cell == wanted else float(cell) for cell, wanted in zip(row, cells)],
                                 [wanted if cell == wanted else float(wanted) for cell, wanted in zip(row, cells)])
        with open(out / "comparison.csv", newline="") as file:
            beyond = [row for row in csv.DictReader(file) if row["more_than_noise"] == "yes"]
        table = re.search(r"<table>\s*<caption>Differences that are more than noise.*?</table>", page, re.S)[0]
        self.assertEqual(table.count("<tr") - 1, len(beyond))
        for row in beyond:
            for side in "ab":
                self.assertIn(f"{int(row[side + '_count']):,} of {int(row[side + '_of']):,}", table)
        ids = re.findall(r'<section id="(\w+)"', page)
        self.assertEqual(ids, ["design", "noise", "rates", "steps", "again", "files"])
        self.assertIn("<li>mu: A: 1/4; B: 5</li>", page)

    def test_the_page_is_the_same_again_and_replaces_its_folder_as_a_whole(self):
        out = self.folder / "comparison"
        page, _ = self.compared(self.low, self.high, out, 1)
        sums = (out / "SHA256SUMS").read_text()
        self.assertEqual(sorted(line[66:] for line in sums.splitlines()),
                         ["comparison.csv", "comparison.txt", "comparison_steps.csv", "index.html"])
        self.assertNotEqual(self.compared(self.high, self.low, out, 1)[0], page)
        self.assertEqual(self.compared(self.low, self.high, out, 1)[0], page)
        self.assertEqual((out / "SHA256SUMS").read_text(), sums)
        (out / "mine.txt").write_text("of others")
        self.refuses("report", self.high, self.low, "-o", out, says="found 'mine.txt', which 'report' did not write")
        self.assertEqual((out / "index.html").read_text(), page)

    def test_the_page_says_what_is_noise(self):
        page, _ = self.compared(self.high, self.again, self.folder / "noise", 0)
        self.assertRegex(page, r"None of \d+ tests finds a difference that is more than noise\.</p>")
        self.assertNotIn("<caption>Differences that are more than noise", page)

    def test_two_seeds_of_one_campaign_differ_by_noise(self):
        done = self.succeeds("report", self.high, self.again)
        self.assertRegex(done.out, r"None of \d+ tests finds a difference that is more than noise")

    def test_what_cannot_be_compared_is_refused(self):
        self.refuses("report", self.high, self.high, says=["two stores of one campaign", "'merge'"])
        self.refuses("report", self.high, self.best, says=["best.store", "found an optimized search"])
        for option in (("--package", self.folder / "p"), ("--latex", "-o", self.folder / "o")):
            self.refuses("report", self.low, self.high, *option, says="found two stores, expected one")

    def test_an_optimized_search_has_its_best_as_text(self):
        done = self.succeeds("report", self.best, "--text")
        self.assertIn("objective period", done.out)
        self.assertEqual(done.out, self.succeeds("status", self.best).out)


if __name__ == "__main__":
    cli.main()
