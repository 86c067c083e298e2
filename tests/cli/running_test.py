# SPDX-License-Identifier: Apache-2.0
"""A running search or simulation: its progress on a terminal, its end by clock or signal."""

import os
import pty
import select
import signal
import subprocess
import time

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import cli

SMALL = ["--generator", "small", "--contacts", "2", "3"]
# Problems whose findings take long to finish; the grid of policies of one alone takes ten seconds and more.
LARGE = ["--generator", "conditioned", "--contacts", "7"]
LONG = 60  # minutes that a search is given which ends for another reason, long before


class Background(cli.TestCase):
    def launch(self, *arguments, **streams):
        """A process in the background, with the disposition of signals that a shell would give it."""
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
        process = subprocess.Popen([cli.program, *map(str, arguments)], stdin=subprocess.DEVNULL, **streams)
        self.addCleanup(lambda: [stream.close() for stream in (process.stdout, process.stderr) if stream])
        self.addCleanup(lambda: (process.kill(), process.wait()))
        return process

    def finish(self, process, timeout=2 * cli.PATIENCE):
        out, err = process.communicate(timeout=timeout)
        return cli.Run(process.returncode, (out or b"").decode(), (err or b"").decode())

    def open_terminal(self):
        try:
            return pty.openpty()
        except OSError as error:  # a bare chroot has none
            self.skipTest(f"SKIPPED: no pseudo-terminals here: {error}")

    def read_terminal(self, terminal, until=None):
        """What comes until the other side is closed, or until it holds a text."""
        shown = b""
        while until is None or until not in shown:
            try:
                part = os.read(terminal, 65536)
            except OSError:  # the other side is closed
                break
            if not part:
                break
            shown += part
        return shown.decode()


class Searches(Background):
    def start(self, *arguments, **streams):
        return self.launch("search", "--store", self.folder / "a.store", *arguments, **streams)

    def wait_for_units(self, least):
        def there():
            done = cli.run("status", self.folder / "a.store", "--json")
            return done.code == 0 and done.json()["units"] >= least

        self.wait_until(there)

    # ---- Terminal ----

    def test_a_terminal_shows_a_bar(self):
        mine, its = self.open_terminal()
        search = self.start(*SMALL, "--minutes", 0.03, "--json", stderr=its)
        os.close(its)
        shown = self.read_terminal(mine)
        os.close(mine)
        done = self.finish(search)
        self.assertEqual(done.code, 0)
        self.assertRegex(shown, r"\r\x1b\[K\[#+\.+\] [\d,]+ problems, ")
        self.assertTrue(shown.endswith("\r\x1b[K"))  # it leaves a clean line
        self.assertGreater(done.json()["problems"], 0)
        self.assertPlain(cli.Run(0, done.out, ""))

    def test_no_bar_where_standard_error_is_no_terminal(self):
        mine, its = self.open_terminal()
        search = self.start(*SMALL, "--minutes", 0.03, stdout=its)
        os.close(its)
        shown = self.read_terminal(mine)
        os.close(mine)
        done = self.finish(search)
        self.assertEqual(done.code, 0)
        self.assertPlain(cli.Run(0, shown.replace("\r\n", "\n"), done.err))
        self.assertNotIn("[#", done.err)
        self.assertIn("problems in", shown)

    # ---- Clock ----

    def test_minutes_are_wall_clock(self):
        start = time.monotonic()
        self.assertEqual(self.finish(self.start(*SMALL, "--minutes", 0.05)).code, 0)
        seconds = time.monotonic() - start
        self.assertGreaterEqual(seconds, 3)
        self.assertLess(seconds, 3 + cli.PATIENCE)

    def test_a_search_ends_early_when_its_problems_are_done(self):
        start = time.monotonic()
        self.assertEqual(self.finish(self.start(*SMALL, "--minutes", LONG, "--problems", 1)).code, 0)
        self.assertLess(time.monotonic() - start, cli.PATIENCE)

    # ---- Signals ----

    def interrupt(self, signal_number, arguments, units, seconds=0):
        search = self.start(*arguments, "--minutes", LONG)
        self.wait_for_units(units)
        time.sleep(seconds)
        start = time.monotonic()
        search.send_signal(signal_number)
        done = self.finish(search)
        self.assertLess(time.monotonic() - start, cli.PATIENCE)
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("everything done so far is stored. The same command goes on", done.err)
        self.assertIn("problems in", done.out)
        return done

    def test_an_interrupted_search_keeps_everything_and_can_go_on(self):
        stored = 0  # waiting for more than there is shows that the new process is at work
        for signal_number in (signal.SIGINT, signal.SIGTERM):
            self.interrupt(signal_number, SMALL, units=stored + 3)
            before = cli.content(self.folder / "a.store")
            self.assertGreaterEqual(len(before["units"]), 3)
            # The units were counted whole, and the same search takes up from there.
            self.assertEqual(self.finish(self.start(*SMALL, "--minutes", 0.01)).code, 0)
            after = cli.content(self.folder / "a.store")
            self.assertLessEqual(set(before["units"]), set(after["units"]))
            self.assertEqual(len({row[0] for row in after["units"]}), len(after["units"]))
            stored = len(after["units"])
        other = self.folder / "other.store"
        numbers = {row[0] for row in after["units"]}
        self.succeeds("search", *SMALL, "--store", other, "--problems", 10000)
        first = {row[0]: row for row in after["units"]}
        for row in cli.content(other)["units"]:
            self.assertIn(row[0], numbers)
            self.assertEqual(row, first[row[0]])

    def test_an_interrupt_does_not_wait_for_findings_that_take_long(self):
        self.interrupt(signal.SIGINT, [*LARGE, "--threads", 1], units=1, seconds=2)


class Simulations(Background):
    FRAMES = 2  # pictures a second

    def start(self, folder, *arguments, **streams):
        scene = cli.ROOT / "corpus" / "scenes" / "double-action-jack.json"
        return self.launch("simulate", scene, "-o", folder, "--frames", self.FRAMES, *arguments, **streams)

    def rows(self, file):
        """Whole lines but for the head, as numbers."""
        text = file.read_text() if file.exists() else ""
        return [[float(x) for x in line.split(",")] for line in text[:text.rfind("\n") + 1].splitlines()[1:]]

    def test_an_interrupted_simulation_leaves_a_whole_folder(self):
        for signal_number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=signal_number):
                folder, again = self.folder / signal_number.name, self.folder / "again"
                simulation = self.start(folder, "--seconds", 1e5)
                building = folder.with_name(f".{folder.name}.stiction")  # until it is whole
                self.wait_until(lambda: len(self.rows(building / "energy.csv")) > 1000)  # they grow as it goes
                simulation.send_signal(signal_number)
                done = self.finish(simulation)
                self.assertEqual(done.code, 0, done.err)
                self.assertIn("Interrupted at t = ", done.err)
                self.assertIn("frames ", done.out)
                # Nothing is missing, and it is what a run of that length writes.
                times = [row[0] for row in self.rows(folder / "energy.csv")]
                self.succeeds("simulate", cli.ROOT / "corpus" / "scenes" / "double-action-jack.json", "-o", again,
                              "--frames", self.FRAMES, "--seconds", times[-1])
                written = sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
                self.assertEqual(written, sorted(path.relative_to(again) for path in again.rglob("*") if path.is_file()))
                for name in written:
                    self.assertEqual((folder / name).read_bytes(), (again / name).read_bytes(), name)
                self.assertEqual([row[0] for row in self.rows(folder / "drift.csv")], times)
                for frame in (folder / "frames").iterdir():
                    ElementTree.parse(frame)
                self.assertGreater(len(written), self.FRAMES * times[-1])

    def test_a_terminal_shows_a_bar_until_the_end(self):
        mine, its = self.open_terminal()
        simulation = self.start(self.folder / "run", "--seconds", 1e5, "--no-svg", stderr=its)
        os.close(its)
        self.assertRegex(self.read_terminal(mine, until=b"s left"), r"\r\x1b\[K\[#*\.+\] t = .* of 24,000,000 steps, ")
        simulation.send_signal(signal.SIGINT)
        shown = self.read_terminal(mine)
        os.close(mine)
        done = self.finish(simulation)
        self.assertEqual(done.code, 0)
        self.assertRegex(shown, r"\r\x1b\[KInterrupted at t = ")
        self.assertPlain(done)


class Reports(Background):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.store"
        self.succeeds("search", *SMALL, "--problems", 60000, "--finishing", 0, "--store", self.store)

    def shown(self, *arguments):
        mine, its = self.open_terminal()
        run = self.launch(*arguments, stderr=its)
        os.close(its)
        shown = self.read_terminal(mine)
        os.close(mine)
        done = self.finish(run)
        self.assertEqual(done.code, 0)
        self.assertPlain(done)
        return shown

    def test_a_terminal_shows_what_is_read_and_written(self):
        for arguments in (["-o", self.folder / "report"], ["--package", self.folder / "package"]):
            shown = self.shown("report", self.store, *arguments)
            self.assertRegex(shown, r"\r\x1b\[K\[#*\.*\] \d+ of \d+ findings read\r")
            self.assertTrue(shown.endswith("\r\x1b[K"))  # it leaves a clean line

    def test_a_terminal_shows_what_status_and_merge_read(self):
        shown = self.shown("status", self.store)
        self.assertRegex(shown, r"\r\x1b\[K\[#*\.*\] \d+ of \d+ findings read\r")
        self.assertTrue(shown.endswith("\r\x1b[K"))
        shown = self.shown("merge", self.folder / "whole.store", self.store)
        self.assertRegex(shown, r"\r\x1b\[K\[#*\.*\] \S*a\.store: \d+ of \d+ findings read\r")
        self.assertTrue(shown.endswith("\r\x1b[K"))

    def test_a_log_has_nothing_of_what_takes_no_time(self):
        done = self.succeeds("report", self.store, "-o", self.folder / "report")
        self.assertEqual(done.err, "")


class Benches(Background):
    def test_a_terminal_shows_a_bar_of_every_suite(self):
        """The suite's parts, and the steps of the one at hand."""
        words = next(verb["words"] for verb in self.succeeds("manual", "--json").json() if verb["verb"] == "bench")
        suites = [choice["name"] for choice in words[0]["choices"]]
        self.assertGreater(len(suites), 10)
        few = ("gate", "silent", "structure")  # one of each kind, of a program or another
        for suite in suites if cli.ALL else few:
            with self.subTest(suite=suite):
                mine, its = self.open_terminal()
                bench = self.launch("bench", "--suite", suite, "--scenes", cli.ROOT / "corpus/scenes",
                                    stdout=subprocess.DEVNULL, stderr=its)
                os.close(its)
                shown = self.read_terminal(mine, until=b" of ")
                os.close(mine)
                if "stiction-peers: cannot be run" in shown:  # built with the first build alone
                    self.assertFalse(Path(cli.program).with_name("stiction-peers").exists())
                    bench.wait()
                    continue
                self.assertRegex(shown, r"^\r\x1b\[K\[#*\.*\] \d+ of ")
                bench.kill()
                bench.wait()

    def test_a_log_has_a_line_after_ten_seconds(self):
        start = time.monotonic()
        bench = self.launch("bench", "--suite", "silent", "--families", "tame", "--problems", 10**9)
        line = bench.stderr.readline().decode()
        self.assertGreaterEqual(time.monotonic() - start, 10)
        self.assertRegex(line, r"^\d\d s, \d+ %: 1 of 1, problems: [\d,]+ of 1,000,000,000\n$")
        self.assertEqual(select.select([bench.stderr], [], [], 3)[0], [], "a second line, before ten more seconds")

    def test_a_log_has_nothing_of_what_takes_no_time(self):
        done = self.succeeds("bench", "--suite", "gate-cost", "--contacts", 2, "--problems", 2)
        self.assertEqual(done.err, "")


if __name__ == "__main__":
    cli.main()
