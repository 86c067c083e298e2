# SPDX-License-Identifier: Apache-2.0
"""pip_test.py PROGRAM SOURCES: pip installs the package without a network; an unbuilt tree says what to run."""
import importlib.util
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

BUILD, SOURCES = Path(sys.argv[1]).parent, Path(sys.argv[2])
CLEAN = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}


class Pip(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("ensurepip") and importlib.util.find_spec("venv"),
                         "SKIPPED: python3-venv is not installed")
    def test_it_is_installed_into_a_virtual_environment_and_works_there(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder], check=True,
                           stdout=subprocess.DEVNULL)
            python = Path(folder) / "bin/python"
            done = subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-build-isolation",
                                   "--disable-pip-version-check", "--config-settings", f"build={BUILD}", SOURCES],
                                  env=CLEAN, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            asked = ("import stiction; p = stiction.load('corpus/cycle-every-policy-mu-1.json'); "
                     "print(stiction.__file__, stiction.replay(p).outcome, stiction.solve(p).outcome)")
            told = subprocess.run([python, "-c", asked], cwd=SOURCES, env=CLEAN, check=True, capture_output=True,
                                  text=True).stdout.split()
            self.assertTrue(told[0].startswith(folder), told)
            self.assertEqual(told[1:], ["cycle", "solved"])

    def test_sdist_and_wheel_are_made_and_whole(self):
        """What the nightly run leaves in build/release/packages: the sdist has all files of the repository, and what the
        wheel has works where it is unpacked."""
        backend = ("import sys; sys.path.insert(0, 'python'); import build_backend as b; "
                   "print(b.build_{}(sys.argv[1], {}))")
        packages = BUILD / "packages"
        packages.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            made = [subprocess.run([sys.executable, "-c", backend.format(kind, settings), packages], cwd=SOURCES,
                                   check=True, env=CLEAN, capture_output=True, text=True).stdout.split()[-1]
                    for kind, settings in (("sdist", None), ("wheel", {"build": str(BUILD)}))]
            with tarfile.open(packages / made[0]) as archive:
                names = {name.split("/", 1)[1] for name in archive.getnames()}
            listed = subprocess.run(["git", "-C", SOURCES, "ls-files"], check=True, capture_output=True, text=True)
            self.assertEqual(names, {*listed.stdout.splitlines(), "PKG-INFO"})
            with zipfile.ZipFile(packages / made[1]) as archive:
                self.assertIsNone(archive.testzip())
                archive.extractall(folder)
            self.assertEqual({file.name for file in Path(folder, "stiction").iterdir() if file.suffix != ".so"},
                             {file.name for file in (SOURCES / "python/stiction").iterdir() if file.is_file()})
            asked = "import stiction; print(stiction.__file__, len(stiction.methods()))"
            told = subprocess.run([sys.executable, "-c", asked], cwd=folder, env=CLEAN, check=True, capture_output=True,
                                  text=True).stdout.split()
            self.assertTrue(told[0].startswith(folder), told)

    def test_an_unbuilt_tree_says_what_to_run(self):
        done = subprocess.run([sys.executable, "-c", "import stiction"], cwd=SOURCES / "python", env=CLEAN,
                              capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        last = done.stderr.splitlines()[-1]
        self.assertRegex(last, r"^ImportError: stiction: found no compiled module .*\./run python.*pip install")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
