# SPDX-License-Identifier: Apache-2.0
"""One store says the same numbers in every medium: summary, JSON, text, page, figures, CSV, LaTeX, Python's tables.

numbers_test.py PATH_TO_STICTION [SOURCES]
"""

import csv
import html
import json
import re
import shutil
import tempfile
import unittest
from pathlib import Path

import cli

# With loops, wrong answers, and runs that doubles misjudge: numbers that are all different.
CAMPAIGN = ("--seed", 5, "--generator", "scenes", "near-degenerate", "integers", "--contacts", 2, 3, "--mu", "1", "2",
            "--policy", "paper", "ties=contacts", "--audit-every", 50, "--problems", 60000, "--finishing", 20)
SOLVED, CYCLE, STALL, UNDECIDED = 0, 1, 2, 6


def rows(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def plain(page):
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", "", page)))


def number(text):
    return int(text.replace(",", ""))


@unittest.skipIf(cli.SHORT, "reports are the same in every build")
class Numbers(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Path(tempfile.mkdtemp(prefix="stiction-numbers-"))
        cls.addClassCleanup(shutil.rmtree, cls.made, ignore_errors=True)
        cls.store, cls.report = cls.made / "one.store", cls.made / "one"
        cls.searched = cli.run("search", "--store", cls.store, *CAMPAIGN)
        assert cls.searched.code == 0, cls.searched.err
        done = cli.run("report", cls.store, "-o", cls.report, "--latex")
        assert done.code == 0, done.err
        tallies, signatures = cli.total(cls.store)
        cells = [(inexact, exact, count) for tally in tallies.values() for inexact, row in enumerate(tally["verdicts"])
                 for exact, count in enumerate(row)]
        cls.runs = sum(tally["problems"] for tally in tallies.values())
        cls.loops = sum(count for _, exact, count in cells if exact in (CYCLE, STALL))
        cls.differ = sum(count for inexact, exact, count in cells if inexact != exact and exact != UNDECIDED)
        cls.suspicious = sum(count for _, _, count in cells)
        cls.wrong = sum(tally["wrong"] for tally in tallies.values())
        cls.misjudged = sum(tally["misjudged"] for tally in tallies.values())
        cls.audited = sum(tally["audited"] for tally in tallies.values())
        found = sum(count for signature, count in signatures.items() if re.match("(safe-)?cycle-|stall-", signature))
        cls.by_audits = found - cls.loops  # loops that are in no rate

    def test_the_store_tells_these_numbers_apart(self):
        told = [self.runs, self.loops, self.differ, self.suspicious, self.wrong, self.audited]
        self.assertEqual(len(set(told)), len(told), told)
        self.assertGreater(min(told), 0, told)

    def test_json(self):
        summary = self.succeeds("status", self.store, "--json").json()
        failures = summary["failures"]
        self.assertEqual((summary["runs"], failures["doubles-differ"], failures["wrong-answer"]),
                         (self.runs, self.differ, self.wrong))
        self.assertEqual(failures["cycle"] + failures.get("stall", 0), self.loops)
        for name, count in failures.items():
            self.assertAlmostEqual(summary["rates"][name]["per_million"], 1e6 * count / self.runs)
        self.assertEqual((summary["suspicions"], summary["audited"], summary["misjudged"], summary["wrong"]),
                         (self.suspicious, self.audited, self.misjudged, self.wrong))

    def test_texts(self):
        for text in (self.searched.out, self.succeeds("status", self.store).out,
                     self.succeeds("report", self.store, "--text").out):
            flowing = re.sub(r"\s+", " ", text)
            self.assertEqual(number(re.search(r"loops for ever in ([\d,]+) runs", flowing)[1]), self.loops)
            differ = re.search(r"in ([\d,]+) runs they differ from exact arithmetic .*?, in ([\d,]+) runs? they call",
                               flowing)
            self.assertEqual((number(differ[1]), number(differ[2])), (self.differ, self.wrong))
            self.assertNotRegex(text, r"disagreement-\S+ +[\d,]+ +[\d,]+ +[\d.]+ \[")  # no rate of signatures

    def test_the_page_and_its_figures(self):
        page = plain("".join((self.report / name).read_text() for name in ("index.html", "results.html")))
        self.assertEqual(number(re.search(r"loops for ever in ([\d,]+) runs", page)[1]), self.loops)
        self.assertEqual(number(re.search(r"were run under .*?: ([\d,]+) runs", page)[1]), self.runs)
        self.assertEqual(number(re.search(r"([\d,]+) runs that loop, exactly", page)[1]), self.loops)
        differ = re.search(r"in ([\d,]+) runs they differ from exact arithmetic .*?, in ([\d,]+) runs? they call", page)
        self.assertEqual((number(differ[1]), number(differ[2])), (self.differ, self.wrong))
        rates = rows(self.report / "figures/rates.csv")
        for by in ("contacts", "friction", "rank"):
            mine = [row for row in rates if row["by"] == by and row["outcome"] == "loop"]
            self.assertEqual(sum(int(row["count"]) for row in mine), self.loops, by)
            self.assertEqual(sum(int(row["runs"]) for row in mine), self.runs, by)
        doubles = rows(self.report / "figures/doubles.csv")
        self.assertEqual(sum(int(row["runs"]) for row in doubles), self.suspicious)

    def test_tables(self):
        statistics, verdicts = rows(self.report / "statistics.csv"), rows(self.report / "verdicts.csv")
        self.assertEqual(sum(int(row["problems"]) for row in statistics), self.runs)
        self.assertEqual(sum(int(row["wrong"]) for row in statistics), self.wrong)
        self.assertEqual(sum(int(row["count"]) for row in verdicts if row["exact_outcome"] in ("cycle", "stall")),
                         self.loops)
        self.assertEqual(sum(int(row["count"]) for row in verdicts if row["exact_outcome"] not in
                             ("undecided", row["inexact_outcome"])), self.differ)
        strata = rows(self.report / "strata.csv")
        self.assertEqual(sum(int(row["exact_cycle"]) + int(row["exact_stall"]) for row in strata), self.loops)

    def test_latex(self):
        table, = [text for text in map(Path.read_text, self.report.rglob("*.tex")) if "tab:stiction-loops" in text
                  and "longtable" in text]
        lines = re.findall(r"^(?:\S+ & ){3}\d+ & ([\d,]+) & ([\d,]+) &", table, re.M)
        self.assertEqual(sum(number(runs) for runs, _ in lines), self.runs)
        self.assertEqual(sum(number(loops) for _, loops in lines), self.loops)

    def test_ends_of_intervals_are_rounded_outward(self):
        for row in rows(self.report / "figures/rates.csv"):
            self.assertLessEqual(float(row["low"]), float(row["rate"]))
            self.assertGreaterEqual(float(row["high"]), float(row["rate"]))
        page = plain((self.report / "index.html").read_text())
        rate, low, high = re.search(r"loops for ever in [\d,]+ runs: ([\d.,]+) \[([\d.,]+), ([\d.,]+)\] in a million", page).groups()
        summary = self.succeeds("status", self.store, "--json").json()
        if set(summary["failures"]) >= {"cycle"} and "stall" not in summary["failures"]:
            exact = summary["rates"]["cycle"]["interval"]
            self.assertLessEqual(float(low.replace(",", "")), exact["low"])
            self.assertGreaterEqual(float(high.replace(",", "")), exact["high"])

    def test_equal_searches_give_equal_reports_but_for_their_work(self):
        again, out = self.made / "again.store", self.made / "again"
        self.succeeds("search", "--store", again, *CAMPAIGN, "--threads", 2)
        self.succeeds("report", again, "-o", out, "--latex")
        names = {file.relative_to(self.report) for file in self.report.rglob("*") if file.is_file()}
        self.assertEqual(names, {file.relative_to(out) for file in out.rglob("*") if file.is_file()})
        different = {str(name) for name in names if (self.report / name).read_bytes() != (out / name).read_bytes()}
        self.assertLessEqual(different, {"work.csv"})
        self.assertNotIn("work.csv", (out / "SHA256SUMS").read_text())


if __name__ == "__main__":
    cli.main()
