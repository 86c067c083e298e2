# SPDX-License-Identifier: Apache-2.0
"""search_test.py PROGRAM SOURCES: campaigns and stores of the Python package are those of the program."""
import csv
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import stiction

PROGRAM, SOURCES = sys.argv[1], Path(sys.argv[2])
CAMPAIGN = {"generator": ["small", "integers"], "contacts": 2, "mu": [1, "2"], "problems": 60000, "seed": 7}
OPTIONS = ["--generator", "small", "integers", "--contacts", "2", "--mu", "1", "2", "--problems", "60000",
           "--seed", "7"]


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def rows(table, names):
    """A table as the cells of a CSV."""
    columns = [np.ma.filled(np.ma.asarray(table[name]).astype(str), "") for name in names]
    return [list(map(str, row)) for row in zip(*columns)]


class Campaigns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.theirs = Path(cls.folder.name) / "theirs.store"
        program("search", *OPTIONS, "--finishing", "100", "--store", cls.theirs)
        cls.ours = Path(cls.folder.name) / "ours.store"
        cls.findings = list(stiction.search(**CAMPAIGN, finishing=100, store=cls.ours))

    def test_findings_are_those_of_the_program(self):
        self.assertGreater(len(self.findings), 1)
        said = [[(f.signature, f.count, f.unit, f.index, f.seed, f.problem.digest, f.minimized and f.minimized.digest,
                  f.certificate and f.certificate.text, f.facts) for f in findings]
                for findings in (self.findings, stiction.Store(self.theirs).findings)]
        self.assertEqual(*said)

    def test_the_store_names_the_machine_as_the_program_does(self):
        ours, theirs = (json.loads(program("status", store, "--json"))["machines"] for store in (self.ours, self.theirs))
        self.assertEqual((len(ours), ours), (1, theirs))

    def test_without_a_store_they_are_the_same_and_nothing_is_left(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch("tempfile.tempdir", folder):
            found = [(f.signature, f.count) for f in stiction.search(**CAMPAIGN, threads=1, finishing=0)]
            self.assertEqual(os.listdir(folder), [])
        self.assertEqual(found, [(f.signature, f.count) for f in self.findings])

    def test_a_finding_is_what_it_says(self):
        for finding in self.findings:
            if finding.kind != "cycle":
                continue
            self.assertTrue(finding.finished)
            self.assertEqual((finding.outcome, finding.contacts), ("cycle", 2))
            self.assertEqual(stiction.replay(finding.problem, finding.policy).outcome, "cycle")
            self.assertTrue(stiction.check(finding.minimized or finding.problem, finding.certificate))
            self.assertTrue(stiction.check(finding.minimized or finding.problem, finding.existence))
            self.assertEqual(sum(finding.policies.values()), 1536)
        self.assertIn("cycle", {finding.kind for finding in self.findings})

    def test_a_campaign_file_and_what_is_given_besides(self):
        file = Path(self.folder.name) / "campaign.json"
        file.write_text(json.dumps({"format": "stiction-campaign", "version": 1, "generators": ["small", "integers"],
                                    "contacts": [2, 3], "mu": ["1", "2"], "seed": 7}))
        for campaign in (file, json.loads(file.read_text())):
            found = stiction.search(campaign=campaign, contacts=2, problems=60000, finishing=0)
            self.assertEqual([(f.signature, f.count) for f in found], [(f.signature, f.count) for f in self.findings])
        campaign = stiction.Store(self.ours).campaign
        self.assertEqual((campaign["seed"], campaign["generators"], campaign["policies"]), (7, ["small", "integers"], ["paper"]))

    def test_tables_are_those_of_the_report(self):
        report = Path(self.folder.name) / "report"
        program("report", self.ours, "-o", report)
        tables = stiction.Store(self.ours).tables
        files = {file.stem for file in report.glob("*.csv")} - {"frontiers"}  # of the program, not of the store
        self.assertEqual(set(tables), files)
        for name, table in tables.items():
            with open(report / f"{name}.csv", newline="") as file:
                names, *cells = csv.reader(file)
            kept = [i for i, column in enumerate(names) if not column.endswith("_file")]
            self.assertEqual(list(table), [names[i] for i in kept], name)
            self.assertEqual(rows(table, table), [[row[i] for i in kept] for row in cells], name)
        statistics = stiction.Store(self.ours).statistics()
        self.assertEqual(statistics["problems"].dtype, np.int64)
        self.assertEqual(statistics["problems"].sum(), 60000)
        self.assertEqual(tables["strata"]["friction"].dtype.kind, "U")
        self.assertEqual(sum(f.count for f in self.findings), tables["findings"]["count"].sum())


class Refused(unittest.TestCase):
    def test_bad_input_is_one_line(self):
        for changes, named in [({"generator": "none"}, "generators"), ({"mu": "-1"}, "mu"),
                               ({"contacts": 99}, "contacts"), ({"problems": 0}, "problems"),
                               ({"finishing": 101}, "finishing"), ({"threads": 0}, "threads"), ({"policy": "scan=never"}, "policies"), ({"audits": 1}, "audits")]:
            with self.subTest(named), self.assertRaisesRegex(ValueError, named) as raised:
                next(stiction.search(**{**CAMPAIGN, **changes}))
            self.assertNotIn("\n", str(raised.exception))
        with self.assertRaises(OSError):
            stiction.Store("/nowhere.store")
        with self.assertRaises(OSError):
            next(stiction.search(campaign="/nowhere.json"))
        with self.assertRaises(ValueError):
            stiction.Store(SOURCES / "README.md")


class Interrupted(unittest.TestCase):
    def test_an_interrupt_ends_a_search_and_its_store_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            store = Path(folder) / "s.store"
            turns = []
            other = threading.Thread(target=lambda: [turns.append(time.sleep(0.05)) for _ in range(20)])
            other.start()  # which runs while the search does
            threading.Timer(2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            start = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                list(stiction.search(generator="small", contacts=2, mu=1, minutes=5, store=store))
            self.assertLess(time.monotonic() - start, 30)
            self.assertEqual(len(turns), 20)
            kept = stiction.Store(store).statistics()["problems"].sum()
            self.assertGreater(kept, 0)
            list(stiction.search(generator="small", contacts=2, mu=1, problems=int(kept) + 10000, store=store,
                                 finishing=0))
            self.assertGreaterEqual(stiction.Store(store).statistics()["problems"].sum(), kept + 10000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
