# SPDX-License-Identifier: Apache-2.0
"""The page of every scene of the corpus shows all its frames in a browser.

pages_test.py PATH_TO_STICTION [SOURCES]

Needs no package: never skipped. Without chromium, which `./run test` installs, it fails.
"""

import functools
import http.server
import json
import re
import shutil
import subprocess
import tempfile
import threading
import unittest
from html import unescape
from pathlib import Path

import cli

SECONDS = 0.1  # of each scene

# Opens one page after the other and goes through its frames by the keys.
INDEX = r"""<!DOCTYPE html><meta charset="utf-8"><body><iframe width="900" height="700"></iframe><pre id="result"></pre>
<script type="module">
const view = document.querySelector('iframe'), result = {};
async function look(name) {
  const there = new Promise(done => { view.onload = done; });
  view.src = name;
  await there;
  const page = view.contentDocument, frames = [];
  while (page.querySelector('.place') === null) await new Promise(done => setTimeout(done, 1));  // unpacked
  const press = key => page.dispatchEvent(new view.contentWindow.KeyboardEvent('keydown', {key}));
  const sizes = () => [...page.querySelectorAll('#picture :is(path, circle, polygon, line)')]
                          .map(shape => shape.getBoundingClientRect()).map(box => box.width + box.height);
  const place = () => page.querySelector('.place').textContent;
  for (let before = null; place() !== before; press('ArrowRight')) {
    before = place();
    frames.push({
      rows: page.querySelectorAll('#choice option').length,
      shapes: sizes().filter(size => size > 2).length,
      wrong: page.querySelector('main').outerHTML.match(/.{0,60}(NaN|undefined|Infinity|null).{0,60}/)?.[0] ?? '',
    });
  }
  press(' ');
  const plays = page.querySelector('[aria-label="Pause"]') !== null;
  press(' ');
  return {frames, plays};
}
for (const name of %s) result[name] = await look(name);
document.getElementById('result').textContent = JSON.stringify(result);
</script></body>"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def do_GET(self):
        if self.path != "/favicon.ico":
            return super().do_GET()
        self.send_response(204)
        return self.end_headers()


class Pages(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.site = Path(tempfile.mkdtemp(prefix="stiction-pages-"))
        cls.addClassCleanup(shutil.rmtree, cls.site, ignore_errors=True)
        cls.scenes = sorted((cli.ROOT / "corpus/scenes").rglob("*.json"))
        cls.pages = []
        for number, scene in enumerate(cls.scenes):
            out = cls.site / f"{number}-{scene.stem}"
            done = cli.run("simulate", scene, "-o", out, "--seconds", SECONDS, "--no-svg")
            if done.code not in (0, 3):  # 3: a scene that is to have no answer
                raise AssertionError(f"{scene}: exit {done.code}\n{done.err}")
            cls.pages.append(out / "animation.html")

    def test_all_scenes_are_here(self):
        folders = {scene.parent.name for scene in self.scenes}
        self.assertEqual(folders, {"scenes", "space", "large"})

    def browse(self, url):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   "--disable-dev-shm-usage", "--no-proxy-server", "--window-size=1200,900",
                   f"--user-data-dir={self.folder}/profile", "--enable-logging=stderr",
                   "--virtual-time-budget=10000"]
        return subprocess.run([browser, *options, "--dump-dom", url], capture_output=True, text=True, timeout=300)

    def shown(self, names):
        """What the browser saw of each page, and what it complained of."""
        (self.site / "index.html").write_text(INDEX % json.dumps(names))
        handler = functools.partial(Quiet, directory=self.site)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            done = self.browse(f"http://127.0.0.1:{server.server_port}/index.html")
            server.shutdown()
        self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line], [])
        found = re.search(r'<pre id="result">(.+?)</pre>', done.stdout)
        self.assertIsNotNone(found, done.stdout[-2000:] + done.stderr[-2000:])
        return json.loads(unescape(found[1]))

    def test_every_page_shows_all_its_frames_in_a_browser_without_an_error(self):
        names = [str(page.relative_to(self.site)) for page in self.pages]
        shown = self.shown(names)
        self.assertEqual(sorted(shown), sorted(names))
        for name, page in shown.items():
            frames = cli.animation(self.site / name)["frames"]
            self.assertEqual([frame["rows"] for frame in page["frames"]],
                             [len(frame["forces"]) for frame in frames], name)
            for number, frame in enumerate(page["frames"]):
                self.assertEqual(frame["wrong"], "", f"{name}, frame {number}")
                self.assertGreater(frame["shapes"], 0, f"{name}, frame {number}: nothing was drawn")
            self.assertEqual(page["plays"], len(frames) > 1, name)


if __name__ == "__main__":
    cli.main()
