# SPDX-License-Identifier: Apache-2.0
"""A night: log lines, finishing within its share, commands for findings, a clock that is set back; campaigns as files."""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time

import cli

SMALL = ("--generator", "small", "--contacts", 2, 3)
CAMPAIGNS = cli.ROOT / "search" / "campaigns"
# The clock of the day goes back an hour at every look; those that measure do not.
BACKWARDS = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>
int clock_gettime(clockid_t clock, struct timespec* time) {
  static int (*real)(clockid_t, struct timespec*);
  static long back;
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  const int status = real(clock, time);
  if (clock == CLOCK_REALTIME) time->tv_sec -= 3600 * ++back;
  return status;
}
"""


class Night(cli.TestCase):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.store"

    def search(self, *arguments, **options):
        return self.succeeds("search", *SMALL, "--store", self.store, *arguments, **options)

    def status(self):
        return self.succeeds("status", self.store, "--json").json()

    # ---- Log ----

    def test_log_lines_are_dated_and_say_what_is_new(self):
        done = self.search("--problems", 300000, "--seed", 3)
        lines = [line for line in done.err.splitlines() if "problems," in line]
        self.assertGreater(len(lines), 0)
        for line in lines:
            self.assertRegex(line, r"^20\d\d-\d\d-\d\d \d\d:\d\d:\d\d [\d,]+ problems, [\d,]+ a second, ")
        named = [int(n) for n in re.findall(r"(\d+) new group", done.err)]
        self.assertEqual(sum(named), len(cli.content(self.store)["findings"]))
        again = self.search("--problems", 300000, "--seed", 3)
        self.assertNotIn("new group", again.err)

    def test_a_group_that_the_corpus_has_is_called_known(self):
        commands = self.folder / "known"
        self.succeeds("search", "--generator", "integers", "psd", "small", "--contacts", 2, "--mu", 1, "--problems", 6000000,
                      "--finishing", 0, "--store", self.store, "--on-finding", f'echo "$STICTION_KNOWN" >>{commands}')
        known = set(commands.read_text().split())
        self.assertGreater(len(known), 0)
        cases = {path.stem for path in (cli.ROOT / "corpus").rglob("*.json")}
        self.assertLessEqual(known, cases)

    # ---- Finishing ----

    def test_finishing_takes_no_more_than_its_share_while_there_are_units(self):
        self.succeeds("search", "--generator", "conditioned", "--contacts", 4, 5, "--store", self.store, "--minutes", 0.4,
                      "--threads", 1)
        time_spent = self.status()["processor_seconds"]
        total = sum(time_spent.values())
        self.assertGreater(time_spent["finishing"], 0)
        self.assertLessEqual(time_spent["finishing"], 0.2 * total + 8)  # one try beyond the share

    def test_finishing_ends_after_the_last_unit(self):
        self.succeeds("search", "--generator", "near-degenerate", "--contacts", 8, "--objective", "period", "--mu", 1,
                      "--problems", 1000 if cli.SHORT else 2000, "--store", self.store, "--threads", 1, timeout=600)
        self.assertGreater(self.status()["pending"], 10)
        # half a minute and one try beyond it
        self.assertLessEqual(self.status()["processor_seconds"]["finishing"], 120 if cli.SHORT else 40)
        self.assertIn(f"--store {self.store} --finish", self.succeeds("status", self.store).out)

    def test_what_is_left_is_counted_and_finished_when_asked(self):
        self.search("--problems", 300000, "--seed", 3, "--finishing", 0)
        left = self.status()
        self.assertEqual((left["finished"], left["processor_seconds"]["finishing"]), (0, 0))
        self.assertGreater(left["pending"], 2)
        self.assertIn(f"--store {self.store} --finish", self.succeeds("status", self.store).out)
        done = self.succeeds("search", "--store", self.store, "--finish")
        now = self.status()
        self.assertEqual((now["pending"], now["finished"]), (0, left["pending"]))
        self.assertEqual(now["units"], left["units"])
        self.assertGreater(now["processor_seconds"]["finishing"], 0)
        self.assertNotIn("internal error", done.err)
        # The findings are those of a search that finished as it went.
        other = self.folder / "other.store"
        self.succeeds("search", *SMALL, "--problems", 300000, "--seed", 3, "--finishing", 100, "--store", other)
        self.assertSameContent(other, self.store)

    def test_finishing_alone_takes_no_options_of_a_campaign(self):
        self.search("--problems", 2000)
        for option in (("--seed", 1), ("--problems", 1), ("--generator", "psd"), ("--gravity-only",)):
            self.refuses("search", "--store", self.store, "--finish", *option, says="--finish")
        self.refuses("search", "--store", self.folder / "none.store", "--finish", says="none.store")
        for share in ("-1", "101", "x"):
            self.refuses("search", "--store", self.store, "--finishing", share, says="--finishing")

    def test_copies_of_a_store_are_finished_in_shards_and_merged(self):
        self.search("--problems", 300000, "--seed", 4, "--finishing", 0)
        parts = [shutil.copy(self.store, self.folder / f"part-{i}") for i in range(2)]
        finished = []
        for i, part in enumerate(parts):
            self.succeeds("search", "--store", part, "--finish", "--shard", f"{i}/2")
            rows = cli.content(part)["findings"]
            finished.append({row[0] for row in rows if row[10]})
            self.assertEqual(finished[-1], {row[0] for row in rows if row[2] % 2 == i})
        self.assertTrue(all(finished), finished)
        merged = self.folder / "merged.store"
        self.succeeds("merge", merged, *parts)
        self.succeeds("search", "--store", self.store, "--finish")
        self.assertSameContent(merged, self.store)

    def test_time_is_split_and_adds_up(self):
        self.search("--problems", 400000, "--threads", 1)
        parts = self.status()["processor_seconds"]
        self.assertEqual(list(parts), ["generation", "doubles", "filtered", "exact", "compared", "finishing"])
        self.assertTrue(all(seconds > 0 for seconds in parts.values()), parts)
        self.assertRegex(self.succeeds("status", self.store).out, r"processor time: [\d.]+ s: generation \d+")
        self.succeeds("report", self.store, "-o", self.folder / "report")
        page = (self.folder / "report" / "index.html").read_text()
        with open(self.folder / "report/work.csv", newline="") as file:
            work = {row["what"]: row["value"] for row in csv.DictReader(file)}
        for name, seconds in parts.items():
            self.assertAlmostEqual(float(work[name]), seconds, 6)
        self.assertIn(self.status()["builds"][0].split(",")[0], page)

    def test_another_build_goes_on_and_both_stand_in_the_store(self):
        self.search("--problems", 20000)
        self.assertGreater(cli.change(self.store, "UPDATE work SET builds = '[\"another build\"]'"), 0)
        self.search("--problems", 60000)
        builds = self.status()["builds"]
        self.assertEqual(len(builds), 2)
        self.assertIn("another build", builds)
        cli.change(self.store, "UPDATE campaign SET value = '99' WHERE key = 'algorithm'")
        self.refuses("search", *SMALL, "--store", self.store, says=["version of the algorithm 99, not ", "--store NEW_FILE"])

    # ---- Commands ----

    def test_a_command_is_run_for_each_new_group_with_the_finding(self):
        out = self.folder / "out"
        out.mkdir()
        self.search("--problems", 300000, "--seed", 3, "--on-finding",
                    f'cat >"{out}/$STICTION_SIGNATURE" && echo "$STICTION_KIND $STICTION_GRAVE $STICTION_CONTACTS '
                    f'$STICTION_UNIT $STICTION_INDEX $STICTION_STORE" >>{self.folder}/lines')
        findings = {row[0]: row for row in cli.content(self.store)["findings"]}
        self.assertEqual({path.name for path in out.iterdir()}, set(findings))
        for signature in findings:
            told = json.loads((out / signature).read_text())
            self.assertEqual((told["signature"], told["grave"]), (signature, False))
            self.assertEqual(told["problem"]["format"], "stiction-problem")
        lines = [line.split() for line in (self.folder / "lines").read_text().splitlines()]
        self.assertEqual(len(lines), len(findings))
        for kind, grave, _, _, _, store in lines:
            self.assertEqual((grave, store), ("0", str(self.store)))
            self.assertIn(kind, {row[1] for row in findings.values()})

    def test_a_command_that_fails_is_reported_and_ends_nothing(self):
        done = self.search("--problems", 300000, "--seed", 3, "--finishing", 100, "--on-finding", "exit 3")
        count = len(cli.content(self.store)["findings"])
        self.assertEqual(done.err.count("ended with status 3"), count)
        reference = self.folder / "b.store"
        self.succeeds("search", *SMALL, "--problems", 300000, "--seed", 3, "--finishing", 100, "--store",
                      reference)
        self.assertSameContent(self.store, reference)
        self.store.unlink()
        done = self.search("--problems", 300000, "--seed", 3, "--on-finding", "kill -9 $$")
        self.assertEqual(done.err.count("ended by signal 9"), count)

    # ---- Watching ----

    def test_status_watches_as_long_as_a_search_runs(self):
        search = subprocess.Popen([cli.program, "search", *map(str, SMALL), "--store", self.store, "--minutes", "60"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(search.wait)
        self.addCleanup(search.kill)
        while not self.store.exists():
            time.sleep(0.05)
        watch = subprocess.Popen([cli.program, "status", self.store, "--watch"], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True)
        self.addCleanup(watch.kill)
        time.sleep(7)
        self.assertIsNone(watch.poll())
        search.send_signal(signal.SIGTERM)
        out, err = watch.communicate(timeout=60)
        self.assertEqual(watch.returncode, 0, err)
        self.assertRegex(err, r"(?m)^20\S+ \S+ [\d,]+ runs, [\d,]+ more; \d+ groups, \d+ new")
        self.assertIn("no process works on", err)
        self.assertIn("problems in", out)
        self.assertIn("no process works on", self.succeeds("status", self.store, "--watch").err)

    # ---- Clocks ----

    def test_a_clock_that_is_set_back_changes_nothing(self):
        source, library = self.file("back.c", BACKWARDS), self.folder / "back.so"
        compiled = shutil.which("gcc") and subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, source, "-ldl"],
                                                          capture_output=True).returncode == 0
        if not compiled or "san" in os.environ.get("ASAN_OPTIONS", ""):
            self.skipTest("SKIPPED: no library can be put in front of the clock")
        start = time.monotonic()
        done = subprocess.run([cli.program, "search", *map(str, SMALL), "--store", self.store, "--minutes", "0.05"],
                              env={**os.environ, "LD_PRELOAD": str(library)}, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(time.monotonic() - start, 2.9)
        self.assertIn("problems in", done.stdout)
        self.search("--minutes", 0.01)

    # ---- Campaigns ----

    def test_every_campaign_file_runs_and_is_explained(self):
        explained = (CAMPAIGNS / "README.md").read_text()
        files = sorted(CAMPAIGNS.glob("*.json"))
        self.assertGreater(len(files), 10)
        for file in files:
            with self.subTest(campaign=file.stem):
                self.assertIn(f"| `{file.stem}` |", explained)
                small = json.loads(file.read_text())
                small["unit_problems"] = 40  # for a few problems
                store = self.folder / f"{file.stem}.store"
                options = ("--problems", 120, "--finishing", 0, "--store", store)
                self.succeeds("search", self.file("c.json", small), *options)
                self.assertGreaterEqual(self.succeeds("status", store, "--json").json()["units"], 1)
        self.assertEqual(set(re.findall(r"(?m)^\| `([\w-]+)` \|", explained)), {file.stem for file in files})


if __name__ == "__main__":
    cli.main()
