# SPDX-License-Identifier: Apache-2.0
"""Runs the program for a figure, and remembers what was called, for the block says it."""

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Program:
    """Calls in the root of the checkout, so that files have the names that a reader would type. `folder`, for what the
    calls write, is FOLDER in the commands shown."""

    measured = {}  # calls of bench, which several figures share

    def __init__(self, path, folder, problems=None):
        self.path, self.folder = os.path.abspath(path), Path(folder)
        self.problems = problems  # instead of a figure's own number of problems
        self.commands = []  # as typed, in order, none twice

    def size(self, problems):
        return self.problems or problems

    def text(self, *words, codes=(0,), shown=True):
        words = [str(word) for word in words]
        if shown:
            self.show("./run " + self.typed(words))
        done = subprocess.run([self.path, *words], cwd=ROOT, text=True, capture_output=True, stdin=subprocess.DEVNULL)
        if done.returncode not in codes:
            sys.exit(f"{self.typed(words)}: exit {done.returncode}\n{done.stderr}")
        return done.stdout

    def json(self, *words, codes=(0,), shown=True):
        if shown:
            self.show("./run " + self.typed(words))
        return json.loads(self.text(*words, "--json", codes=codes, shown=False))

    def bench(self, *words):
        """The same suite with the same options is measured once in a process."""
        words = ("bench", "--suite", *map(str, words))
        self.show("./run " + self.typed(words))
        if words not in Program.measured:
            Program.measured[words] = self.json(*words, shown=False)
        return Program.measured[words]

    def study(self, name, *words):
        """What a study in Python prints, block by block; measured once in a process."""
        words = tuple(map(str, words))
        self.show("./run " + self.typed(("bench", "--suite", name, *words)))
        if (name, words) not in Program.measured:
            package = Path(self.path).parent / "python/package"
            done = subprocess.run([sys.executable, ROOT / f"bench/studies/{name.replace('-', '_')}.py", *words], cwd=ROOT,
                                  text=True, capture_output=True, env={**os.environ, "PYTHONPATH": str(package)})
            if done.returncode:
                sys.exit(f"{name}: exit {done.returncode}\n{done.stdout}{done.stderr}")
            Program.measured[name, words] = done.stdout.strip().split("\n\n")
        return Program.measured[name, words]

    def script(self, file, *words):
        """A script of this checkout, which takes the path of the program first."""
        self.show(f"{file} build/release/stiction " + self.typed(words))
        command = [sys.executable, ROOT / file, self.path, *map(str, words)]
        done = subprocess.run(command, cwd=ROOT, text=True, capture_output=True)
        if done.returncode:
            sys.exit(f"{file}: exit {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def typed(self, words):
        return shlex.join(str(word) for word in words).replace(f"{self.folder}/", "")

    def show(self, command):
        if command not in self.commands:
            self.commands.append(command)
