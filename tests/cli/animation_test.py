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


def boxes_in_space():
    """A hundred boxes that fall on each other, four at each of 25 places, askew."""
    bodies = [{"name": "floor", "fixed": True, "shapes": [{"box": [40, 40, 1], "center": ["0", "0", "-1/2"]}]}]
    for k in range(100):
        place = [f"{20 * (k % 5) + 7 * k % 5}/10", f"{20 * (k // 5 % 5) + 3 * k % 4}/10", f"{6 + 11 * (k // 25)}/10"]
        bodies.append({"name": f"box {k + 1}", "mass": 1, "position": place, "shapes": [{"box": [1, 1, 1]}]})
    return {"format": "stiction-scene", "version": 1, "name": "boxes", "dimension": 3, "gravity": [0, 0, -10],
            "mu": "1/2", "gap": "1/1000", "bodies": bodies}


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
        script = Path(__file__).with_name("animation_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=600, env=dict(
            os.environ, PAGES=str(self.folder), PACKAGES=str(packages), BROWSER=browser, PROGRAM=cli.program))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 10, done.stdout[-2000:])

    def test_ninety_frames_of_a_hundred_bodies_are_less_than_a_megabyte(self):
        falling = self.file("boxes.json", boxes_in_space())
        for scene, most in ((cli.ROOT / "corpus/scenes/large/brick-wall.json", 500000), (falling, 1000000)):
            out = self.folder / "large-run"
            self.succeeds("simulate", scene, "-o", out, "--seconds", 3, "--no-svg", "--tables", "none")
            page = out / "animation.html"
            self.assertLess(page.stat().st_size, most)
            self.assertEqual(len(cli.animation(page)["frames"]), 91)


if __name__ == "__main__":
    cli.main()
