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
        files = {file.stem for file in report.glob("*.csv")} - {"frontiers", "work"}  # of the program and of machines, not of what a store counts
        self.assertEqual(set(tables), files)
        for name, table in tables.items():
            with open(report / f"{name}.csv", newline="") as file:
                names, *cells = csv.reader(file)
            kept = [i for i, column in enumerate(names) if not column.endswith("_file")]
            self.assertEqual(list(table), [names[i] for i in kept], name)
            self.assertEqual(rows(table, table), [[row[i] for i in kept] for row in cells], name)
        statistics = stiction.Store(self.ours).statistics()
        self.assertEqual(statistics["problems"].dtype, np.int64)
        self.assertGreaterEqual(statistics["problems"].sum(), 60000)
        self.assertEqual(tables["strata"]["friction"].dtype.kind, "U")
        self.assertEqual(sum(f.count for f in self.findings), tables["findings"]["count"].sum())


class Optimized(unittest.TestCase):
    """Searches with an objective; loops of scenes of high friction are frequent, so some are found at once."""
    WANTED = {"objective": "friction", "generator": "scenes", "contacts": 4, "mu": 1, "gravity_only": True,
              "problems": 8000}
    FLAGS = ["--objective", "friction", "--generator", "scenes", "--contacts", "4", "--mu", "1", "--gravity-only",
             "--problems", "8000", "--finishing", "0"]

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.theirs, cls.ours = (Path(cls.folder.name) / name for name in ("theirs.store", "ours.store"))
        program("search", *cls.FLAGS, "--store", cls.theirs)
        cls.findings = list(stiction.search(**cls.WANTED, finishing=0, store=cls.ours))

    def told(self, findings):
        return [(f.signature, f.count, f.unit, f.index, f.outcome, f.problem.digest, f.facts) for f in findings]

    def test_findings_are_those_of_the_program_s_store(self):
        self.assertGreater(len(self.findings), 0)
        self.assertEqual(self.told(self.findings), self.told(stiction.Store(self.theirs).findings))
        self.assertEqual(self.told(self.findings), self.told(stiction.Store(self.ours).findings))

    def test_the_best_is_that_of_the_program(self):
        best, = stiction.Store(self.ours).best
        file = Path(self.folder.name) / "best.json"
        program("problem", self.theirs, "--best", "-o", file)
        self.assertEqual((best.problem.digest, best.problem.name), (stiction.load(file).digest, "best-friction"))
        row, = json.loads(program("status", self.theirs, "--json"))["best"]
        self.assertEqual((best.value, best.contacts, best.generator), (row["value"], 4, "scenes"))
        self.assertLess(best.value, 1)
        self.assertEqual({float(mu) for mu in best.problem.mu}, {best.value})
        self.assertEqual(stiction.replay(best.problem).outcome, "cycle")
        saved = Path(self.folder.name) / "saved.json"
        best.problem.save(saved)
        self.assertEqual(json.loads(saved.read_text()), json.loads(file.read_text()))

    def test_threads_and_a_stop_between_leave_the_same(self):
        again = Path(self.folder.name) / "again.store"
        for problems in (4000, 8000):
            findings = list(stiction.search(**{**self.WANTED, "problems": problems}, finishing=0, store=again,
                                            threads=1))
        self.assertEqual(self.told(findings), self.told(self.findings))
        self.assertEqual([(best.value, best.problem.digest) for best in stiction.Store(again).best],
                         [(best.value, best.problem.digest) for best in stiction.Store(self.ours).best])
        self.assertEqual(stiction.Store(again).campaign, stiction.Store(self.ours).campaign)

    def test_its_store_tells_the_objective_and_has_tables(self):
        store = stiction.Store(self.ours)
        self.assertEqual((store.campaign["objective"], store.campaign["optimizer"]), ("friction", "evolution"))
        self.assertEqual(store.campaign, stiction.Store(self.theirs).campaign)
        tables, theirs = store.tables, stiction.Store(self.theirs).tables
        self.assertEqual(set(tables), set(theirs))
        for name, table in tables.items():
            self.assertEqual(rows(table, table), rows(theirs[name], theirs[name]), name)
        self.assertEqual(sorted(tables["findings"]["signature"]), sorted(f.signature for f in self.findings))

    def test_a_search_at_random_has_no_best(self):
        store = Path(self.folder.name) / "random.store"
        list(stiction.search(generator="psd", contacts=2, mu=1, problems=10000, finishing=0, store=store))
        self.assertEqual(stiction.Store(store).best, [])


class Refused(unittest.TestCase):
    def test_bad_input_is_one_line(self):
        for changes, named in [({"generator": "none"}, "generators"), ({"mu": "-1"}, "mu"),
                               ({"contacts": 99}, "contacts"), ({"problems": 0}, "problems"),
                               ({"finishing": 101}, "finishing"), ({"threads": 0}, "threads"),
                               ({"policy": "scan=never"}, "policies"), ({"audits": 1}, "audits"),
                               ({"objective": "fame"}, "objective: found .*fame.*, expected one of"),
                               ({"optimizer": "none"}, "optimizer: found .*none.*, expected one of"),
                               ({"minutes": float("nan")}, "minutes: found nan"),
                               ({"problems": "9"}, "problems: found '9', expected an integer"),
                               ({"problems": 1.5}, "problems: found 1.5, expected an integer"),
                               ({"minutes": "1"}, "minutes: found '1', expected a number"),
                               ({"contacts": "2"}, "contacts: found '2', expected an integer"),
                               ({"mu": "few"}, "mu: found 'few', expected"),
                               ({"gravity_only": 3}, "gravity_only: found 3, expected true or false")]:
            with self.subTest(named), self.assertRaisesRegex((ValueError, TypeError), named) as raised:
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
