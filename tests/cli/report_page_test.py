# SPDX-License-Identifier: Apache-2.0
"""The page of a report: its numbers are those of the store, its commands run where they stand, a browser shows it.

report_page_test.py PATH_TO_STICTION [SOURCES]

What needs npm's packages is SKIPPED, with its reason, where npm reaches no
registry.
"""

import base64
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
import zlib
from pathlib import Path

import cli
from viewer_test import Packages

POLICIES = ("paper", "ties=contacts")
CAMPAIGN = ("--seed", 6, "--generator", "integers", "scenes", "conditioned", "--contacts", 2, 3, "--mu", "1/2", "1",
            "2", "--policy", *POLICIES, "--audit-every", 500)
OUTCOMES = ("solved", "cycle", "stall", "ray", "singular", "limit", "undecided")
MANY = 10000
# As bench --csv writes it.
RUNGS = """\
family,setting,method,arithmetic,problems,solved,undecided,other,refused,wrong,wrong_share_low,wrong_share_high,\
silent,silent_share_low,silent_share_high,microseconds_low,microseconds_median,microseconds_high,residual_low,\
residual_median,residual_high,worst_residual
masses,8,complete,double,25,20,3,1,1,2,0,0.2,1,0,0.1,1.5,2.5,3.5,0,1e-17,1e-16,2e-16
masses,8,complete,filtered,25,24,0,1,0,0,0,0.2,0,0,0.1,7,8.5,9,0,0,0,0
"""


# Of a report of a store.
PAGES = ("index.html", "results.html", "findings.html")


def pages(report):
    """The text of all pages of a report."""
    return "".join((report / name).read_text() for name in PAGES)


def tables(report):
    with open(report, newline="") as file:
        return list(csv.DictReader(file))


def exact_outcomes(tally):
    """How the runs that were repeated on suspicion end exactly, by outcome; rows of the record end where zeros do."""
    return [sum(row[i] for row in tally["verdicts"] if i < len(row)) for i in range(len(OUTCOMES))]


def add_findings(store, many):
    """Copies of one finding under signatures of their own, as a long search would leave them."""
    db = sqlite3.connect(store)
    columns = cli.SEALED["findings"].split(", ")
    row = db.execute(f"SELECT {', '.join(columns)} FROM findings WHERE kind = 'cycle' AND done = 1 LIMIT 1").fetchone()
    signatures = [f"{row[0]}@copy={number:05}" for number in range(many)]
    copies = [(signature, *row[1:], cli.seal("findings", (signature, *row[1:]))) for signature in signatures]
    keys = cli.SEALED["units"].split(", ")
    unit = dict(zip(keys, db.execute(f"SELECT {', '.join(keys)} FROM units ORDER BY unit LIMIT 1").fetchone()))
    record = json.loads(unit["record"])
    record["signatures"].update({signature: 1 + number % 97 for number, signature in enumerate(signatures)})
    unit["record"] = json.dumps(record, separators=(",", ":"), ensure_ascii=False)
    with db:
        db.executemany(f"INSERT INTO findings ({', '.join(columns)}, seal) VALUES ({', '.join('?' * len(copies[0]))})",
                       copies)
        db.execute("UPDATE units SET record = ?, seal = ? WHERE unit = ?",
                   (unit["record"], cli.seal("units", list(unit.values())), unit["unit"]))
    db.close()


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Page(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = Path(tempfile.mkdtemp(prefix="stiction-report-"))
        cls.addClassCleanup(shutil.rmtree, cls.pages, ignore_errors=True)
        cls.store = cls.pages / "small.store"
        for problems, report in ((40000, "earlier"), (100000 if cli.ALL else 60000, "small")):
            cls.must("search", *CAMPAIGN, "--problems", problems, "--store", cls.store, "--finishing", 100)
            cls.must("report", cls.store, "-o", cls.pages / report)
        cls.report = cls.pages / "small"
        cls.page = pages(cls.report)

    @classmethod
    def must(cls, *arguments):
        done = cli.run(*arguments, timeout=900)
        if done.code != 0:
            raise AssertionError(f"{arguments}: exit {done.code}\n{done.err}")

    def data(self, page):
        return json.loads(re.search(r'id="data">(.*?)</script>', (self.report / page).read_text(), re.S)[1])

    def listed(self):
        """The findings of their page, a line each."""
        lines = re.search(r'id="lines">(.*?)</script>', (self.report / "findings.html").read_text(), re.S)[1]
        return [json.loads(line) for line in zlib.decompress(base64.b64decode(lines)).decode().splitlines()]

    def test_what_is_drawn_is_what_the_store_holds(self):
        tallies, _ = cli.total(self.store)
        rates = {(row["by"], row["generator"], row["policy"], row["contacts"], row["value"], row["outcome"]): row
                 for row in tables(self.report / "figures/rates.csv")}
        seen = 0
        for (generator, contacts, policy, _method, _arithmetic), tally in tallies.items():
            exact, n = exact_outcomes(tally), str(contacts)
            for outcome, parts in {"loop": ("cycle", "stall"), "singular": ("singular",), "ray": ("ray",)}.items():
                row = rates["contacts", generator, policy, n, n, outcome]
                counts = sum(exact[OUTCOMES.index(part)] for part in parts), tally["problems"]
                self.assertEqual((int(row["count"]), int(row["runs"])), counts)
                low, rate, high = (float(row[name]) for name in ("low", "rate", "high"))
                self.assertAlmostEqual(rate, 1e6 * counts[0] / counts[1], delta=1e-5 * rate)
                self.assertTrue(low <= rate < high, row)
                seen += counts[0]
        self.assertGreater(seen, 10)

    def test_steps_that_are_drawn_are_those_of_the_store(self):
        tallies, _ = cli.total(self.store)
        expected, found = {}, {}
        for (_generator, contacts, policy, _method, _arithmetic), tally in tallies.items():
            for steps, runs in enumerate(tally["steps"]):
                if runs:
                    key = policy, str(contacts), str(steps)
                    expected[key] = expected.get(key, 0) + runs
        for row in tables(self.report / "figures/steps.csv"):
            found[row["policy"], row["contacts"], row["steps"]] = int(row["runs"])
        self.assertEqual(found, expected)
        self.assertGreater(len(found), 20)

    def test_the_first_sentence_counts_the_loops_of_the_store(self):
        tallies, _ = cli.total(self.store)
        loops = sum(sum(exact_outcomes(tally)[1:3]) for tally in tallies.values())
        self.assertIn(f"loops for ever in {loops:,} runs", self.page)

    def test_every_finding_of_the_table_is_in_the_data(self):
        rows = {row["signature"]: row for row in tables(self.report / "findings.csv") if row["state"] != "counted"}
        findings = self.listed()
        self.assertEqual(sorted(rows), sorted(finding["signature"] for finding in findings))
        for finding in findings:
            row = rows[finding["signature"]]
            said = [finding[key] for key in ("kind", "met", "state", "contacts")]
            self.assertEqual(said, [row["kind"], int(row["count"]), row["state"], int(row["contacts"])])
            self.assertEqual(finding["files"][0], row["problem_file"])
        choices = self.data("findings.html")["choices"]
        for field in ("kind", "smallest", "generator", "policy", "state"):
            self.assertEqual(choices[field], sorted({str(finding[field]) for finding in findings}), field)

    def test_the_first_page_has_few_findings_and_little_weight(self):
        first = (self.report / "index.html").read_text()
        signatures = [finding["signature"] for finding in self.listed()]
        self.assertGreater(len(signatures), 10)
        self.assertEqual([finding["signature"] for finding in self.data("index.html")["findings"]], signatures[:6])
        for signature in signatures[6:]:
            self.assertNotIn(f">{signature}<", first)
        self.assertLess(len(first), 600000)
        self.assertLess(sum((self.report / name).stat().st_size for name in PAGES[:2]), 1000000)

    def test_findings_begin_with_loops_finished_ones_first(self):
        order = [(not finding["loop"], finding["state"] != "finished") for finding in self.listed()]
        self.assertEqual(order, sorted(order))
        self.assertGreater(len(set(order)), 1)

    def test_every_scene_has_its_picture(self):
        pictures = 0
        for finding in self.listed():
            problem = json.loads((self.report / finding["files"][1]).read_text())
            picture = finding["files"][5]
            self.assertEqual(picture != "", "scene" in problem, finding["signature"])
            if picture:
                pictures += 1
                self.assertIn("<svg", (self.report / picture).read_text())
        self.assertGreater(pictures, 0)

    def test_every_key_of_a_campaign_has_a_name_in_words(self):
        store, report = self.folder / "g.store", self.folder / "g"
        self.succeeds("search", "--store", store, "--generator", "scenes", "--gravity-only", "--contacts", 2, "--problems", 200)
        self.succeeds("report", store, "-o", report)
        for page in (self.page, pages(report)):
            names = re.findall(r"<dt>(.*?)</dt>", page)
            self.assertIn("friction palette", names)
            self.assertEqual([name for name in names if "_" in name], [])

    def test_the_records_stand_in_the_page(self):
        rows = tables(self.report / "frontiers.csv")
        records = json.loads(cli.run("records", "--json").out)
        self.assertGreater(len(records), 20)
        self.assertEqual([[row["frontier"], row["value"], row["random_value"] or None, int(row["random_evaluations"])]
                          for row in rows],
                         [[record[key] for key in ("frontier", "value", "random", "random_evaluations")]
                          for record in records])
        section = html.unescape(re.search(r'<section id="frontiers">.*?</section>', self.page, re.S)[0])
        for record in records:
            self.assertIn(record["what"], section)
            self.assertIn(record["command"], section)
        self.assertIn('href="results.html#frontiers"', self.page)

    def test_benchmarks_alone_make_a_report(self):
        bench = self.file("trade.csv", RUNGS)
        out = self.folder / "measured"
        self.succeeds("report", "--bench", bench, "-o", out)
        page = html.unescape((out / "index.html").read_text())
        self.assertIn("1 method over 2 arithmetics, on 1 kind of problems. Over rounded numbers of 24 runs 2 were wrong, "
                      "1 of them silently. Over rationals and certified signs of 25 runs 0 were wrong, 0 of them silently.",
                      page)
        self.assertEqual((out / "bench/trade.csv").read_text(), RUNGS)
        self.assertEqual(len(tables(out / "figures/rungs.csv")), 2)
        done = subprocess.run(["sha256sum", "--check", "SHA256SUMS"], cwd=out, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        odd = self.file("a b#c.csv", RUNGS.replace(",1.5,2.5,3.5,", ",,,,").replace(",7,8.5,9,", ",,,,"))
        self.succeeds("report", "--bench", odd, "-o", self.folder / "odd")
        for folder in (out, self.folder / "odd"):
            links = re.findall(r'href="([^"]+)"', (folder / "index.html").read_text())
            files = [link for link in links if not link.startswith("#")]
            self.assertGreater(len(files), 3)
            for link in files:
                self.assertTrue((folder / link).is_file(), link)
        again = re.search(r"run (report --bench .*) -o again", page)[1].split()
        self.succeeds(*again, "-o", self.folder / "again", cwd=out)
        self.assertEqual((self.folder / "again/index.html").read_bytes(), (out / "index.html").read_bytes())
        self.refuses("report", "--bench", bench, says="expected a folder to write")
        self.refuses("report", "-o", out, says="report: found no STORE, expected the store of a search, or --bench")
        self.refuses("report", "--bench", bench, "-o", out, "--latex", says="found no STORE, expected one with")
        twice = self.folder / "other" / "trade.csv"
        twice.parent.mkdir()
        twice.write_text(RUNGS)
        self.refuses("report", "--bench", bench, twice, "-o", out, says="--bench: found two files bench/trade.csv")

    def test_an_optimized_search_stands_beside_the_records(self):
        store, out = self.folder / "steps.store", self.folder / "steps"
        self.succeeds("search", "--objective", "steps", "--generator", "integers", "--contacts", 3, "--problems", 2000,
                      "--store", store)
        self.succeeds("report", store, "-o", out)
        best = json.loads(self.succeeds("report", store, "--text", "--json").out)["best"]
        section = re.search(r'<section id="frontiers">.*?</section>', (out / "results.html").read_text(), re.S)[0]
        table = section[:section.index("</table>")]
        cells = [html.unescape(re.sub("<.*?>", "", cell)) for cell in re.findall(r"<td.*?</td>|<th[^>]*row.*?</th>", table)]
        record = next(row["value"] for row in tables(out / "frontiers.csv") if row["frontier"] == "steps-3-contacts")
        self.assertEqual(len(best), 1)
        page = html.unescape(pages(out))
        self.assertIn(f"The best: {best[0]['value']:g} steps (integers, 3 contacts).", page)
        for wrong in ("0 problems run", "random friction problems", "Every run", 'id="frequencies"'):
            self.assertNotIn(wrong, page)
        again = re.search(r"stiction search (campaign.json .*)", page)[1].replace("again.store", str(self.folder / "again"))
        self.succeeds("search", *again.split(), cwd=out, timeout=300)
        self.assertEqual(json.loads(self.succeeds("report", self.folder / "again", "--text", "--json").out)["best"], best)
        self.assertEqual([*cells[:3], cells[4].split()[0], cells[5]],
                         ["steps", "integers", "3", f"{best[0]['value']:g}", f"steps-3-contacts {record}"])

    def test_commands_run_in_the_folder_of_the_report(self):
        featured = re.search(r'<div class="featured">.*?<pre><code>(.*?)</code></pre>', self.page, re.S)[1]
        commands = html.unescape(featured).split("\n")
        self.assertEqual(len(commands), 3)
        setup = html.unescape(re.search(r'<pre class="setup"><code>(.*?)</code></pre>', self.page, re.S)[1])
        setup = setup.replace("/path/to/stiction/run", str(cli.program))
        folder = shutil.copytree(self.report, self.folder / "a report")
        for command in commands:
            done = subprocess.run(["bash", "-c", f"{setup}\n{command}"], cwd=folder, capture_output=True, text=True,
                                  timeout=300)
            self.assertEqual((done.returncode, done.stderr), (0, ""), command)
        self.assertTrue((folder / "replay.html").is_file())

    def test_the_campaign_can_be_searched_again_with_the_command_that_is_named(self):
        section = self.page[self.page.index('<section id="again">'):]
        commands = html.unescape(re.search(r"<pre><code>(.*?)</code></pre>", section, re.S)[1])
        folder = shutil.copytree(self.report, self.folder / "again")
        commands = commands.replace("/path/to/stiction/run", str(cli.program))
        self.assertEqual(len(commands.split("\n")), 3)
        script = "set -e; " + commands.replace("--store", "--finishing 0 --store")
        done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True, timeout=900)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("rates", "steps", "doubles", "trust", "pivoting", "loop-steps", "driving"):
            one, two = (path / f"figures/{name}.csv" for path in (self.report, folder / "again"))
            self.assertEqual(one.read_text(), two.read_text(), name)

    def test_an_earlier_report_that_is_none_is_refused(self):
        report = "report", self.store, "-o", self.folder / "out", "--since"
        expected = "expected the folder of an earlier report, which stiction report STORE -o FOLDER writes"
        for path, found in ((self.folder / "nowhere", "which is not there"), (self.store, "a store"),
                            (self.folder, "a folder without findings.csv")):
            self.refuses(*report, path, says=f"--since: found {path}, {found}; {expected}")
        self.refuses("status", self.report, says=f"{self.report}: found a report, which was made of a store, expected a store")
        self.refuses(*report, self.file("x.csv", "a,b\r\n"),
                     says="x.csv:1: found no column signature, expected findings.csv of a report")
        self.assertFalse((self.folder / "out").exists())

    @unittest.skipUnless(cli.ALL, "long: ./run test --nightly")
    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        packages = Packages.get()
        self.succeeds("report", self.store, "-o", self.pages / "since", "--since", self.pages / "earlier")
        large = self.pages / "large.store"
        shutil.copy(self.store, large)
        add_findings(large, MANY)
        self.succeeds("report", large, "-o", self.pages / "large", timeout=600)
        for name, mu, seed in (("low", "1/4", 1), ("high", 5, 2)):
            self.succeeds("search", "--store", self.pages / f"{name}.store", "--generator", "conditioned", "scenes",
                          "--contacts", 2, 3, "--problems", 40000, "--mu", mu, "--seed", seed, "--finishing", 100)
        self.succeeds("report", "--bench", self.file("rungs.csv", RUNGS), "-o", self.pages / "measured")
        self.succeeds("report", self.pages / "low.store", self.pages / "high.store", "-o", self.pages / "compared",
                      code=1)
        scripts = [Path(__file__).with_name(f"{name}_browser.mjs") for name in ("report", "comparison")]
        done = subprocess.run(["node", "--test", *scripts], capture_output=True, text=True, timeout=900, env=dict(
            os.environ, PAGES=str(self.pages), PACKAGES=str(packages), BROWSER=browser))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 21, done.stdout[-2000:])


if __name__ == "__main__":
    cli.main()
