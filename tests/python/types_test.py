# SPDX-License-Identifier: Apache-2.0
"""types_test.py PROGRAM SOURCES: mypy accepts the package, its stub is of the compiled module, and mistakes
are refused."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stiction

PACKAGE = Path(stiction.__file__).resolve().parent
USE = """
import numpy as np
import stiction
problem = stiction.Problem(np.eye(2), np.zeros(2), 1)
answers: stiction.Answers = stiction.solve_many(np.eye(2), np.zeros((3, 2)), 1)
total: float = answers.seconds + float(answers.f.sum())
text: str = stiction.replay(problem).page()
"""
WRONG = USE + """
number: int = stiction.replay(problem).page()
stiction.solve(problem, methods="fast")
"""


def asked(module, *words, folder):
    env = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "MYPYPATH")}
    return subprocess.run([sys.executable, "-m", module, *words], cwd=folder, text=True, capture_output=True,
                          env=env | {"MYPYPATH": str(folder), "PYTHONPATH": str(folder)})


@unittest.skipUnless(shutil.which("mypy"), "SKIPPED: mypy is not installed")
class Types(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "stiction").symlink_to(PACKAGE)

    def test_mypy_accepts_the_package_and_what_uses_it_rightly(self):
        done = asked("mypy", "--strict", "-p", "stiction", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"no issues found in \d\d source files")
        for text, errors in ((USE, 0), (WRONG, 2)):
            (self.folder / "use.py").write_text(text)
            done = asked("mypy", "--strict", "use.py", folder=self.folder)
            self.assertEqual(len(re.findall(r"use\.py:\d+: error", done.stdout)), errors, done.stdout)

    def test_the_stub_names_what_the_compiled_module_has(self):
        # What pybind11 makes of any class.
        (self.folder / "allowed").write_text("stiction._stiction.(Problem|Store)(.__init__)?\n")
        done = asked("mypy.stubtest", "stiction._stiction", "--allowlist", "allowed", "--ignore-unused-allowlist",
                     folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
