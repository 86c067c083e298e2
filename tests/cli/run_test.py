# SPDX-License-Identifier: Apache-2.0
"""What `./run` says on a machine that has nothing yet: the package manager and the build are stood in for."""

import os
import shutil
import subprocess
import unittest

import cli

APT = """#!/bin/bash
[[ $1 == install ]] || exit 0
for percent in 0 30.5 100; do echo "dlstatus:1:$percent:Retrieving file" >&3; done
echo "Unpacking g++"
for percent in 0 10 19.9 20 55 100; do echo "pmstatus:g++:$percent:Installing g++ (amd64)" >&3; done
exit $APT_STATUS
"""
NINJA = """#!/bin/bash
[[ $1 == -C ]] && printf '#!/bin/bash\necho "$@"\n' >"$2/stiction" && chmod +x "$2/stiction"
"""


@unittest.skipUnless(os.geteuid() == 0, "SKIPPED: packages are installed by root")
class FirstRun(cli.TestCase):
    def run_search(self, apt_status=0):
        bin_folder = self.folder / "bin"
        bin_folder.mkdir()
        for name, text in {"apt-get": APT, "ninja": NINJA, "cmake": "#!/bin/bash\n", "dpkg-query": "#!/bin/bash\n"}.items():
            (bin_folder / name).write_text(text)
            (bin_folder / name).chmod(0o755)
        shutil.copy(cli.ROOT / "run", self.folder / "run")
        environment = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}", "APT_STATUS": str(apt_status)}
        done = subprocess.run([self.folder / "run", "search", "--minutes", "1"], env=environment, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
        self.assertPlain(cli.Run(done.returncode, done.stdout, done.stderr))
        return done

    def test_every_stage_is_announced_and_the_installation_says_how_far_it_is(self):
        done = self.run_search()
        self.assertEqual((done.returncode, done.stdout), (0, "search --minutes 1\n"), done.stderr)
        says = [line.removeprefix("run: ") for line in done.stderr.splitlines()]
        self.assertRegex(says[0], r"^installing g\+\+ cmake .*minutes")
        self.assertEqual(says[1:8], ["downloading: 0 %", "downloading: 30 %", "downloading: 100 %", "installing: 0 %",
                                     "installing: 20 %", "installing: 55 %", "installing: 100 %"])
        self.assertRegex(says[8], "^configuring build/release$")
        self.assertRegex(says[9], "^building in build/release: minutes")
        self.assertNotIn("Unpacking", done.stderr)

    def test_an_installation_that_fails_shows_what_the_package_manager_said(self):
        done = self.run_search(apt_status=100)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("Unpacking g++", done.stderr)


if __name__ == "__main__":
    cli.main()
