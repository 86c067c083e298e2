# SPDX-License-Identifier: Apache-2.0
"""The page of a report: its numbers are those of the store, its commands run where they stand, a browser shows it.

report_page_test.py PATH_TO_STICTION [SOURCES]

The bundle is compared by viewer_test.py. What needs npm's packages is SKIPPED, with its reason, where npm reaches no
registry.
"""

import csv
import html
import json
import os
import re
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
from pathlib import Path

import cli
from viewer_test import Packages

POLICIES = ("paper", "ties=contacts")
CAMPAIGN = ("--seed", 3, "--generator", "scenes", "conditioned", "--contacts", 2, 3, "--mu", "1/2", "1", "2", "--policy", *POLICIES,
            "--audit-every", 500)
MANY = 10000


def tables(report):
    with open(report, newline="") as file:
        return list(csv.DictReader(file))


def add_findings(store, many):
    """Copies of one finding under signatures of their own, as a long search would leave them."""
    db = sqlite3.connect(store)
    columns = cli.SEALED["findings"].split(", ")
    row = db.execute(f"SELECT {', '.join(columns)} FROM findings WHERE kind = 'cycle' AND done = 1 LIMIT 1").fetchone()
    signatures = [f"{row[0]}@copy={number:05}" for number in range(many)]
    copies = [(signature, *row[1:], cli.seal("findings", (signature, *row[1:]))) for signature in signatures]
    with db:
        db.executemany(f"INSERT INTO findings ({', '.join(columns)}, seal) VALUES ({', '.join('?' * len(copies[0]))})", copies)
    unit, record = db.execute("SELECT unit, record FROM units ORDER BY unit LIMIT 1").fetchone()
    db.close()
    record = json.loads(record)
    record["signatures"].update({signature: 1 + number % 97 for number, signature in enumerate(signatures)})
    text = json.dumps(record, separators=(",", ":"), ensure_ascii=False)
    cli.change(store, "UPDATE units SET record = ? WHERE unit = ?", (text, unit))


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Page(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = Path(tempfile.mkdtemp(prefix="stiction-report-"))
        cls.addClassCleanup(shutil.rmtree, cls.pages, ignore_errors=True)
        cls.store = cls.pages / "small.store"
        for problems, report in ((20000, "earlier"), (80000, "small")):
            cls.must("search", *CAMPAIGN, "--problems", problems, "--store", cls.store, "--finishing", 100)
            cls.must("report", cls.store, "-o", cls.pages / report)
        cls.report = cls.pages / "small"
        cls.page = (cls.report / "index.html").read_text()

    @classmethod
    def must(cls, *arguments):
        done = cli.run(*arguments, timeout=900)
        if done.code != 0:
            raise AssertionError(f"{arguments}: exit {done.code}\n{done.err}")

    def data(self):
        return json.loads(re.search(r'id="data">(.*?)</script>', self.page, re.S)[1])

    def test_what_is_drawn_is_what_the_store_holds(self):
        tallies, _ = cli.total(self.store)
        outcomes = ["solved", "cycle", "stall", "ray", "singular", "limit", "undecided"]
        rates = {(row["by"], row["generator"], row["policy"], row["contacts"], row["value"], row["outcome"]): row
                 for row in tables(self.report / "figures/rates.csv")}
        seen = 0
        for (generator, contacts, policy, _method, _arithmetic), tally in tallies.items():
            exact = [sum(row[i] for row in tally["verdicts"]) for i in range(len(outcomes))]
            for outcome in ("cycle", "singular", "ray"):
                row = rates["contacts", generator, policy, str(contacts), str(contacts), outcome]
                self.assertEqual((int(row["count"]), int(row["runs"])),
                                 (exact[outcomes.index(outcome)], tally["problems"]))
                self.assertAlmostEqual(float(row["rate"]), 1e6 * int(row["count"]) / tally["problems"], delta=1e-5 * float(row["rate"]))
                self.assertLessEqual(float(row["low"]), float(row["rate"]))
                self.assertGreater(float(row["high"]), float(row["rate"]))
                seen += int(row["count"])
            steps = {int(row["steps"]): int(row["runs"]) for row in tables(self.report / "figures/steps.csv")
                     if (row["policy"], row["contacts"]) == (policy, str(contacts))}
            both = [other for key, other in tallies.items() if (key[1], key[2]) == (contacts, policy)]
            self.assertEqual(steps, {i: n for i, n in enumerate(sum(t["steps"][i] for t in both) for i in range(64)) if n})
        self.assertGreater(seen, 10)

    def test_the_first_sentence_counts_the_loops_of_the_store(self):
        tallies, _ = cli.total(self.store)
        loops = sum(sum(row[1] + row[2] for row in tally["verdicts"]) for tally in tallies.values())
        runs = sum(tally["problems"] for tally in tallies.values())
        self.assertIn(f"{loops:,} of {runs:,} runs repeat a state in exact arithmetic", self.page)

    def test_every_finding_of_the_table_is_in_the_data(self):
        rows = {row["signature"]: row for row in tables(self.report / "findings.csv") if row["state"] != "counted"}
        findings = self.data()["findings"]
        self.assertEqual(sorted(rows), sorted(finding["signature"] for finding in findings))
        for finding in findings:
            row = rows[finding["signature"]]
            self.assertEqual((finding["kind"], finding["met"], finding["state"], finding["contacts"], finding["files"][0]),
                             (row["kind"], int(row["count"]), row["state"], int(row["contacts"]), row["problem_file"]))

    def test_commands_run_in_the_folder_of_the_report(self):
        featured = re.search(r'<div class="featured">.*?<pre><code>(.*?)</code></pre>', self.page, re.S)[1]
        commands = html.unescape(featured).split("\n")
        self.assertEqual(len(commands), 3)
        setup = html.unescape(re.search(r'<pre class="setup"><code>(.*?)</code></pre>', self.page, re.S)[1])
        setup = setup.replace("/path/to/stiction/run", str(cli.program))
        folder = shutil.copytree(self.report, self.folder / "a report")
        for command in commands:
            done = subprocess.run(["bash", "-c", f"{setup}\n{command}"], cwd=folder, capture_output=True, text=True, timeout=300)
            self.assertEqual((done.returncode, done.stderr), (0, ""), command)
        self.assertTrue((folder / "replay.html").is_file())

    def test_the_campaign_can_be_searched_again_with_the_command_that_is_named(self):
        section = self.page[self.page.index('<section id="again">'):]
        commands = html.unescape(re.search(r"<pre><code>(.*?)</code></pre>", section, re.S)[1])
        folder = shutil.copytree(self.report, self.folder / "again")
        script = f'set -e; stiction() {{ {cli.program} "$@"; }}\n' + commands.replace("--store", "--finishing 0 --store")
        done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True, timeout=900)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("rates", "steps", "doubles", "trust", "pivoting", "loop-steps", "driving"):
            self.assertEqual((folder / f"again/figures/{name}.csv").read_bytes(), (self.report / f"figures/{name}.csv").read_bytes(), name)

    def test_an_earlier_report_that_is_none_is_refused(self):
        self.refuses("report", self.store, "-o", self.folder / "out", "--since", self.folder / "nowhere", says="nowhere")
        self.refuses("report", self.store, "-o", self.folder / "out", "--since", self.file("x.csv", "a,b\r\n"),
                     says="x.csv:1: found no column signature, expected findings.csv of a report")
        self.assertFalse((self.folder / "out").exists())

    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        packages = Packages.get()
        self.succeeds("report", self.store, "-o", self.pages / "since", "--since", self.pages / "earlier")
        large = self.pages / "large.store"
        shutil.copy(self.store, large)
        add_findings(large, MANY)
        self.succeeds("report", large, "-o", self.pages / "large", timeout=600)
        script = Path(__file__).with_name("report_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=900, env=dict(
            os.environ, PAGES=str(self.pages), PACKAGES=str(packages), BROWSER=browser))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 15, done.stdout[-2000:])


if __name__ == "__main__":
    cli.main()
