# SPDX-License-Identifier: Apache-2.0
"""A search that is killed again and again leaves, in the end, the store of one that was not.

kill_test.py PATH_TO_STICTION
"""

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

KILLS = 10
UNIT = 300 if cli.SHORT else 1200
PROBLEMS = 880 * UNIT  # 1056 units: one block and some
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 5, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "unit_problems": UNIT}


class Kill(cli.TestCase):
    def command(self, store):
        return [cli.program, "search", str(self.campaign), "--store", str(store), "--problems", str(PROBLEMS),
                "--threads", "1", "--finishing", "100"]

    def run_to_the_end(self, store):
        start = time.monotonic()
        done = subprocess.run(self.command(store), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return time.monotonic() - start

    def run_and_kill(self, store, seconds):
        """Whether the search was still running."""
        search = subprocess.Popen(self.command(store), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        try:
            _, err = search.communicate(timeout=seconds)
            self.assertEqual(search.returncode, 0, err)
            return False
        except subprocess.TimeoutExpired:
            os.kill(search.pid, signal.SIGKILL)
            search.communicate()
            self.assertEqual(search.returncode, -signal.SIGKILL)
            return True

    def progress(self, store):
        rows = cli.content(store)
        done = sum(row[10] for row in rows["findings"])
        return len(rows["units"]) + 1024 * len(rows["blocks"]), done

    def test_a_killed_search_loses_nothing(self):
        self.campaign = self.file("campaign.json", CAMPAIGN)
        reference, killed = self.folder / "reference.store", self.folder / "killed.store"
        seconds = self.run_to_the_end(reference)
        units, findings = self.progress(reference)
        self.assertGreater(units, 1024)
        self.assertGreater(findings, 2 if cli.SHORT else 10)

        # Ten stretches that together are about as long as the whole search.
        moments = random.Random(1994)
        last, kills, between = (0, 0), 0, set()
        for _ in range(KILLS):
            kills += self.run_and_kill(killed, seconds * moments.uniform(0.5, 1.4) / KILLS)
            try:
                now = self.progress(killed)
            except Exception:  # killed before there was a store
                now = last
            self.assertGreaterEqual(now[0], last[0], "units were lost")
            last = now
            between.add(now)
        print(f"{seconds:.1f} s to the end; {kills} kills, at {sorted(between)} units and findings", file=sys.stderr)
        self.assertGreaterEqual(kills, KILLS // 2)
        self.assertGreater(len(between), 1)  # the search got on between the kills

        self.run_to_the_end(killed)
        self.assertSameContent(killed, reference)
        self.assertEqual(self.progress(killed), (units, findings))


if __name__ == "__main__":
    cli.main()
