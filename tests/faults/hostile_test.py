# SPDX-License-Identifier: Apache-2.0
"""Solvers under test that mean no good: none stops a search, outlasts its budget, or leaves a process behind."""

import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "cli"))
import cli  # noqa: E402

PROGRAM = Path(__file__).with_name("hostile") / "program.py"
LIBRARY = PROGRAM.with_name("library.c")
BUDGET = 4  # seconds of a search
ASLEEP = "hang-asleep-1c"  # takes longer than a search has here

# What is found of each, as a pattern; None: nothing need be. Programs that are refused have REFUSED.
REFUSED = object()
PROGRAMS = {
    "answers": "", "closes-and-lives": "crash-closed-1c", "closes-and-spins": "crash-closed-1c",
    "closes-output": ASLEEP, "closes-after-answer": "crash-closed-1c", "ignores-signals": ASLEEP,
    "floods-lines": "crash-(garbled|unasked)-1c", "floods-without-lines": "crash-flood-1c", "floods-errors": ASLEEP + "|hang-1c",
    "floods-errors-without-lines": ASLEEP + "|hang-1c", "many-errors": "", "million-nan": "crash-flood-1c",
    "many-nan": "crash-garbled-1c", "hundred-megabytes": "crash-flood-1c", "child-holds-output": "crash-exit-0-1c",
    "child-outlives": "", "child-in-session": "", "daemon": "", "daemon-without-marks": "", "sleeps": ASLEEP,
    "sleeps-by-a-child": ASLEEP, "spins": "hang-1c", "half-json": "crash-garbled-1c", "text": "crash-garbled-1c",
    "empty-lines": "crash-garbled-1c", "carriage-returns": "refused-solvable-1c", "nan": "not-finite-1c",
    "infinity": "not-finite-1c", "beyond-doubles": "not-finite-out-of-range-1c", "long-digits": "not-finite-out-of-range-1c",
    "texts": "crash-garbled-1c", "too-many": "crash-garbled-1c", "too-few": "crash-garbled-1c", "half-line-and-sleep": ASLEEP,
    "half-line-and-exit": "crash-exit-0-1c", "forges": "silent-wrong-moves-inward-1c", "wrong-types": "crash-garbled-1c",
    "says-it-twice": "crash-garbled-1c", "nul-bytes": "crash-garbled-1c", "no-utf8": "crash-garbled-1c",
    "nested": "crash-garbled-1c", "exits-well": "crash-exit-0-1c", "exits-with-3": "crash-exit-3-1c",
    "exits-after-answer": "crash-exit-0-1c", "dies-of-segv": "crash-sigsegv-1c", "dies-of-kill": "crash-sigkill-1c",
    "kills-its-group": "crash-sigkill-1c", "kills-its-parent": "crash-killed-its-guard-1c",
    "kills-its-parent-and-leaves": "crash-killed-its-guard-1c", "stops-its-parent": "", "ends-its-parent": "",
    "stops-itself": ASLEEP, "grows": "crash-(out-of-memory|exit-1)-1c", "terminal": "", "by-time": None,
    "answers-twice": "crash-unasked-1c|silent-wrong-.*", "answers-late": None, "answers-previous": None, "threads": None, "execs": ASLEEP,
    "leaks": None, "slow": "", "reads-nothing": ASLEEP, "speaks-unasked": "crash-unasked-1c|refused-solvable-1c",
    "another-each-time": REFUSED, "greets-no-more": None,
}
LIBRARIES = {
    "ends-never": "", "lib-segv": "crash-sigsegv-1c", "lib-abort": "crash-sigabrt-1c", "lib-exit": "crash-exit-0-1c",
    "lib-exit-3": "crash-exit-3-1c", "lib-spins": "hang-1c", "lib-sleeps": ASLEEP, "lib-nan": "not-finite-1c",
    "lib-infinity": "not-finite-1c", "lib-writes-everywhere": "crash-(garbled|unasked)-1c", "lib-closes-all": "crash-.*-1c",
    "lib-closes-and-lives": "crash-closed-1c", "lib-child": "", "lib-daemon": "",
    "lib-kills-its-parent": "crash-(killed-its-guard|sigkill)-1c", "lib-stops-itself": ASLEEP,
    "lib-grows": "crash-.*-1c", "lib-overflows": "crash-sigsegv-1c", "lib-changes-the-problem": None,
    "lib-writes-beyond": "crash-.*-1c", "lib-thread": None, "lib-ignores-signals": ASLEEP, "lib-prints": None,
}
# What a short run tries: one of each kind.
FEW = ["closes-and-lives", "floods-without-lines", "child-holds-output", "daemon-without-marks", "sleeps", "many-nan",
       "kills-its-parent-and-leaves", "lib-daemon"]
# Some whose search is killed, so that nobody cleans up but the guard.
KILLED = ["sleeps", "daemon-without-marks", "ignores-signals", "lib-child", "closes-and-spins"]


def hostile(names):
    return [name for name in names if cli.ALL or name in FEW]


def processes(mark):
    """Those that bear the mark in their words or their environment."""
    found = []
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit() or int(folder.name) == os.getpid():
            continue
        try:
            state = (folder / "stat").read_text().rsplit(")", 1)[1].split()[0]
            text = (folder / "cmdline").read_bytes() + (folder / "environ").read_bytes()
        except OSError:
            continue
        if state != "Z" and mark.encode() in text:
            found.append((int(folder.name), (folder / "cmdline").read_bytes()))
    return found


class Hostile(cli.TestCase):
    marks = 0

    @classmethod
    def setUpClass(cls):
        cls.common = Path(tempfile.mkdtemp(prefix="stiction-hostile-"))
        cls.library = cls.common / "library"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-w", f"-I{cli.ROOT}", LIBRARY, "-lpthread", "-ldl", "-o",
                        cls.library], check=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.common)

    def solver(self, name, folder):
        """The file that is called so."""
        if name in PROGRAMS:
            file = folder / name
            file.symlink_to(PROGRAM)
            return file
        file = folder / f"{name}.so"
        file.symlink_to(self.library)
        return file

    def begin(self, name, *options):
        """A search of it in a folder of its own; with the folder and the mark of all its processes."""
        Hostile.marks += 1
        mark = f"{86000 + Hostile.marks}.{os.getpid()}"  # seconds of helpers that sleep
        folder = self.folder / f"{name}-{Hostile.marks}"
        folder.mkdir()
        command = [cli.program, "search", "-g", "integers", "-c", "1", "--threads", "1", "--solver", self.solver(name, folder),
                   "--store", folder / "a.store", *options]
        with open(folder / "out", "wb") as out, open(folder / "err", "wb") as err:
            search = subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=out, stderr=err, cwd=folder,
                                      env={**os.environ, "HOSTILE_MARK": mark, "HOSTILE_FOLDER": str(folder)})
        return search, folder, mark

    def leaves_nothing(self, name, mark):
        end = time.monotonic() + 2  # a process that is killed takes a moment
        while processes(mark) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(processes(mark), [], name)

    def signatures(self, store):
        if not store.exists():
            return []
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as db:
            found = [row[0] for row in db.execute("SELECT signature FROM findings")]
        db.close()
        return found

    def units(self, store):
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as db:
            (units,) = db.execute("SELECT COUNT(*) FROM units").fetchone()
        db.close()
        return units

    def begun(self, search, folder):
        """Waits until the search has its store and the solver its first problem, or for a while."""
        end = time.monotonic() + 20
        while not (folder / "a.store").exists() and search.poll() is None and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(1)

    def survives(self, name, expected):
        start = time.monotonic()
        search, folder, mark = self.begin(name, "--minutes", BUDGET / 60)
        try:
            code = search.wait(60)
        finally:
            search.kill()
            search.wait()
        took = time.monotonic() - start
        err = (folder / "err").read_text(errors="replace")
        self.leaves_nothing(name, mark)
        self.assertLessEqual(took, 2 * BUDGET + 2, f"{name}\n{err}")
        self.assertEqual(code, 2 if expected is REFUSED else 0, f"{name}\n{err}")
        self.assertLess(len(err), 100_000, name)
        self.assertNotIn("\x1b", err, name)
        if expected is REFUSED or expected is None:
            return
        self.assertIn("Out of time", err, name)
        found = self.signatures(folder / "a.store")
        if expected == "":
            self.assertEqual(found, [], name)
        elif self.units(folder / "a.store") > 0:  # on a busy machine there may be no time for one
            self.assertTrue(found, f"{name}\n{err}")
        for signature in found:
            self.assertRegex(signature, f"^({expected})$", name)

    def ends_on_a_signal(self, name, expected):
        search, folder, mark = self.begin(name, "--minutes", 10)
        try:
            self.begun(search, folder)
            if expected is REFUSED and search.poll() is not None:
                return
            self.assertIsNone(search.poll(), (name, (folder / "err").read_text(errors="replace")))
            search.send_signal(signal.SIGTERM)
            start = time.monotonic()
            search.wait(60)
            self.assertLessEqual(time.monotonic() - start, 2, name)
            self.assertIn("Interrupted", (folder / "err").read_text(errors="replace"), name)
        finally:
            search.kill()
            search.wait()
        self.leaves_nothing(name, mark)

    def each(self, act, names):
        table = {**PROGRAMS, **LIBRARIES}
        with ThreadPoolExecutor(3) as pool:
            tries = [(name, pool.submit(act, name, table[name])) for name in names]
        for name, tried in tries:
            with self.subTest(solver=name):
                tried.result()

    def test_the_table_has_all_of_them(self):
        text = PROGRAM.read_text()
        acts = re.findall(r'^    "([a-z0-9-]+)": ', text[text.index("ACTS = {"):text.index("def main")], re.M)
        self.assertEqual(sorted(acts), sorted(PROGRAMS))
        self.assertEqual(sorted(set(re.findall(r'is\("([a-z0-9-]+)"\)', LIBRARY.read_text()))), sorted(LIBRARIES))
        self.assertGreater(len(PROGRAMS) + len(LIBRARIES), 60)

    def test_none_stops_a_search_outlasts_its_budget_or_leaves_a_process(self):
        self.each(self.survives, hostile([*PROGRAMS, *LIBRARIES]))

    def test_a_search_of_any_ends_within_two_seconds_when_it_is_told_to(self):
        self.each(self.ends_on_a_signal, hostile([*PROGRAMS, *LIBRARIES]))

    def test_what_a_solver_started_dies_with_a_search_that_is_killed(self):
        for name in hostile(KILLED):
            with self.subTest(solver=name):
                search, folder, mark = self.begin(name, "--minutes", 10)
                self.begun(search, folder)
                end = time.monotonic() + 30
                others = lambda: [one for one in processes(mark) if one[0] != search.pid]
                seen = others()
                while not seen and time.monotonic() < end:  # one host has ended, the next one has not begun
                    time.sleep(0.02)
                    seen = others()
                self.assertTrue(seen, name)
                search.kill()
                search.wait()
                self.leaves_nothing(name, mark)

    def test_a_hang_is_stored_when_it_happens_and_not_with_its_unit(self):
        campaign = self.file("campaign.json", {"format": "stiction-campaign", "version": 1, "generators": ["integers"],
                                               "contacts": [1], "first_unit_problems": 4000, "unit_problems": 4000})
        solver = self.folder / "spins"
        solver.symlink_to(PROGRAM)
        store = self.folder / "a.store"
        search = subprocess.Popen(list(map(str, [cli.program, "search", campaign, "--solver", solver, "--store", store,
                                                 "--minutes", 10, "--threads", 1])),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            end = time.monotonic() + 60
            while not self.signatures(store) and time.monotonic() < end:
                time.sleep(0.2)
            told = cli.run("status", store)
            self.assertEqual(told.code, 0, told.err)
            self.assertIn("hang-1c", told.out)
            self.assertEqual(json.loads(cli.run("status", store, "--json").out)["units"], 0)
            found = self.signatures(store)
        finally:
            search.send_signal(signal.SIGTERM)
            search.wait(60)
        self.assertEqual(found, ["hang-1c"])
        self.assertIn("hang-1c", cli.run("report", store, store).out)

    @unittest.skipUnless(cli.ALL, "it sleeps")
    def test_what_sleeps_costs_its_limit_and_is_found(self):
        start = time.monotonic()
        search, folder, mark = self.begin("sleeps", "--minutes", 0.5)
        found = None
        while search.poll() is None:
            if not found and self.signatures(folder / "a.store"):
                found = time.monotonic() - start
            time.sleep(0.2)
        self.assertEqual(self.signatures(folder / "a.store"), ["hang-asleep-1c"])
        self.assertLess(found, 20)  # ten seconds, and some for a busy machine
        self.leaves_nothing("sleeps", mark)


if __name__ == "__main__":
    cli.main()
