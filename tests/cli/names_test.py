# SPDX-License-Identifier: Apache-2.0
"""No two types of one name: two classes of a program that share their name take each other's functions, and no
compiler says so."""

import collections
import re

import cli

TYPE = re.compile(r"^(?:class|struct|enum class|enum|union) (\w+)(?: final)?(?: ?:[^:].*)? ?\{", re.M)


class Names(cli.TestCase):
    def test_every_type_of_the_namespace_is_defined_once(self):
        places = collections.defaultdict(set)
        for folder in ("solver", "scene", "corpus", "certify", "search", "reports", "cli", "python", "bench"):
            for suffix in ("h", "ipp", "cpp"):
                for file in (cli.ROOT / folder).rglob(f"*.{suffix}"):
                    text = re.sub(r"^namespace \{$.*?^\}  // namespace$", "", file.read_text(), flags=re.M | re.S)
                    for name in TYPE.findall(text):
                        places[name].add(file.relative_to(cli.ROOT).as_posix())
        self.assertGreater(len(places), 100)
        twice = {name: sorted(files) for name, files in places.items() if len(files) > 1}
        self.assertEqual(twice, {})


if __name__ == "__main__":
    cli.main()
