# SPDX-License-Identifier: Apache-2.0
"""A count of things and their noun come from one function, which knows the singular: no text says "1 groups"."""

import re

import cli

NOUNS = ("contacts groups problems policies units runs steps drives rows findings stores programs candidates solutions "
         "prefixes words files threads bodies loops certificates bits choices nonzeros points frames signatures").split()
COUNTED = re.compile(rf"((?:[\w']+ )?)\{{\d?\}} ((?!of )(?:[a-z]+ )?(?:{'|'.join(NOUNS)}))\b")
# Bounds, which are more than one, and what is never one.
BOUNDS = ("most ", "than ", "all ", "none ")
NEVER_ONE = {
    ("cli/scene.cpp", "independent problems"),  # "expected one"
    ("cli/methods.cpp", "policies"), ("cli/replay.cpp", "policies"),  # the grid
    ("cli/narration/explained.cpp", "choices"), ("cli/narration/followed.cpp", "steps"), ("cli/replay.cpp", "rows"),
    ("cli/replay.cpp", "steps"), ("cli/live/live.cpp", "rows"), ("cli/slurm.cpp", "problems"), ("cli/certify.cpp", "solutions"),
    ("reports/page/page_facts.cpp", "units"), ("reports/told/facts.cpp", "contacts"), ("reports/comparison/solvers.cpp", "rows"),
    ("reports/page/rungs.cpp", "problems"),
}


class Plurals(cli.TestCase):
    def test_no_text_puts_a_count_before_a_plural_by_itself(self):
        seen, wrong = 0, []
        for folder in ("cli", "reports", "search"):
            for path in sorted((cli.ROOT / folder).rglob("*.cpp")):
                name = path.relative_to(cli.ROOT).as_posix()
                if name.startswith(("search/under_test/", "search/adversary/", "search/units/", "search/testimony", "reports/web/")):
                    continue
                text = path.read_text()
                seen += text.count("Counted(")
                for number, line in enumerate(text.splitlines(), 1):
                    for before, noun in COUNTED.findall(line.partition("//")[0]):
                        if before not in BOUNDS and (name, noun) not in NEVER_ONE:
                            wrong.append(f"{name}:{number}: '{before}{{}} {noun}', expected Counted of corpus/grouped.h")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 30)


if __name__ == "__main__":
    cli.main()
