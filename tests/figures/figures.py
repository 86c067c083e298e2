#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures in the text: commands make every number that somebody measured or counted.

  tests/figures/figures.py list
  tests/figures/figures.py refresh NAME ... [--problems N]     one or more
  tests/figures/figures.py refresh --cheap | --all             --all: for a release
  tests/figures/figures.py check                               what the tests do

registry.py says what there is. What is cheap (counts over policies, certificates accepted) is a block in a text:

  <!-- figures: NAME -->
  ...
  <!-- end of figures: NAME -->

check makes it again, and refuses it if a byte differs. What costs more is a file, reports/measured/NAME.md: a front
matter (command, commit, date, machine, versions of peers, digest of the text), what it is, and the numbers. They are
those of that commit, on that machine, and stay until somebody measures again. check refuses such a file if its text was
edited by hand, if its front matter is not complete, if registry.py does not know it, or if no text links to it.

Refused as well: a block that registry.py does not know, one that it knows and no text has, and a number outside of
blocks and measured files that looks measured (FIGURE below), unless registry.py lists its phrase as a definition.
Exit: 1 if anything is refused.
"""
import argparse
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from markdown import commands, front_matter, prose
from program import ROOT, Program
from registry import BLOCKS, DEFINITIONS, DOCUMENTS, MEASURED, MEASUREMENTS, Block

BLOCK = re.compile(r"<!-- figures: (?P<name>[\w-]+) -->\n(?P<text>.*?)\n?<!-- end of figures: (?P=name) -->", re.S)
UNIT = r"(?:%|s|ms|us|minutes?|hours?|MB|GB|in a million|million|times as)"
NOUN = "(?:problems|policies|readings|runs|loops|cycles|certificates|scenes|solved|rays|pieces|folds|descents|frames)"
FIGURE = re.compile(rf"\b\d{{1,3}}(?:,\d{{3}})+\b|\b\d+(?:\.\d+)? ?{UNIT}(?!\w)|\b\d[\d,]* {NOUN}\b|"
                    r"\b\d+ of \d[\d,]*\b")


# ---- Made ----------------------------------------------------------------------------------------------------


def made(figure, path, problems=None):
    """What the commands of a figure give now, and the commands."""
    with tempfile.TemporaryDirectory(prefix="stiction-figures-") as folder:
        program = Program(path, folder, problems)
        return figure.make(program), program.commands


def block(figure, path):
    text, typed = made(figure, path)
    return f"{text}\n\n{commands(typed)}" if typed else text


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def commit(path):
    """What the program was built of."""
    version = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
    return re.sub(r"^(\w{7})\w*", r"\1", version.split()[2].rstrip(","))


def are_peers_old(program):
    """Whether the program of the packages of others is older than a library that it is linked with, or is not there."""
    peers = program.with_name("stiction-peers")
    libraries = [path.stat().st_mtime for folder in ("bench", "certify", "corpus", "scene", "search", "solver")
                 for path in (program.parent / folder).glob("libstiction_*.a")]
    return not peers.exists() or any(peers.stat().st_mtime < built for built in libraries)


def machine():
    with open("/proc/cpuinfo") as file:
        models = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return f"{os.cpu_count()} cores, {models[0] if models else 'unknown'}, load {os.getloadavg()[0]:.1f} at its end"


def versions(packages):
    asked = ["dpkg-query", "-W", "-f", "${Package} ${Version}, ", *packages]
    return subprocess.run(asked, capture_output=True, text=True).stdout.rstrip(", ") or "none"


def measured_file(figure, text, facts):
    body = f"{prose(figure.what)}\n\n{text}\n"
    lines = [f"{key}: {value}" for key, value in (facts | {"digest": digest(body)}).items()]
    return "\n".join(["---", *lines, "---", "", body])


def measured(figure, path, problems=None):
    """The file of a measurement, made now."""
    text, typed = made(figure, path, problems)
    facts = {"command": "; ".join(typed), "commit": commit(path), "date": time.strftime("%Y-%m-%d"),
             "machine": machine()}
    return measured_file(figure, text, facts | ({"peers": versions(figure.peers)} if figure.peers else {}))


# ---- Check ---------------------------------------------------------------------------------------------------


def blocks_of(text):
    return {found["name"]: found["text"] for found in BLOCK.finditer(text)}


def refused_measurement(figure, content, texts):
    """Why the file of a measurement is refused, or nothing. texts: those that may link to it."""
    facts, body = front_matter(content)
    wanted = ["command", "commit", "date", "machine", *(["peers"] if figure.peers else []), "digest"]
    missing = [key for key in wanted if not facts.get(key)]
    if missing:
        return f"does not say its {', '.join(missing)}"
    if facts["digest"] != digest(body):
        return "was edited by hand"
    return "" if any(f"measured/{figure.name}.md" in text for text in texts) else "is linked from no text"


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


def refused_texts(texts, blocks, path):
    known = {(figure.file, figure.name) for figure in blocks}
    for name, content in texts.items():
        found = blocks_of(content)
        if len(found) != content.count("<!-- figures: "):
            yield f"{name}: a block is not closed, or stands twice"
        yield from (f"{name}: nothing makes the block {one}" for one in found if (name, one) not in known)
        yield from loose_figures(name, content)
    for figure in blocks:
        text = blocks_of(texts.get(figure.file, "")).get(figure.name)
        if text is None:
            yield f"{figure.file}: block {figure.name} is missing"
        elif text != block(figure, path):
            yield f"{figure.file}: block {figure.name} is not what its commands give now"


def refused_files(files, measurements, texts):
    known = {figure.file: figure for figure in measurements}
    for name, content in files.items():
        reason = refused_measurement(known[name], content, texts.values()) if name in known else "is made by nothing"
        if reason:
            yield f"{name}: {reason}"


def refusals(path):
    contents = {name: (ROOT / name).read_text() for name in DOCUMENTS}
    files = {name: contents.pop(name) for name in DOCUMENTS
             if name.startswith(f"{MEASURED}/") and not name.endswith("/README.md")}
    return [*refused_texts(contents, BLOCKS, path), *refused_files(files, MEASUREMENTS, contents)]


# ---- Commands ------------------------------------------------------------------------------------------------


def replaced(content, figure, text):
    """The content of a file with a new block; a file without the block has no place for it."""
    for found in BLOCK.finditer(content):
        if found["name"] == figure.name:
            return (content[:found.start()] + f"<!-- figures: {figure.name} -->\n{text}\n"
                    f"<!-- end of figures: {figure.name} -->" + content[found.end():])
    sys.exit(f"{figure.file}: has no block {figure.name}; put two lines where it shall stand:\n"
             f"<!-- figures: {figure.name} -->\n<!-- end of figures: {figure.name} -->")


def chosen(options):
    """Measurements first: a block lists them."""
    names = {figure.name: figure for figure in [*MEASUREMENTS, *BLOCKS]}
    unknown = [name for name in options.names if name not in names]
    if unknown:
        sys.exit(f"unknown: {' '.join(unknown)}; 'list' says what there is")
    if options.names:
        return [names[name] for name in options.names]
    return [figure for figure in names.values() if options.all or options.cheap and isinstance(figure, Block)]


def refresh(options):
    for figure in chosen(options):
        file = ROOT / figure.file
        if isinstance(figure, Block):
            file.write_text(replaced(file.read_text(), figure, block(figure, options.program)))
        elif "dirty" in commit(options.program):
            sys.exit(f"{figure.name}: {options.program} was built of no commit; commit, build")
        elif figure.peers and are_peers_old(Path(options.program)):
            sys.exit(f"{figure.name}: stiction-peers is not of these libraries; ./run bench --suite peers builds it")
        else:
            file.write_text(measured(figure, options.program, options.problems))
        print(f"{figure.file}: {figure.name}: written", flush=True)


def check(options):
    refused = refusals(options.program)
    print("\n".join(refused) or f"{len(BLOCKS)} blocks, {len(MEASUREMENTS)} measurements: nothing refused")
    if refused:
        print("tests/figures/figures.py refresh NAME makes a figure anew; its text says what is refused, and why.")
    sys.exit(1 if refused else 0)


def show_list(options):
    for figure in [*BLOCKS, *MEASUREMENTS]:
        print(f"{figure.name:24} {getattr(figure, 'cost', 'cheap'):8} {figure.file}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/stiction"))
    verbs = parser.add_subparsers(dest="verb", required=True)
    verb = verbs.add_parser("refresh")
    verb.add_argument("names", nargs="*", metavar="NAME")
    for flag in ("--cheap", "--all"):
        verb.add_argument(flag, action="store_true")
    verb.add_argument("--problems", type=int, help="instead of the number of problems that the registry names")
    verb.set_defaults(run=refresh)
    verbs.add_parser("check").set_defaults(run=check)
    verbs.add_parser("list").set_defaults(run=show_list)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
