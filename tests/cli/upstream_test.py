# SPDX-License-Identifier: Apache-2.0
"""export --reproducer ode, bullet, dart, siconos: what is wrong with these packages is shown without a line of stiction."""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import cli

# Each with its package, and the generator and contacts of its search.
PLANE, SCENES, SPACE = ("integers", 2, 3), ("scenes", 2, 3), ("space", 1, 2)
LIBRARIES = {"ode": ("ode", PLANE), "ode-frictionless": ("ode", PLANE), "bullet-dantzig": ("bullet", PLANE),
             "bullet-dantzig-frictionless": ("bullet", PLANE), "bullet-lemke": ("bullet", PLANE), "dart": ("dart", PLANE),
             "dart-frictionless": ("dart", PLANE), "siconos-lemke": ("siconos", SCENES), "siconos-nsgs": ("siconos", PLANE),
             "siconos-nsn-ac": ("siconos", SPACE)}
FOUND_NONE = {"siconos-lemke"}  # in searches of this size
HEADERS = {"ode": "ode/common.h", "bullet": "bullet/BulletDynamics/MLCPSolvers/btDantzigLCP.h",
           "dart": "dart/external/odelcpsolver/lcp.h", "siconos": "siconos/numerics/fc2d_Solvers.h"}
HERE = {package for package, header in HEADERS.items() if (Path("/usr/include") / header).exists()}
KEPT = cli.ROOT / "corpus/peers/minimized"


class Upstream(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        if not HERE:
            print(f"SKIPPED: not installed: {', '.join(HEADERS)}")
            raise unittest.SkipTest("packages")
        print("of", *sorted(HERE))
        cls.libraries = {library: row for library, row in LIBRARIES.items() if row[0] in HERE}
        build = Path(cli.program).parent
        cls.peers = build / "peers"
        subprocess.run(["cmake", "-G", "Ninja", "-S", cli.ROOT / "bench/peers", "-B", cls.peers, f"-DSTICTION_BUILD={build}"],
                       check=True, capture_output=True)
        subprocess.run(["ninja", "-C", cls.peers, *cls.libraries], check=True, capture_output=True)

    def test_every_group_is_shown_by_its_package_alone(self):
        for library, (package, (generator, *contacts)) in self.libraries.items():
            store = self.folder / f"{library}.store"
            self.succeeds("search", "--solver", self.peers / f"{library}.so", "-g", generator, "-c", *contacts,
                          "--problems", 20000, "--finishing", 100, "--store", store)
            groups = self.succeeds("status", store, "--json").json()["groups"]
            self.assertTrue(groups or library in FOUND_NONE, library)
            for group in groups:
                with self.subTest(library=library, finding=group["signature"]):
                    file = Path(tempfile.mkdtemp(dir=self.folder)) / "shown.cpp"
                    self.succeeds("export", f"{store}:{group['signature']}", "--reproducer", package, "-o", file)
                    self.shown(file)

    def test_what_is_kept_is_shown_by_its_package_alone(self):
        programs = sorted(file for package in HERE for file in KEPT.glob(f"{package}-*.cc"))
        self.assertTrue(programs)
        for program in programs:
            with self.subTest(program=program.name):
                folder = Path(tempfile.mkdtemp(dir=self.folder))
                self.shown(Path(shutil.copy(program, folder)))

    def shown(self, file):
        text = file.read_text()
        self.assertLessEqual(len(text.splitlines()), 60)
        self.assertNotIn("stiction", text)
        command = re.sub(r"\\\n \* *", "", re.search(r" \*     (.*?) \*/", text, re.S)[1])
        compiler, program = command.split(" && ")
        built = subprocess.run(compiler, shell=True, cwd=file.parent, capture_output=True, text=True)
        self.assertEqual((built.returncode, built.stderr), (0, ""))
        done = subprocess.run(program, shell=True, cwd=file.parent, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        # Siconos writes there what its factorizations meet; a sanitizer or a loader would say something else.
        self.assertEqual([line for line in done.stderr.splitlines() if not line.startswith("NM_LU_factorize: ")], [])
        self.assertIn("WRONG: ", done.stdout)
        shutil.rmtree(file.parent)


if __name__ == "__main__":
    cli.main()
