# SPDX-License-Identifier: Apache-2.0
"""install_test.py PROGRAM SOURCES: what is installed of the package is all of it, and it finds Ipopt's program."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCES = Path(sys.argv[1]).parent, Path(sys.argv[2])
ASKED = """
import stiction, sys
problem = stiction.load(sys.argv[1])
print(stiction.__file__)
print(stiction.replay(problem).outcome, stiction.solve(problem).outcome, stiction.solve(problem, "ipopt").outcome)
"""


class Installed(unittest.TestCase):
    def test_it_is_whole_and_finds_what_stands_in_bin(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix = Path(folder) / "usr"
            subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", prefix],
                           check=True, stdout=subprocess.DEVNULL)
            package = prefix / "lib/python3/dist-packages/stiction"
            self.assertEqual({file.name for file in package.iterdir() if file.suffix != ".so"},
                             {file.name for file in (SOURCES / "python/stiction").iterdir() if file.is_file()})
            self.assertTrue((prefix / "share/doc/python3-stiction/copyright").exists())
            for notebook in (SOURCES / "python").glob("*.ipynb"):
                self.assertTrue((prefix / "share/doc/python3-stiction/examples" / notebook.name).exists())
            (prefix / "bin").mkdir()
            shutil.copy(BUILD / "stiction-ipopt", prefix / "bin")
            done = subprocess.run(
                [sys.executable, "-c", ASKED, SOURCES / "corpus/cycle-every-policy-mu-1.json"], check=True,
                env=os.environ | {"PYTHONPATH": str(package.parent)}, capture_output=True, text=True)
            self.assertEqual(done.stdout.splitlines(), [str(package / "__init__.py"), "cycle solved solved"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
