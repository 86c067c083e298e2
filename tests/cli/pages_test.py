# SPDX-License-Identifier: Apache-2.0
"""The page of every scene of the corpus runs in node, and some of each kind draw in a browser.

pages_test.py PATH_TO_STICTION [SOURCES]

Never skipped: without nodejs and chromium, both of which `./run test` installs, it fails.
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
# What the browser opens: it draws all frames of all pages in each tick of its clock.
OPENED = ("gears", "block-in-a-valley", "brick-wall", "dominoes", "conical-pendulum", "tripod")

# Runs the scripts of pages, with elements that take everything; plays frames and presses what can be pressed.
NODE = r"""
const fs = require('fs');
function run(file) {
  const written = [], handlers = [];
  const kinds = {style: 1, dataset: 1, classList: 1, parentNode: 1, firstChild: 1, options: 1};
  const many = () => Array.from({length: 1000}, element);
  function element() {
    return new Proxy({value: 0, max: 0, checked: false, children: [], textContent: ''}, {
      get(target, name) {
        if (name in target) return target[name];
        if (typeof name === 'symbol') return undefined;
        if (name === 'querySelectorAll') return many;
        if (name === 'getBoundingClientRect') return () => ({left: 0, top: 0, width: 800, height: 600});
        if (name === 'addEventListener') return (event, handler) => { handlers.push(handler); };
        if (name === 'setAttribute') return (key, value) => { written.push(String(value)); };
        return name in kinds ? target[name] = element() : () => element();
      },
      set(target, name, value) {
        if (typeof value === 'function') handlers.push(value);
        else if (name === 'innerHTML' || name === 'textContent') written.push(String(value));
        target[name] = value;
        return true;
      }});
  }
  const named = {};
  let next = null;
  const document = element();
  document.getElementById = name => named[name] = named[name] || element();
  const frame = step => { next = step; return 1; };
  const window = element();
  const media = () => element();
  const script = fs.readFileSync(file, 'utf8').match(/<script>([^]*)<\/script>/)[1];
  new Function('document', 'window', 'requestAnimationFrame', 'matchMedia', script)(document, window, frame, media);
  for (let k = 0; k < 10 && next !== null; ++k) next(k * 50 + 1);
  for (const handler of handlers.slice()) {
    handler({key: 'ArrowRight', target: element(), preventDefault() {}});
    if (next !== null) next(1000);
  }
  const bad = written.find(text => /NaN|undefined|Infinity/.test(text));
  if (bad !== undefined) throw new Error('wrote ' + bad.slice(0, 200));
  return new Set(written).size;
}
const results = {};
for (const file of process.argv.slice(1)) {
  try { results[file] = run(file); } catch (error) { results[file] = String(error); }
}
console.log(JSON.stringify(results));
"""

# Counts what each frame shows, once all are loaded.
INDEX = r"""<!DOCTYPE html><meta charset="utf-8"><body>%s<pre id="result"></pre><script>
onload = () => setTimeout(() => {
  const result = {};
  for (const frame of document.querySelectorAll('iframe')) {
    const shapes = [...frame.contentDocument.querySelectorAll('svg path, svg circle, svg polygon, svg line')];
    const sizes = shapes.map(shape => shape.getBoundingClientRect()).map(box => box.width + box.height);
    result[frame.getAttribute('src')] = sizes.filter(size => size > 2).length;
  }
  document.getElementById('result').textContent = JSON.stringify(result);
}, 300);
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

    def test_the_script_of_every_page_runs(self):
        self.assertIsNotNone(shutil.which("node"), "expected node: apt-get install nodejs")
        done = subprocess.run(["node", "-e", NODE, *map(str, self.pages)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        results = json.loads(done.stdout)
        self.assertEqual(len(results), len(self.pages))
        for page, result in results.items():
            self.assertIsInstance(result, int, f"{page}: {result}")
            self.assertGreater(result, 1, page)

    def browse(self, url):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   "--disable-dev-shm-usage", "--no-proxy-server", "--window-size=1200,900",
                   f"--user-data-dir={self.folder}/profile", "--enable-logging=stderr",
                   "--virtual-time-budget=1000"]
        return subprocess.run([browser, *options, "--dump-dom", url], capture_output=True, text=True, timeout=300)

    def test_pages_draw_in_a_browser_without_an_error(self):
        names = [str(page.relative_to(self.site)) for scene, page in zip(self.scenes, self.pages)
                 if scene.stem in OPENED]
        self.assertEqual(len(names), len(OPENED))
        frames = "".join(f'<iframe src="{name}" width="900" height="700"></iframe>' for name in names)
        (self.site / "index.html").write_text(INDEX % frames)
        handler = functools.partial(Quiet, directory=self.site)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            done = self.browse(f"http://127.0.0.1:{server.server_port}/index.html")
            server.shutdown()
        self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line], [])
        found = re.search(r'<pre id="result">(.+?)</pre>', done.stdout)
        self.assertIsNotNone(found, done.stdout[-2000:] + done.stderr[-2000:])
        shapes = json.loads(unescape(found[1]))
        self.assertEqual(sorted(shapes), sorted(names))
        for name, count in shapes.items():
            self.assertGreater(count, 0, f"{name}: nothing was drawn")


if __name__ == "__main__":
    cli.main()
