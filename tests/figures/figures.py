#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures in the text: every number that somebody measured or counted stands in a block that a command made.

  tests/figures/figures.py list
  tests/figures/figures.py refresh NAME ... [--problems N]     one block or more
  tests/figures/figures.py refresh --cheap | --stale | --all   --stale: what is refused or withdrawn
  tests/figures/figures.py withdraw NAME ...                   numbers that hold no more, until somebody measures again
  tests/figures/figures.py check                               what the tests do

A block stands between two comments; registry.py says in which file, what makes it, and what it costs:

  <!-- figures: NAME | cost: long | commit: 93d680f | sources: algorithm bench/space.cpp | digest: 1f0c9a2b.77d4 -->
  ...
  <!-- end of figures: NAME -->

What is refused. A *cheap* block (counts over policies, certificates accepted, small searches of a fixed seed): it is
made again and compared to the byte. Any other is not made again; its digest says what the code was and what the text
was, and it is refused if either is another now: a *stale* block, whose sources have changed, or a text edited by hand.
Counts of what searches find depend on `algorithm`, the version that search/algorithm_version.h names and recorded
traces guard, and on the few files that count; so work that leaves all runs as they are makes no count stale. Timings
depend on the same: a table of times is refused when the algorithm is another one or the benchmark measures otherwise,
and not for every commit that makes something faster; it carries its date, machine and commit. Comments and layout of
C++ sources are no part of a digest, nor is what tells on standard error how far a suite is (bench/progress.h).

A costly block that was withdrawn says so instead of its numbers; check counts it and refuses nothing.

Refused as well: a block that the registry does not know, one that it knows and no file has, and a number outside of
every block that looks measured (FIGURE below), unless registry.py lists its phrase as a definition. Exit: 1 if anything
is refused.
"""
import argparse
import hashlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from markdown import commands
from program import ROOT, Program
from registry import DEFINITIONS, DOCUMENTS, FIGURES

BLOCK = re.compile(r"<!-- figures: (?P<name>[\w-]+) \| (?P<facts>[^\n]*?) -->\n(?P<text>.*?)\n?"
                   r"<!-- end of figures: (?P=name) -->", re.S)
UNIT = r"(?:%|s|ms|us|minutes?|hours?|MB|GB|in a million|million|times as)"
NOUN = "(?:problems|policies|readings|runs|loops|cycles|certificates|scenes|solved|rays|pieces|folds|descents|frames)"
FIGURE = re.compile(rf"\b\d{{1,3}}(?:,\d{{3}})+\b|\b\d+(?:\.\d+)? ?{UNIT}(?!\w)|\b\d[\d,]* {NOUN}\b|"
                    r"\b\d+ of \d[\d,]*\b")
WITHDRAWN = "Not measured for this code yet: `tests/figures/figures.py refresh {}` does it."
UNSAID = re.compile(r'^\s*//.*$|^#include "bench/progress\.h"$|^\s*(?:progress::\w+\(|fmt::print\(stderr,)[^;]*\);$', re.M)
CODE = {".h", ".cpp", ".ipp", ".py"}


# ---- Sources -------------------------------------------------------------------------------------------------


def algorithm_version():
    """What a search finds depends on it."""
    return re.search(r"kAlgorithmVersion = (\d+);", (ROOT / "search/algorithm_version.h").read_text())[1]


def significant(file):
    """Without comments, layout and what tells how far a suite is, where that is safe to say: C++."""
    text = file.read_text()
    if file.suffix not in (".h", ".cpp", ".ipp"):
        return text
    return " ".join(UNSAID.sub("", text).split())


def files_of(source):
    path = ROOT / source
    if path.is_dir():
        return sorted(file for file in path.rglob("*") if file.suffix in CODE)
    return [path]


def code_digest(sources):
    digest = hashlib.sha256()
    for source in sources:
        parts = [algorithm_version()] if source == "algorithm" else map(significant, files_of(source))
        for part in (source, *parts):
            digest.update(part.encode() + b"\0")
    return digest.hexdigest()[:8]


def text_digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def commit(path):
    """What the program was built of."""
    version = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
    return re.sub(r"^(\w{7})\w*", r"\1", version.split()[2].rstrip(","))


def built_of_these_sources(figure, path):
    """Whether the program was built of a commit in which the sources of a costly figure are as they are now."""
    sources = ["search/algorithm_version.h" if source == "algorithm" else source for source in figure.sources]
    done = subprocess.run(["git", "-C", ROOT, "diff", "--quiet", commit(path), "--", *sources], capture_output=True)
    return done.returncode == 0


# ---- Blocks --------------------------------------------------------------------------------------------------


def blocks_of(text):
    """name -> (facts, text) of every block."""
    return {found["name"]: (dict(fact.split(": ", 1) for fact in found["facts"].split(" | ")), found["text"])
            for found in BLOCK.finditer(text)}


def facts_of(figure, text, path):
    """What the first line of a block says."""
    facts = {"cost": figure.cost, "commit": commit(path)}
    if figure.cost != "cheap":
        facts |= {"sources": " ".join(figure.sources), "digest": f"{code_digest(figure.sources)}.{text_digest(text)}"}
    return facts


def written(figure, text, path):
    """A block, comments and all."""
    facts = " | ".join(f"{key}: {value}" for key, value in facts_of(figure, text, path).items())
    return f"<!-- figures: {figure.name} | {facts} -->\n{text}\n<!-- end of figures: {figure.name} -->"


def replace(content, figure, text, path):
    """The content of a file with a new block; a file without the block has no place for it."""
    for found in BLOCK.finditer(content):
        if found["name"] == figure.name:
            return content[:found.start()] + written(figure, text, path) + content[found.end():]
    sys.exit(f"{figure.file}: has no block {figure.name}; put two lines where it shall stand:\n"
             f"<!-- figures: {figure.name} | cost: {figure.cost} -->\n<!-- end of figures: {figure.name} -->")


def made(figure, path, problems=None):
    """What the commands of a figure give now."""
    with tempfile.TemporaryDirectory(prefix="stiction-figures-") as folder:
        program = Program(path, folder, problems)
        text = figure.make(program)
        return f"{text}\n\n{commands(program.commands)}"


# ---- Check ---------------------------------------------------------------------------------------------------


def refused_block(figure, facts, text, path):
    """Why a block is refused, or nothing."""
    if facts.get("cost") != figure.cost:
        return f"says cost {facts.get('cost')}, the registry {figure.cost}"
    if figure.cost != "cheap" and text == WITHDRAWN.format(figure.name):
        return ""
    if "commit" not in facts:
        return "was not made yet"
    if figure.cost == "cheap":
        return "is not what its commands give now" if made(figure, path) != text else ""
    if facts.get("sources", "").split() != list(figure.sources):
        return "names other sources than the registry"
    code, _, content = facts.get("digest", "").partition(".")
    if content != text_digest(text):
        return "was edited by hand"
    return "is stale: its sources have changed" if code != code_digest(figure.sources) else ""


def outside(content):
    """The lines of prose outside of blocks, code and comments, numbered."""
    hidden = re.compile(r"<!--.*?-->|^```.*?^```|^ {4}.*?$|`[^`\n]*`", re.S | re.M)
    for pattern in (BLOCK, hidden):
        content = pattern.sub(lambda found: "\n" * found[0].count("\n"), content)
    return enumerate(content.split("\n"), 1)


def loose_figures(name, content):
    """Numbers that look measured and stand in no block."""
    for number, line in outside(content):
        for phrase in DEFINITIONS.get(name, ()):
            line = line.replace(phrase, "")
        for found in FIGURE.finditer(line):
            yield f"{name}:{number}: '{found[0]}' stands in no block"


def refusals(path, figures):
    contents = {name: (ROOT / name).read_text() for name in DOCUMENTS}
    known = {(figure.file, figure.name) for figure in figures}
    for name, content in contents.items():
        found = blocks_of(content)
        if len(found) != content.count("<!-- figures: "):
            yield f"{name}: a block is not closed, or stands twice"
        yield from (f"{name}: nothing makes the block {block}" for block in found if (name, block) not in known)
        yield from loose_figures(name, content)
    for figure in figures:
        block = blocks_of(contents.get(figure.file, "")).get(figure.name)
        reason = refused_block(figure, *block, path) if block else "is missing"
        if reason:
            yield f"{figure.file}: block {figure.name} {reason}"


# ---- Commands ------------------------------------------------------------------------------------------------


def is_withdrawn(figure):
    return WITHDRAWN.format(figure.name) in (ROOT / figure.file).read_text()


def is_stale(figure, path):
    """To be made again: refused or withdrawn."""
    block = blocks_of((ROOT / figure.file).read_text()).get(figure.name)
    return block is None or is_withdrawn(figure) or bool(refused_block(figure, *block, path))


def says_the_same(figure, block, text, path):
    """Whether a block has this text, and a first line that differs in the commit at most."""
    if block is None or block[1] != text or "commit" not in block[0]:
        return False
    return block[0] | {"commit": ""} == facts_of(figure, text, path) | {"commit": ""}


def chosen(options):
    names = {figure.name: figure for figure in FIGURES}
    unknown = [name for name in options.names if name not in names]
    if unknown:
        sys.exit(f"unknown: {' '.join(unknown)}; 'list' says what there is")
    if options.names:
        return [names[name] for name in options.names]
    return [figure for figure in FIGURES if options.all or options.cheap and figure.cost == "cheap"
            or options.stale and is_stale(figure, options.program)]


def refresh(options):
    for figure in chosen(options):
        if figure.cost != "cheap" and not built_of_these_sources(figure, options.program):
            sys.exit(f"{figure.name}: {options.program} was not built of a commit that has its sources; commit, build")
        text = made(figure, options.program, options.problems)
        file = ROOT / figure.file
        before = file.read_text()
        if says_the_same(figure, blocks_of(before).get(figure.name), text, options.program):
            print(f"{figure.file}: {figure.name}: as it was")
            continue
        file.write_text(replace(before, figure, text, options.program))
        print(f"{figure.file}: {figure.name}: written", flush=True)


def withdraw(options):
    for figure in chosen(options):
        if figure.cost == "cheap":
            sys.exit(f"{figure.name}: is cheap; refresh it")
        file = ROOT / figure.file
        text = WITHDRAWN.format(figure.name)
        file.write_text(replace(file.read_text(), figure, text, options.program))


def check(options):
    refused = list(refusals(options.program, FIGURES))
    withdrawn = sum(map(is_withdrawn, FIGURES))
    print("\n".join(refused) or f"{len(FIGURES)} blocks, {withdrawn} withdrawn: nothing refused")
    if refused:
        print("tests/figures/figures.py refresh NAME makes a block anew; its text says what is refused, and why.")
    sys.exit(1 if refused else 0)


def show_list(options):
    for figure in FIGURES:
        print(f"{figure.name:24} {figure.cost:8} {figure.file}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/stiction"))
    verbs = parser.add_subparsers(dest="verb", required=True)
    verb = verbs.add_parser("refresh")
    verb.add_argument("names", nargs="*", metavar="NAME")
    for flag in ("--cheap", "--stale", "--all"):
        verb.add_argument(flag, action="store_true")
    verb.add_argument("--problems", type=int, help="instead of the number of problems that the registry names")
    verb.set_defaults(run=refresh)
    verb = verbs.add_parser("withdraw")
    verb.add_argument("names", nargs="+", metavar="NAME")
    verb.set_defaults(run=withdraw)
    verbs.add_parser("check").set_defaults(run=check)
    verbs.add_parser("list").set_defaults(run=show_list)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
