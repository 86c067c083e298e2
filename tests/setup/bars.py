#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How simple the sources are, as numbers: what each is, and the bar that it must not pass.

    bars.py [BUILD]    BUILD (build/release) is asked for the processor time of its compilations

Lines are those of files, blank ones and comments among them. Types are what stands behind struct, class, enum
and union.
The product is what a user runs: tests, and the peers that bench measures, are not in it. A recipe of CONTRIBUTING.md
names a commit that follows it. Where something cannot be known, as in a clone without
history or a build that noted nothing, it is "unknown". Exit 1 if a bar is passed."""

import csv
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PRODUCT = ("bench", "certify", "cli", "corpus", "python", "reports", "scene", "search", "solver")
CODE = (".h", ".ipp", ".cpp", ".py", ".pyi", ".js", ".mjs")
RECIPES = {"method": 4, "generator": 3, "claim": 4, "verb": 3, "field": 2}  # files that its commit touches, at most
SEARCH = ("stiction-search", "stiction-ipopt")  # what ./run search builds
JSON_HEADERS = ("nlohmann/json.hpp",)
PROOFS = ("certify/condition_number.md", "certify/coq/README.md", "certify/existence.md", "certify/related_work.md",
          "certify/where_loops_begin.md", "search/adversary/frontiers.md", "solver/complete/complete_driving.md",
          "solver/complete/equivalence.md", "solver/published/mending.md", "solver/published/readings.md")


def tracked(*patterns):
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return listed.splitlines()


def is_measured(name):
    """A table that a command made."""
    return name.startswith("reports/measured/") and not name.endswith("README.md")


def files():
    """Of the product, as Git has them."""
    for name in tracked(*PRODUCT):
        if name.endswith(CODE) and not name.startswith("bench/peers/") and "/dist/" not in name:
            yield name


def text(name):
    return (ROOT / name).read_text()


def includes(names):
    """Of every C++ file: which of these it includes, and which headers of other libraries."""
    own, foreign = {}, {}
    for name in names:
        found = re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', text(name), re.M)
        own[name] = [one for one in found if one in names]
        foreign[name] = [one for one in found if one not in names]
    return own, foreign


def reached(name, own):
    seen, left = {name}, [name]
    while left:
        for other in own[left.pop()]:
            if other not in seen:
                seen.add(other)
                left.append(other)
    return seen


def depth(name, own, known):
    if name not in known:
        known[name] = 0  # a circle ends here; structure_test.py refuses it
        known[name] = 1 + max((depth(other, own, known) for other in own[name]), default=0)
    return known[name]


def build_seconds(build, *targets):
    """Of what these are linked from; None where nothing was noted."""
    noted = build / "compile_times.csv"
    listed = subprocess.run(["ninja", "-C", build, "-t", "inputs", *targets], capture_output=True, text=True)
    if listed.returncode or not noted.exists():
        return None
    with open(noted) as file:
        seconds = {name: float(value) for name, value in csv.reader(file)}
    used = [name for name in listed.stdout.split() if name.endswith((".o", ".gch"))]
    return round(sum(seconds[name] for name in used)) if all(name in seconds for name in used) else None


def recipe_files(recipe):
    """How many files the commit of the recipe touches that CONTRIBUTING.md names; None where Git does not have it."""
    commit = re.search(rf"^\*\*A {recipe}\b[^*]*\*\* \(([0-9a-f]+)\)", text("CONTRIBUTING.md"), re.M)[1]
    show = ["git", "show", "--format=", "--name-only", "--no-renames", commit, "--"]
    listed = subprocess.run(show, cwd=ROOT, capture_output=True, text=True)
    return None if listed.returncode else len(listed.stdout.split())


def survivors():
    """Per cent of the last drawn mutants that no test noticed; None where none were drawn."""
    name = "reports/measured/mutants.md"
    found = (ROOT / name).exists() and re.search(r"^drawn, seed \d+: (\d+) of (\d+) noticed", text(name), re.M)
    return round(100 - 100 * int(found[1]) / int(found[2]), 1) if found else None


def measures(build):
    """(what, how much or None, the most that it may be)"""
    names = list(files())
    lines = sum(len(text(name).splitlines()) for name in names)
    cpp = {name for name in names if name.endswith((".h", ".ipp", ".cpp"))}
    types = sum(len(re.findall(r"^\s*(?:template <[^;{]*>\s*)?(?:struct|class|enum|enum class|union) (?!class)\w+[^;(]*\{", text(name), re.M))
                for name in cpp)
    answers = sum(len(re.findall(r"^\s*(?:struct|class) \w*(?:Run|Verdict|Answer|Solution)\b[^;]*\{", text(name), re.M))
                  for name in cpp)
    tallies = sum(len(re.findall(r"^\s*for \(.*\btallies\)", text(name), re.M)) for name in cpp
                  if not name.startswith(("reports/tables/", "corpus/record/")))
    own, foreign = includes(cpp)
    sources = [name for name in cpp if name.endswith(".cpp")]
    reads_json = sum(any(header in JSON_HEADERS for one in reached(name, own) for header in foreign[one]) for name in sources)
    known = {}
    words = {name: len(text(name).split()) for name in tracked("*.md") if name not in PROOFS and not is_measured(name)}
    yield "lines of the product, peers apart", lines, 59_000
    code = sum(sum(bool(line.strip()) and not line.strip().startswith(("//", "#!", "/*")) for line in text(name).splitlines())
               for name in cpp)
    yield "types per 1,000 lines of C++ that are code", round(1000 * types / code, 1), 10
    yield "structs named Run, Verdict, Answer, Solution", answers, 6
    yield "loops over tallies outside of tables and records", tallies, 0
    yield "depth of includes", max(depth(name, own, known) for name in cpp), 8
    yield f"sources that read the whole JSON library, of {len(sources)}", reads_json, 80
    yield "longest page of a folder, in lines", max(len(text(name).splitlines()) for name in tracked("*README.md")), 120
    yield "words of the texts, proofs and measured tables apart", sum(words.values()), 45_000
    yield "processor seconds of the program's compilations", build_seconds(build, "stiction"), 500
    yield "processor seconds of what ./run search compiles", build_seconds(build, *SEARCH), 370
    yield "megabytes of examples", round(sum((ROOT / name).stat().st_size for name in tracked("reports/examples")) / 1e6, 1), 8
    for recipe, most in RECIPES.items():
        yield f"files of the recipe for a {recipe}", recipe_files(recipe), most
    yield "drawn mutants that no test notices, per cent", survivors(), 10


def main():
    bars = passed = 0
    for what, found, most in measures(Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release")):
        over = found is not None and found > most
        bars, passed = bars + 1, passed + over
        shown = "unknown" if found is None else f"{found:,}"
        print(f"{what:60} {shown:>10} {'bar' if found is None else 'over' if over else 'within':>7} {most:,}")
    print(f"over {passed} of {bars} bars")
    return passed > 0


if __name__ == "__main__":
    sys.exit(main())
