# SPDX-License-Identifier: Apache-2.0
"""The replay viewer: its bundle is what its sources give, and, at night, a browser shows what the program found.

viewer_test.py PATH_TO_STICTION [SOURCES]

What needs npm's packages is SKIPPED, with its reason, where npm reaches no registry. Without npm, nodejs or chromium,
all of which `./run test` installs, it fails.
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import cli
from viewer_data_test import PAGES, arguments

WEB = "reports/web"
UNREACHABLE = re.compile(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|EHOSTUNREACH|"
                         r"ERR_SOCKET_TIMEOUT|FETCH_ERROR")


class Packages:
    """A copy of the pages' sources with the packages of their lock file."""

    folder = None

    @classmethod
    def get(cls):
        if cls.folder is None:
            if shutil.which("npm") is None:
                raise AssertionError("expected npm: apt-get install npm")
            cls.folder = Path(tempfile.mkdtemp(prefix="stiction-web-"))
            shutil.copytree(cli.ROOT / WEB, cls.folder, dirs_exist_ok=True,
                            ignore=shutil.ignore_patterns("node_modules", "dist"))
            cls.install()
        return cls.folder

    @classmethod
    def install(cls):
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--fetch-retries=1", "--fetch-retry-mintimeout=1000",
                               "--fetch-timeout=60000"], cwd=cls.folder, capture_output=True, text=True, timeout=600)
        if done.returncode != 0 and UNREACHABLE.search(done.stderr):
            print("SKIPPED: the bundle and the browser: npm reaches no registry here")
            raise unittest.SkipTest("npm reaches no registry")
        if done.returncode != 0:
            raise AssertionError(f"npm ci: {done.stderr}")

    @classmethod
    def remove(cls):
        if cls.folder is not None:
            shutil.rmtree(cls.folder, ignore_errors=True)


unittest.addModuleCleanup(Packages.remove)


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Bundle(cli.TestCase):
    def test_the_lock_file_names_versions_and_hashes_and_no_address(self):
        lock = json.loads((cli.ROOT / WEB / "package-lock.json").read_text())
        for name, package in lock["packages"].items():
            self.assertNotIn("resolved", package, name)
            self.assertTrue(name == "" or package["integrity"].startswith("sha512-"), name)
        for name, version in lock["packages"][""]["devDependencies"].items():
            self.assertRegex(version, r"^\d+\.\d+\.\d+$", name)

    def test_the_sources_give_the_committed_page_to_the_byte(self):
        web, out = Packages.get(), self.folder / "dist"
        done = subprocess.run(["node", "build.mjs", out], cwd=web, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        committed = cli.ROOT / WEB / "dist"
        self.assertEqual(sorted(file.name for file in out.iterdir()), sorted(file.name for file in committed.iterdir()))
        for file in out.iterdir():
            self.assertTrue(file.read_bytes() == (committed / file.name).read_bytes(),
                            f"{file.name}: expected what npm ci and npm run build give in {WEB}")

    def test_what_is_bundled_is_named_with_its_licence(self):
        code = ("import {notices} from './build.mjs';"
                "console.log(JSON.stringify(notices(['src/dom.js', 'node_modules/katex/dist/katex.mjs'])));")
        done = subprocess.run(["node", "--input-type=module", "-e", code], cwd=Packages.get(), capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        notice, = json.loads(done.stdout)
        self.assertRegex(notice, r"^katex \d+\.\d+\.\d+\n\nThe MIT License")


@unittest.skipUnless(cli.ALL, "long")
class Browser(cli.TestCase):
    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        packages = Packages.get()
        at_rest = self.file("problem.json", dict(cli.SOLVED, b=["1", "0"]))  # no step at all
        for name, words in [*PAGES.items(), ("at-rest", [at_rest.as_posix()]),
                            ("large", ["corpus/safe-cycle-8-contacts.json"])]:
            done = cli.run("replay", *arguments(words), "--html", self.folder / f"{name}.html", "--step", "--json")
            self.assertIn(done.code, (0, 1), done.err)
            (self.folder / f"{name}.json").write_text(done.out)
        script = Path(__file__).with_name("viewer_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=900, env=dict(
            os.environ, PAGES=str(self.folder), PACKAGES=str(packages), BROWSER=browser,
            PROGRAM=cli.program))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 10, done.stdout[-2000:])


if __name__ == "__main__":
    cli.main()
