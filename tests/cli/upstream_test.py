# SPDX-License-Identifier: Apache-2.0
"""export --reproducer ode, bullet: what is wrong with these packages is shown without a line of stiction."""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import cli

LIBRARIES = {"ode": "ode", "ode-frictionless": "ode", "bullet-dantzig": "bullet", "bullet-lemke": "bullet"}
HEADERS = ("/usr/include/ode/common.h", "/usr/include/bullet/BulletDynamics/MLCPSolvers/btDantzigLCP.h")


class Upstream(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        if missing := [file for file in HEADERS if not Path(file).exists()]:
            print(f"SKIPPED: {missing} of libode-dev and libbullet-dev are not installed")
            raise unittest.SkipTest("packages")
        build = Path(cli.program).parent
        cls.peers = build / "peers"
        subprocess.run(["cmake", "-G", "Ninja", "-S", cli.ROOT / "bench/peers", "-B", cls.peers, f"-DSTICTION_BUILD={build}"],
                       check=True, capture_output=True)
        subprocess.run(["ninja", "-C", cls.peers, *LIBRARIES], check=True, capture_output=True)

    def test_every_group_is_shown_by_its_package_alone(self):
        for library, package in LIBRARIES.items():
            store = self.folder / f"{library}.store"
            self.succeeds("search", "--solver", self.peers / f"{library}.so", "-g", "integers", "-c", 2, 3, "--problems", 20000,
                          "--finishing", 100, "--store", store)
            groups = self.succeeds("status", store, "--json").json()["groups"]
            self.assertTrue(groups, library)
            for group in groups:
                with self.subTest(library=library, finding=group["signature"]):
                    self.shown(f"{store}:{group['signature']}", package)

    def shown(self, finding, package):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        self.succeeds("export", finding, "--reproducer", package, "-o", folder / "shown.cpp")
        text = (folder / "shown.cpp").read_text()
        self.assertLessEqual(len(text.splitlines()), 60)
        self.assertNotIn("stiction", text)
        command = re.sub(r"\\\n \* *", "", re.search(r" \*     (.*?) \*/", text, re.S)[1])
        done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout)
        self.assertIn("WRONG: ", done.stdout)
        shutil.rmtree(folder)


if __name__ == "__main__":
    cli.main()
