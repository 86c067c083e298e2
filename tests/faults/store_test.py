# SPDX-License-Identifier: Apache-2.0
"""Stores: two searches at once, signals, folders that cannot be written, files that are no stores.

store_test.py PATH_TO_STICTION [SOURCES]
"""

import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

CAMPAIGN = ("--seed", 1, "--generator", "small", "--contacts", 2, "--threads", 1)


class Stores(cli.TestCase):
    def command(self, store, *options):
        return [cli.program, "search", *map(str, CAMPAIGN), "--store", str(store), *map(str, options)]

    def start(self, store, *options):
        """A search that goes on until somebody ends it, and that holds its first unit."""
        search = subprocess.Popen(self.command(store, "--minutes", 60, *options), stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        self.addCleanup(search.wait)
        self.addCleanup(search.kill)
        while not self.units(store):
            self.assertIsNone(search.poll(), "the search ended by itself")
            time.sleep(0.05)
        return search

    def units(self, store):
        try:
            rows = cli.content(store)
        except sqlite3.Error:  # not there yet
            return 0
        return len(rows["units"]) + 1024 * len(rows["blocks"])

    def search(self, store, problems=2000):
        self.succeeds("search", *CAMPAIGN, "--store", store, "--problems", problems)
        return store

    def test_where_locks_fail_readers_go_on(self):
        """As on some network file systems: a library in between lets every lock fail."""
        source, library = self.folder / "no_locks.c", self.folder / "no_locks.so"
        source.write_text("""
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/syscall.h>
#include <unistd.h>
int fcntl64(int file, int command, ...) {
  va_list more;
  va_start(more, command);
  void* argument = va_arg(more, void*);
  va_end(more);
  if (command == F_SETLK || command == F_SETLKW || command == F_GETLK || command == F_OFD_SETLK ||
      command == F_OFD_SETLKW || command == F_OFD_GETLK) {
    errno = ENOLCK;
    return -1;
  }
  return syscall(SYS_fcntl, file, command, argument);
}
int fcntl(int file, int command, ...) __attribute__((alias("fcntl64")));
""")
        if shutil.which("gcc") is None:
            self.skipTest("SKIPPED: no compiler")
        subprocess.run(["gcc", "-shared", "-fPIC", "-w", "-o", library, source], check=True)
        store = self.search(self.folder / "s.store")
        for arguments in (("status", store), ("report", store, "-o", self.folder / "report")):
            done = subprocess.run([cli.program, *map(str, arguments)], env={**os.environ, "LD_PRELOAD": str(library)},
                                  capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)

    # ---- One process at a time ----

    def test_a_second_search_on_a_shard_is_refused_and_told_who_is_at_work(self):
        store = self.folder / "s.store"
        first = self.start(store)
        for arguments in (("search", *CAMPAIGN, "--store", store), ("merge", store, self.search(self.folder / "o"))):
            self.refuses(*arguments, says=[store, f"process {first.pid} on {os.uname().nodename} since 20"])
        self.refuses("search", *CAMPAIGN, "--store", store, "--shard", "1/3", says="shard 1/3")
        self.assertIsNone(first.poll())
        self.succeeds("status", store)
        self.succeeds("report", store, "-o", self.folder / "report")

    def test_a_killed_search_holds_nothing(self):
        store = self.folder / "s.store"
        first = self.start(store)
        first.kill()
        first.wait()
        before = self.units(store)
        second = self.start(store)
        while self.units(store) <= before:
            self.assertIsNone(second.poll(), "the search ended by itself")
            time.sleep(0.05)
        second.terminate()
        second.communicate()
        self.assertEqual(second.returncode, 0)
        self.assertFalse((self.folder / "s.store.lock").exists())

    def test_another_shard_may_work_at_the_same_time(self):
        store = self.folder / "s.store"
        self.start(store, "--shard", "0/2")
        before = self.units(store)
        self.succeeds("search", *CAMPAIGN, "--store", store, "--shard", "1/2", "--problems", 200000)
        self.assertGreater(self.units(store), before)

    # ---- Signals ----

    def test_every_signal_that_asks_ends_a_search_that_keeps_what_it_has(self):
        # Under nohup, and so a search that it starts, this program would ignore the first.
        self.addCleanup(signal.signal, signal.SIGHUP, signal.signal(signal.SIGHUP, signal.SIG_DFL))
        for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=number):
                store = self.folder / f"{number}.store"
                search = self.start(store)
                search.send_signal(number)
                out, err = search.communicate(timeout=60)
                self.assertEqual(search.returncode, 0, err)
                self.assertIn("Interrupted", err)
                self.assertNotEqual(out, "")

    def test_a_search_that_ignores_the_end_of_its_terminal_goes_on(self):
        store = self.folder / "s.store"
        search = subprocess.Popen(["nohup", *self.command(store, "--minutes", 60)], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(search.wait)
        self.addCleanup(search.kill)
        while not self.units(store):
            time.sleep(0.05)
        search.send_signal(signal.SIGHUP)
        time.sleep(0.5)
        self.assertIsNone(search.poll())

    # ---- Grave findings ----

    def test_a_grave_finding_is_exit_4_of_search_and_merge(self):
        store = self.search(self.folder / "s.store", 20000)
        changed = cli.change(store, "UPDATE findings SET kind = 'safe-cycle' WHERE signature = "
                                    "(SELECT MIN(signature) FROM findings)")
        self.assertEqual(changed, 1)
        done = self.succeeds("search", *CAMPAIGN, "--store", store, "--problems", 20000, code=4)
        self.assertIn("1 grave finding", done.err)
        self.succeeds("merge", self.folder / "m.store", store, code=4)
        self.succeeds("status", store)
        self.succeeds("report", store, "-o", self.folder / "report")

    # ---- Places and files ----

    def read_only(self, folder):
        """How to run a program that cannot write there; root can, so it becomes nobody."""
        if os.geteuid() != 0:
            self.addCleanup(folder.chmod, 0o755)
            folder.chmod(0o555)
            return {}
        self.folder.chmod(0o755)
        return {"user": 65534, "group": 65534, "extra_groups": []}

    def run_there(self, options, *arguments):
        done = subprocess.run([cli.program, *map(str, arguments)], cwd="/", capture_output=True, text=True,
                              timeout=120, **options)
        return cli.Run(done.returncode, done.stdout, done.stderr)

    def test_a_store_in_a_folder_that_cannot_be_written_is_read(self):
        folder = self.folder / "read-only"
        folder.mkdir()
        store = self.search(folder / "s?.store")
        options = self.read_only(folder)
        if self.run_there(options, "--version").code != 0:
            self.skipTest("the program cannot be run by nobody")
        expected = cli.run("status", store).out
        there = self.run_there(options, "status", store)
        self.assertEqual((there.code, there.out), (0, expected), there.err)
        out = self.folder / "out"
        out.mkdir()
        out.chmod(0o777)
        for arguments in (("report", store, "-o", out / "report"), ("merge", out / "m.store", store),
                          ("problem", store, 0, 0)):
            done = self.run_there(options, *arguments)
            self.assertEqual(done.code, 0, done.err)
        done = self.run_there(options, "search", *CAMPAIGN, "--store", store, "--problems", 10**6)
        self.assertEqual(done.code, 74, done.err)
        self.assertIn(str(store), done.err)
        self.assertEqual([path.name for path in folder.iterdir()], [store.name])

    def test_commits_of_a_killed_search_are_read_there_too(self):
        folder = self.folder / "read-only"
        folder.mkdir()
        live = self.folder / "live.store"
        search = self.start(live)
        search.send_signal(signal.SIGSTOP)
        while not all(stat.read_text().rpartition(")")[2].split()[0] == "T"
                      for stat in Path(f"/proc/{search.pid}/task").glob("*/stat")):  # it writes until all threads stand
            time.sleep(0.01)
        store = folder / "s.store"
        for end in ("", "-wal"):
            shutil.copy(f"{live}{end}", f"{store}{end}")
        self.assertGreater(os.path.getsize(f"{store}-wal"), 0)
        expected = cli.unwrapped(cli.run("status", live).out.replace(str(live), str(store)))
        options = self.read_only(folder)
        if self.run_there(options, "--version").code != 0:
            self.skipTest("the program cannot be run by nobody")
        there = self.run_there(options, "status", store)
        self.assertEqual((there.code, cli.unwrapped(there.out)), (0, expected), there.err)
        if os.geteuid() == 0:
            folder.chmod(0o700)
            closed = self.run_there(options, "status", store)
            self.assertEqual(closed.code, 2, closed.err)
            self.assertIn(f"{store}: Permission denied", closed.err)

    def test_files_that_are_no_stores_are_refused_by_name_and_left_alone(self):
        for content in (b"", b"x", b"{}" * 5000):
            file = self.folder / "file"
            file.write_bytes(content)
            for arguments in (("search", *CAMPAIGN, "--store", file), ("status", file),
                              ("report", file, "-o", self.folder / "report"),
                              ("merge", file, self.search(self.folder / "s.store"))):
                self.refuses(*arguments, says=[file, "expected a store: a file that stiction search writes"], timeout=20)
                self.assertEqual(file.read_bytes(), content)
        os.mkfifo(self.folder / "pipe")
        self.refuses("status", self.folder / "pipe", says="pipe", timeout=20)
        self.refuses("search", *CAMPAIGN, "--store", self.folder / "pipe", says="pipe", timeout=20)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["file", "pipe", "s.store"])


if __name__ == "__main__":
    cli.main()
