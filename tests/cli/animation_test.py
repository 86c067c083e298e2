# SPDX-License-Identifier: Apache-2.0
"""The page of a run of a scene, in a browser.

animation_test.py PATH_TO_STICTION [SOURCES]

Skipped and failed as viewer_test.py is.
"""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

import cli
from viewer_test import Packages

# With the seconds that each runs.
SCENES = {
    "plane": ("block-in-a-valley", 0.5),
    "space": ("space/tripod", 0.5),
    "large": ("large/brick-wall", 0.1),
}


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Browser(cli.TestCase):
    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        packages = Packages.get()
        for name, (scene, seconds) in SCENES.items():
            out = self.folder / f"run-{name}"
            done = cli.run("simulate", cli.ROOT / f"corpus/scenes/{scene}.json", "-o", out, "--seconds", seconds,
                           "--no-svg")
            self.assertEqual(done.code, 0, done.err)
            shutil.copy(out / "animation.html", self.folder / f"{name}.html")
        out = self.folder / "wall"
        self.succeeds("simulate", cli.ROOT / "corpus/scenes/large/brick-wall.json", "-o", out, "--seconds", 3, "--no-svg",
                      "--tables", "none")
        self.assertLess((out / "animation.html").stat().st_size, 1000000)  # about 90 frames of 100 bodies
        script = Path(__file__).with_name("animation_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=600, env=dict(
            os.environ, PAGES=str(self.folder), PACKAGES=str(packages), BROWSER=browser, PROGRAM=cli.program))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 10, done.stdout[-2000:])


if __name__ == "__main__":
    cli.main()
