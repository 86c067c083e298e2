# SPDX-License-Identifier: Apache-2.0
"""One version everywhere: CMakeLists.txt has it, and whatever else names it says the same."""

import re

import cli


def found(name, pattern):
    return re.search(pattern, (cli.ROOT / name).read_text(), re.M)[1]


class Version(cli.TestCase):
    def test_every_file_that_names_the_version_says_the_same(self):
        version = found("CMakeLists.txt", r"^project\(stiction VERSION ([\d.]+) ")
        said = {
            "the program": self.succeeds("--version").out.split()[1],
            "its manual": re.search(r'"stiction ([\d.]+)"', self.succeeds("manual").out)[1],
            "CITATION.cff": found("CITATION.cff", r"^version: (\S+)$"),
            "CHANGELOG.md": found("CHANGELOG.md", r"^## ([\d.]+)"),
            "the packages' changelog": found("cmake/debian/changelog", r"^stiction \(([\d.]+)-\d+\)"),
        }
        self.assertEqual(said, dict.fromkeys(said, version))
        # A library of 0.x fits those that ask for the same minor version.
        asked = found("tests/install/consumer/CMakeLists.txt", r"find_package\(stiction ([\d.]+) REQUIRED\)")
        self.assertEqual(asked, version.rpartition(".")[0])

    def test_nothing_else_writes_it_down(self):
        for name, pattern in (("python/build_backend.py", r"^VERSION = (re\.search)"),
                              ("python/CMakeLists.txt", r'STICTION_VERSION="\$\{(PROJECT_VERSION)\}"'),
                              ("cmake/debian/stiction-ipopt.1.in", r"stiction @(PROJECT_VERSION)@")):
            with self.subTest(name):
                self.assertTrue(found(name, pattern))


if __name__ == "__main__":
    cli.main()
