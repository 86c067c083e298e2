# SPDX-License-Identifier: Apache-2.0
"""Searches, finishing, merges and reports that are killed again and again leave, in the end, what undisturbed ones do.

kill_test.py PATH_TO_STICTION [SOURCES] [--kills N]     N kills of each of the four
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

KILLS = 4 if cli.ALL else 2
UNIT = 1200 if cli.ALL else 300
PROBLEMS = 880 * UNIT  # 1056 units: one block and some
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 5, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "first_unit_problems": UNIT, "unit_problems": UNIT}
SHARDS = 3


def tree(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


class Kill(cli.TestCase):
    def setUp(self):
        super().setUp()
        self.campaign = self.file("campaign.json", CAMPAIGN)
        self.moments = random.Random(1994)

    def search(self, store, *options):
        return ["search", self.campaign, "--store", store, "--problems", PROBLEMS, "--threads", 1, *options]

    def to_the_end(self, arguments):
        """How long it takes."""
        start = time.monotonic()
        self.succeeds(*arguments, timeout=1200)
        return time.monotonic() - start

    def killed(self, arguments, seconds):
        """Whether it was still running when it was to be killed."""
        process = subprocess.Popen([cli.program, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        try:
            _, err = process.communicate(timeout=seconds)
            self.assertEqual(process.returncode, 0, err)
            return False
        except subprocess.TimeoutExpired:
            os.kill(process.pid, signal.SIGKILL)
            _, err = process.communicate()
            if process.returncode != -signal.SIGKILL:  # it ended in the last moment
                self.assertEqual(process.returncode, 0, err)
            return process.returncode != 0

    def kill_often(self, arguments, stretch, look, begin_anew):
        """Kills after random parts of a stretch of time, as often as was asked for; what has ended begins anew.

        What was there after each kill: a list for each beginning. A machine may have become slower: where nothing came
        to what was there before, the stretch grows.
        """
        kills, runs = 0, [[]]
        while kills < KILLS:
            if self.killed(arguments, max(0.01, stretch * self.moments.uniform(0.1, 1.3))):
                kills += 1
                runs[-1].append(look())
                stretch *= 1.5 if runs[-1][-2:-1] == runs[-1][-1:] else 1
            else:
                begin_anew()
                runs.append([])
        print(f"{arguments[0]}: {kills} kills, {len(runs) - 1} ends, at {runs}", file=sys.stderr)
        return runs

    def progress(self, store):
        """Units and finished findings; none of a store that is not there yet."""
        try:
            rows = cli.content(store)
        except Exception:  # killed before there was a store
            return 0, 0
        return len(rows["units"]) + 1024 * len(rows["blocks"]), sum(row[10] for row in rows["findings"])

    def assertNothingLost(self, runs, end):
        for looks in runs:
            self.assertEqual(looks, sorted(looks))
        on_the_way = {look for looks in runs for look in looks} - {end, (0, 0)}
        self.assertGreater(len(on_the_way), 0, "nothing was killed on its way")

    def test_a_killed_search_loses_nothing(self):
        reference, killed = self.folder / "reference.store", self.folder / "killed.store"
        command = self.search(killed, "--finishing", 100)
        seconds = self.to_the_end(self.search(reference, "--finishing", 100))
        end = self.progress(reference)
        self.assertGreater(end[0], 1024)
        self.assertGreater(end[1], 10 if cli.ALL else 2)

        def begin_anew():
            self.assertSameContent(killed, reference)
            killed.unlink()

        runs = self.kill_often(command, min(seconds / 4, 2 * seconds / KILLS), lambda: self.progress(killed), begin_anew)
        self.assertNothingLost([[look[:1] for look in looks] for looks in runs], end[:1])
        self.to_the_end(command)
        self.assertSameContent(killed, reference)

    def test_finishing_that_is_killed_goes_on(self):
        raw, reference, killed = (self.folder / f"{name}.store" for name in ("raw", "reference", "killed"))
        self.to_the_end(self.search(raw, "--finishing", 0))
        for copy in (reference, killed):
            shutil.copy(raw, copy)
        command = ["search", "--store", killed, "--finish", "--threads", 1]
        seconds = self.to_the_end(["search", "--store", reference, "--finish", "--threads", 1])

        def begin_anew():
            self.assertSameContent(killed, reference)
            shutil.copy(raw, killed)

        runs = self.kill_often(command, seconds / 3, lambda: self.progress(killed), begin_anew)
        self.assertNothingLost(runs, self.progress(reference))
        self.to_the_end(command)
        self.assertSameContent(killed, reference)

    def test_a_killed_merge_leaves_a_store_that_the_same_merge_completes(self):
        shards = [self.folder / f"{shard}.store" for shard in range(SHARDS)]
        for shard, store in enumerate(shards):
            self.to_the_end(self.search(store, "--shard", f"{shard}/{SHARDS}", "--finishing", 0))
        reference, killed = self.folder / "reference.store", self.folder / "killed.store"
        seconds = self.to_the_end(["merge", reference, *shards])
        command = ["merge", killed, *shards]

        def begin_anew():
            self.assertSameContent(killed, reference)
            killed.unlink()

        for looks in self.kill_often(command, seconds, lambda: self.progress(killed), begin_anew):
            for look in looks:
                self.assertLessEqual(look, self.progress(reference))
        self.to_the_end(command)
        self.assertSameContent(killed, reference)
        for shard in shards:  # nothing was taken from them
            self.succeeds("status", shard)

    def test_a_killed_report_leaves_the_old_folder_or_the_new_one(self):
        old, new, out = self.folder / "old", self.folder / "new", self.folder / "out"
        stores = [self.folder / name for name in ("a.store", "b.store")]
        for store, seed in zip(stores, (1, 2)):
            self.to_the_end(["search", "--store", store, "--generator", "small", "--contacts", 2, "--seed", seed,
                             "--problems", 100000, "--threads", 1])
        for store, folder in zip(stores, (old, new)):
            seconds = self.to_the_end(["report", store, "-o", folder])
        shutil.copytree(old, out)
        allowed = [tree(old), tree(new)]
        self.assertNotEqual(*allowed)

        def which():
            self.assertIn(tree(out), allowed)
            return ("old", "new")[allowed.index(tree(out))]

        self.kill_often(["report", stores[1], "-o", out], seconds, which,
                        lambda: self.to_the_end(["report", stores[0], "-o", out]))
        self.to_the_end(["report", stores[1], "-o", out])
        self.assertEqual(which(), "new")
        self.assertEqual([path for path in self.folder.iterdir() if path.name.startswith(".")], [])


if __name__ == "__main__":
    if "--kills" in sys.argv:
        at = sys.argv.index("--kills")
        KILLS = int(sys.argv[at + 1])
        del sys.argv[at:at + 2]
    cli.main()
