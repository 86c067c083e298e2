# SPDX-License-Identifier: Apache-2.0
"""Every C++ source is as clang-format leaves it, of Debian 12: other versions break other lines."""

import shutil
import subprocess

import cli

FORMAT = shutil.which("clang-format-14") or shutil.which("clang-format")


def version():
    return subprocess.run([FORMAT, "--version"], capture_output=True, text=True).stdout if FORMAT else ""


class Style(cli.TestCase):
    def test_sources_are_formatted(self):
        if " 14." not in version():
            print("SKIPPED: found no clang-format 14")
            self.skipTest("no clang-format 14")
        listed = subprocess.run(["git", "ls-files", "*.h", "*.ipp", "*.cpp"], cwd=cli.ROOT, capture_output=True, text=True)
        files = listed.stdout.split() if listed.returncode == 0 else []
        self.assertGreater(len(files), 300, "found no sources: no clone of the repository")
        done = subprocess.run([FORMAT, "--dry-run", "-Werror", *files], cwd=cli.ROOT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"clang-format -i of these:\n{done.stderr}")


if __name__ == "__main__":
    cli.main()
