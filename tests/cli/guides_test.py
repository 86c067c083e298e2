# SPDX-License-Identifier: Apache-2.0
"""cli/tour.md, cli/how-to, and the runs that corpus/README.md names: every command is run, in a folder of its own, and
says what the page quotes; every file that is linked is there.

Lines with four spaces in front are commands; where some begin with `$ `, the others are what is printed, `...` standing
for anything, ends of lines for spaces. A fenced block whose first line names a file is written under that name. What
takes a night or a cluster is run small (SMALL).
"""

import itertools
import os
import re
import subprocess
from pathlib import Path

import cli

GUIDES = cli.ROOT / "cli"
HOW_TO = ("proof", "engine", "night", "paper")
MOST_LINES = 80
FOLDERS = ("bench", "certify", "corpus", "python", "search", "solver", "tests")
SMALL = (  # what a page says, and what is run in its place
    ("--problems 100000 ", "--problems 100000 --finishing 100 "),  # all findings, however slow the machine
    ("--minutes 480", "--problems 4000 --finishing 0"),
    ("--minutes 60", "--problems 4000 --finishing 0"),
    ("--problems 10000000", "--problems 20000"),
    ("--problems 1000000", "--problems 200"),
    ("--shards 200", "--shards 2"),
    ("seq 0 199 | parallel", "printf '0\\n1\\n' | xargs -n 1"),
    (" --watch", ""),
)
COQ = cli.ROOT / "build/coq"  # what `./run prove` has compiled, which `coqc` needs: elsewhere it is not called
EXITS = {  # of commands that shall not end with 0
    "./run solve corpus/sliding/rod-without-solution.json": 1,
    "./run solve corpus/space/ray-under-slip-literal.json --method baraff": 1,
    "./run replay corpus/scenes/block-in-a-valley.json --svg block-loop.svg": 1,
}
FENCE = re.compile(r"```\w+(?: ([\w.-]+))?$")
LINK = re.compile(r"\]\(([^)#:]+)(?:#([\w-]+))?\)")
NAMED = re.compile(r"`((?:cli|certify|corpus|search|solver|reports|tests|bench|python)/[\w/.-]+\.\w+)`")


def blocks(text):
    """Fenced blocks that name a file, as (name, lines), and indented ones, without a name."""
    lines = iter(text.splitlines())
    indented = []
    for line in lines:
        if line.startswith("    ") or indented and not line:
            indented.append(line[4:])
            continue
        if indented:
            yield None, indented
            indented = []
        if fence := FENCE.match(line):
            inside = list(itertools.takewhile(lambda one: one != "```", lines))
            if fence[1]:
                yield fence[1], inside
    if indented:
        yield None, indented


def steps(text):
    """What a page has typed: (file to write, its text, None), or ("", command, what is quoted of its output or None)."""
    for name, lines in blocks(text):
        if name:
            yield name, "\n".join(lines) + "\n", None
        elif any(line.startswith("$ ") for line in lines):
            for part in "\n".join(lines).removeprefix("$ ").split("\n$ "):
                command, _, quoted = part.partition("\n")
                yield "", command, quoted
        else:
            yield from (("", line.split("   #")[0].strip(), None) for line in lines if line)


def smaller(command):
    for said, run in SMALL:
        command = command.replace(said, run)
    return command


def tells(printed, quoted):
    """Whether the parts of a quotation between its dots stand one after the other, from beginning to end."""
    parts = [cli.unwrapped(part) for part in quoted.split("...")]
    text = cli.unwrapped(printed)
    if not text.startswith(parts[0]) or not text.endswith(parts[-1]):
        return f"expected it to begin with {parts[0]!r} and to end with {parts[-1]!r}"
    place = 0
    for part in parts:
        found = text.find(part, place)
        if found < 0:
            return f"expected, in this place, {part!r}"
        place = found + len(part)
    return ""


class Guides(cli.TestCase):
    def setUp(self):
        super().setUp()
        for name in FOLDERS:
            (self.folder / name).symlink_to(cli.ROOT / name)
        self.script("run", f'exec "{cli.program}" "$@"')
        # Hands the tasks of an array to nobody, as a cluster that is full.
        self.script("tools/sbatch", "echo 7")
        self.environment = {**os.environ, "PATH": f"{self.folder / 'tools'}:{os.environ['PATH']}",
                            "PYTHONDONTWRITEBYTECODE": "1"}
        compiled = self.folder / "build/coq"
        compiled.mkdir(parents=True)
        for part in COQ.iterdir() if COQ.is_dir() else ():
            (compiled / part.name).symlink_to(part)

    def script(self, name, body):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"#!/bin/bash\n{body}\n")
        file.chmod(0o755)

    def follow(self, page, text):
        """Types a page. Returns how many commands were run, and how many were quoted."""
        ran = quotations = 0
        for file, what, quoted in steps(text):
            if file:
                (self.folder / file).write_text(what)
                continue
            if what == "./run prove" or what.startswith("coqc ") and not (COQ / "claims/Claims.vo").is_file():
                continue
            with self.subTest(page=page, command=what):
                done = subprocess.run(["bash", "-c", smaller(what)], cwd=self.folder, env=self.environment, text=True,
                                      capture_output=True, stdin=subprocess.DEVNULL, timeout=600)
                self.assertEqual(done.returncode, EXITS.get(what, 0), done.stdout + done.stderr)
                if quoted is not None:
                    self.assertEqual(tells(done.stdout, quoted), "", done.stdout)
                    quotations += 1
                ran += 1
        return ran, quotations

    def test_the_tour_prints_what_it_quotes(self):
        self.assertEqual(self.follow("tour", (GUIDES / "tour.md").read_text()), (8, 8))

    def test_the_tour_says_where_to_go_next(self):
        links = LINK.findall((GUIDES / "tour.md").read_text())
        self.assertLessEqual({f"how-to/{name}.md" for name in HOW_TO}, {path for path, _ in links})

    def test_every_command_of_a_how_to_runs(self):
        self.assertEqual({file.stem for file in (GUIDES / "how-to").iterdir()}, set(HOW_TO))
        for name in HOW_TO:
            with self.subTest(page=name):
                text = (GUIDES / f"how-to/{name}.md").read_text()
                self.assertGreater(self.follow(name, text)[0], 7)

    def test_runs_to_look_at_in_the_corpus(self):
        text = (cli.ROOT / "corpus/README.md").read_text().split("Runs to look at:")[1]
        self.assertGreater(self.follow("corpus", text)[0], 10)

    def test_a_how_to_is_one_page(self):
        for name in HOW_TO:
            self.assertLessEqual(len((GUIDES / f"how-to/{name}.md").read_text().splitlines()), MOST_LINES, name)

    def test_files_that_are_named_are_there(self):
        for page in (GUIDES / "tour.md", *(GUIDES / f"how-to/{name}.md" for name in HOW_TO)):
            text = page.read_text()
            self.assertTrue(LINK.findall(text), page)
            for path, anchor in LINK.findall(text):
                with self.subTest(page=page.name, link=path):
                    file = Path(os.path.normpath(page.parent / path))
                    self.assertTrue(file.exists())
                    if anchor:
                        heads = [re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-")
                                 for head in re.findall(r"(?m)^#+ (.+)$", file.read_text())]
                        self.assertIn(anchor, [*heads, *re.findall(r'<a id="([\w-]+)"', file.read_text())])
            for path in NAMED.findall(text.replace("corpus/NAME.json", "")):
                self.assertTrue((cli.ROOT / path).is_file(), f"{page.name}: {path}")

    def test_a_quotation_that_differs_is_noticed(self):
        printed = "one store\n  two loops\n  three\n"
        for quoted in ("one store\n two\nloops\n three", "one store ... three", "... two ... three", "one ..."):
            self.assertEqual(tells(printed, quoted), "", quoted)
        for quoted in ("one store", "two ...", "one ... two", "... three ... two loops ...", "one store two three"):
            self.assertNotEqual(tells(printed, quoted), "", quoted)


if __name__ == "__main__":
    cli.main()
