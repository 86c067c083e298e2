# SPDX-License-Identifier: Apache-2.0
"""A running search: its progress on a terminal, its end by clock or signal."""

import os
import pty
import signal
import subprocess
import time

import cli

SMALL = ["--generator", "small", "--contacts", "2", "3"]
# Problems whose findings take long to finish; the grid of policies of one alone takes ten seconds and more.
LARGE = ["--generator", "conditioned", "--contacts", "7"]
LONG = 60  # minutes that a search is given which ends for another reason
PATIENCE = 120  # seconds, on a machine with other work; small against LONG


class Running(cli.TestCase):
    def start(self, *arguments, **streams):
        """A search in the background, with the disposition of signals that a shell would give it."""
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
        search = subprocess.Popen([cli.program, "search", "--store", self.folder / "a.store", *map(str, arguments)],
                                  stdin=subprocess.DEVNULL, **streams)
        self.addCleanup(lambda: (search.kill(), search.wait()))
        return search

    def finish(self, search, timeout=2 * PATIENCE):
        out, err = search.communicate(timeout=timeout)
        return cli.Run(search.returncode, (out or b"").decode(), (err or b"").decode())

    def wait_for_units(self, least):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            done = cli.run("status", self.folder / "a.store", "--json")
            if done.code == 0 and done.json()["units"] >= least:
                return
            time.sleep(0.05)
        self.fail("the search does not get on")

    # ---- Terminal ----

    def open_terminal(self):
        try:
            return pty.openpty()
        except OSError as error:  # a bare chroot has none
            self.skipTest(f"SKIPPED: no pseudo-terminals here: {error}")

    def read_terminal(self, terminal):
        shown = b""
        while True:
            try:
                part = os.read(terminal, 65536)
            except OSError:  # the other side is closed
                return shown.decode()
            if not part:
                return shown.decode()
            shown += part

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
        self.assertLess(seconds, 3 + PATIENCE)

    def test_a_search_ends_early_when_its_problems_are_done(self):
        start = time.monotonic()
        self.assertEqual(self.finish(self.start(*SMALL, "--minutes", LONG, "--problems", 1)).code, 0)
        self.assertLess(time.monotonic() - start, PATIENCE)

    # ---- Signals ----

    def interrupt(self, signal_number, arguments, units, seconds=0):
        search = self.start(*arguments, "--minutes", LONG)
        self.wait_for_units(units)
        time.sleep(seconds)
        start = time.monotonic()
        search.send_signal(signal_number)
        done = self.finish(search)
        self.assertLess(time.monotonic() - start, PATIENCE)
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


if __name__ == "__main__":
    cli.main()
