#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the program says today of everything that it is sure to say again: before and after a change of its insides.

    golden.py [PROGRAM]            says each case that differs from tests/golden/recorded; exit 1 if one does;
                                   a case that is not recorded is new, and differs from nothing
    golden.py [PROGRAM] --show N   the first N of them, as they were and as they are (5 unless told)
    golden.py [PROGRAM] --accept "REASON"    records what is said now; CHANGES.md gets the cases and the reason
    golden.py [PROGRAM] --only GROUP...      of these groups

PROGRAM is build/release/stiction unless it is named. Every case is a command with what it printed and its exit code; its
times, builds and versions are left out. Groups:

    solve       every problem of the corpus, by every method in every arithmetic
    replay      the same by every path method, step by step; all policies in the plane
    certify     a certificate of every claim, or why there is none
    check       the false and true certificates of tests/certify/false_claims_test.py, by all checkers
    search      three small stores: all tables but the times, the report's numbers, its text
    formats     small problems of the corpus in every format of others, and read from there again
    scenes      every scene for a few steps: where it is at the end
    verbs       --json, help and refusals of the other verbs

Standard library only. Some minutes on two cores; nothing is written outside of a scratch folder but by --accept.
"""

import argparse
import concurrent.futures
import csv
import gzip
import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RECORDED, CHANGES = HERE / "recorded", HERE / "CHANGES.md"
SECONDS = 600  # of one call
ENVIRONMENT = {"PATH": os.environ["PATH"], "COLUMNS": "100", "LC_ALL": "C.UTF-8", "PYTHONDONTWRITEBYTECODE": "1",
               **{name: value for name, value in os.environ.items() if name in ("STICTION_MUTANT", "STICTION_REACHED")}}
# Keys of answers that are another at every run or in every build.
PASSING = {"seconds", "processor_seconds", "version", "build", "builds", "commit", "machine", "store_bytes"}


def problems(*folders):
    for folder in folders:
        for file in sorted((ROOT / "corpus" / folder).glob("*.json")):
            yield file, json.loads(file.read_text())


PLANAR = ("", "sliding", "endless")
SPATIAL = ("space", "space/critical")
MOST_ROWS = 40  # of a problem that every method is asked of


def without_passing(value):
    if isinstance(value, dict):
        return {key: without_passing(item) for key, item in value.items() if key not in PASSING}
    return [without_passing(item) for item in value] if isinstance(value, list) else value


class Program:
    def __init__(self, path, scratch):
        self.path, self.scratch = str(path), str(scratch)

    def said(self, *words):
        """What a call printed and its exit code, without paths and what passes."""
        done = subprocess.run([self.path, *map(str, words)], cwd=ROOT, env=ENVIRONMENT, capture_output=True, timeout=SECONDS,
                              stdin=subprocess.DEVNULL)
        out = done.stdout.decode(errors="replace")
        if "--json" in words and out.strip():
            out = json.dumps(without_passing(json.loads(out)), separators=(",", ":"))
        error = done.stderr.decode(errors="replace")
        return self.plain(f"exit {done.returncode}\n{out.strip()}\n{error.strip()}".strip())

    def plain(self, text):
        return text.replace(self.scratch + "/", "").replace(str(ROOT) + "/", "").replace(self.path, "stiction")


def name_of(file):
    return file.relative_to(ROOT / "corpus").with_suffix("").as_posix()


# --- Groups: each yields (name, command words) or (name, function) --------------------------------------------------

def methods_of(program):
    done = subprocess.run([program.path, "methods", "--json"], capture_output=True, check=True)
    return json.loads(done.stdout)


def solve(program, scratch):
    built = methods_of(program)
    for folders, dimension in ((PLANAR, "plane"), (SPATIAL, "space")):
        for file, problem in problems(*folders):
            if len(problem.get("b", [])) > MOST_ROWS:
                continue
            yield f"{name_of(file)} auto", ("solve", file, "--json")
            for method in built:
                for arithmetic in method[dimension]:
                    words = ("--method", method["name"], "--arithmetic", arithmetic, "--max-drives", 300, "--json")
                    yield f"{name_of(file)} {method['name']} {arithmetic}", ("solve", file, *words)


def replay(program, scratch):
    for folders in (PLANAR, SPATIAL):
        for file, problem in problems(*folders):
            if len(problem.get("b", [])) > MOST_ROWS:
                continue
            for method in ("baraff", "complete", "lemke"):
                for arithmetic in ("exact", "double") if folders is PLANAR else ("double",):
                    words = ("--method", method, "--arithmetic", arithmetic, "--max-drives", 60, "--json")
                    yield f"{name_of(file)} {method} {arithmetic}", ("replay", file, *words)
            if folders is PLANAR:
                yield f"{name_of(file)} all", ("replay", file, "--all-policies", "--max-drives", 300, "--json")


CLAIMS = ("existence", "solution-exists", "symmetric", "psd", "definite", "in-range", "h", "exists", "safe",
          "safe-by-condition", "cycle")


def certify(program, scratch):
    for file, problem in problems(*PLANAR, *SPATIAL):
        if len(problem.get("b", [])) <= MOST_ROWS:
            for claim in CLAIMS:
                yield f"{name_of(file)} {claim}", ("certify", file, "--claim", claim, "-o", "-")


def check(program, scratch):
    folder = Path(scratch, "false")
    subprocess.run([sys.executable, ROOT / "tests/certify/false_claims_test.py", "--write", folder], check=True)
    files = sorted(folder.glob("*.json"))
    for name, command in (("program", [program.path, "check"]),
                          ("check_certificate.py", [sys.executable, ROOT / "certify/check_certificate.py"]),
                          ("check_runs.py", [sys.executable, ROOT / "certify/check_runs.py"])):
        def judged(command=command):
            done = subprocess.run([*map(str, command), *files], capture_output=True, text=True, env=ENVIRONMENT)
            return program.plain(done.stdout + done.stderr)
        yield name, judged


STORES = {
    "plane": ("--generator", "psd", "small", "conditioned", "integers", "--contacts", 1, 2, 3, 4, "--problems", 60000),
    "space": ("--generator", "space", "psd", "--contacts", 2, 3, "--problems", 4000),
    "sliding": ("--generator", "sliding", "duplicates", "near-degenerate", "--contacts", 2, 3, "--mu", "1/2",
                "--problems", 20000),
}


def tables_of(store):
    with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as db:
        names = [row[0] for row in db.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]
        return "\n".join(f"{name} {json.dumps([str(x) for x in row])}" for name in names if name != "work"
                         for row in sorted(db.execute(f"SELECT * FROM {name}"), key=str))


def search(program, scratch):
    for name, words in STORES.items():
        def made(name=name, words=words):
            store, report = Path(scratch, f"{name}.store"), Path(scratch, f"{name}-report")
            said = program.said("search", *words, "--seed", 7, "--finishing", 100, "--threads", 1, "--store", store)
            if not said.startswith(("exit 0", "exit 4")):
                return said
            parts = [tables_of(store), program.said("report", store, "--text", "--all")]
            program.said("report", store, "-o", report)
            for file in sorted(report.glob("*.csv")):
                if file.name != "work.csv":
                    with open(file, newline="") as rows:
                        parts.append(f"{file.name}\n" + "\n".join(map(str, csv.reader(rows))))
            return re.sub(r"\d{4}-\d\d-\d\d[ T][\d:]+Z?", "DATE", program.plain("\n\n".join(parts)))
        yield name, made


STORAGES = {"siconos-lcp": ("dense", "blocks", "columns", "triplet"), "siconos-fc": ("dense", "blocks", "columns", "triplet"),
            "fclib": ("columns", "rows", "triplet")}
FEW_ROWS = 6  # of a problem that is written in every format


def formats(program, scratch):
    for file, problem in problems(*PLANAR, *SPATIAL):
        if len(problem.get("b", [])) > FEW_ROWS:
            continue
        for to, storage in ((to, storage) for to, storages in STORAGES.items() for storage in storages):
            def written(file=file, to=to, storage=storage):
                out = Path(scratch, f"{name_of(file)}-{to}.{storage}".replace("/", "-") + (".hdf5" if to == "fclib" else ".dat"))
                said = program.said("export", file, "--format", to, "--storage", storage, "--round", "-o", out)
                if not out.exists():
                    return said
                text = "" if to == "fclib" else out.read_text()
                again = program.said("import", out, "-o", "-")
                out.unlink()
                return f"{said}\n{text}\n{again}"
            yield f"{name_of(file)} {to} {storage}", written


STEPS, LAST = 60, 4  # of a scene; and lines of each table that are recorded


def scenes(program, scratch):
    for file in sorted((ROOT / "corpus/scenes").glob("*.json")) + sorted((ROOT / "corpus/scenes/space").glob("*.json")):
        def stepped(file=file):
            out, step = Path(scratch, name_of(file).replace("/", "-")), Fraction(str(json.loads(file.read_text()).get("step", "1/100")))
            said = program.said("simulate", file, "--seconds", float(STEPS * step), "--frames", 1, "--no-svg", "-t", 1, "-o", out)
            tables = sorted(out.glob("*.csv"))
            lines = [line for table in tables for line in (table.name, *table.read_text().splitlines()[-LAST:])]
            shutil.rmtree(out, ignore_errors=True)
            return "\n".join((said, *lines))
        yield name_of(file), stepped


REFUSED = [("solve", "none.json"), ("solve",), ("replay", "corpus/two-contact-cycle.json", "--policy", "ties=none"),
           ("certify", "corpus/two-contact-cycle.json", "--claim", "nothing", "-o", "-"), ("serch",),
           ("solve", "corpus/two-contact-cycle.json", "--method", "guess"), ("bench", "--suite", "none"),
           ("solve", "corpus/two-contact-cycle.json", "--arithmetic", "decimal"), ("check", "README.md"),
           ("search", "--contacts", "0"), ("report", "none.store", "-o", "x"), ("simulate", "none.json", "-o", "x")]


def verbs(program, scratch):
    for words in (("methods", "--json"), ("policies", "--json"), ("words", "--json"), ("records", "--json"),
                  *REFUSED):
        yield " ".join(words), words
    done = subprocess.run([program.path, "manual", "--json"], capture_output=True, check=True)
    for verb in json.loads(done.stdout):
        yield f"manual {verb['verb']}", lambda verb=verb: json.dumps(verb, separators=(",", ":"))
        yield f"help {verb['verb']}", ("help", verb["verb"])
    for file, problem in problems("", *SPATIAL):
        if len(problem.get("b", [])) <= 12:
            yield f"survey {name_of(file)}", ("survey", file, "--json")
            yield f"solve {name_of(file)}", ("solve", file)
            yield f"replay {name_of(file)}", ("replay", file, "--max-drives", 30)
    for scene in sorted((ROOT / "corpus/scenes").glob("*.json"))[::4]:
        yield f"assemble {scene.stem}", ("assemble", scene, "-o", "-")


GROUPS = {"solve": solve, "replay": replay, "certify": certify, "check": check, "search": search,
          "formats": formats, "scenes": scenes, "verbs": verbs}


# --- Recording and comparing -----------------------------------------------------------------------------------------

def say(program, group, scratch):
    """Every case of a group and what was said."""
    cases = list(GROUPS[group](program, scratch))
    assert len({name for name, _ in cases}) == len(cases), f"two cases of {group} have one name"

    def one(case):
        name, what = case
        try:
            said = what() if callable(what) else program.said(*what)
            return name, re.sub(r"build: [^\n]*", "build: ...", said)
        except subprocess.TimeoutExpired:
            return name, f"no end in {SECONDS} s"
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(pool.map(one, cases))


def recorded_file(group):
    return RECORDED / f"{group}.json.gz"


def read(group):
    file = recorded_file(group)
    said = json.loads(gzip.decompress(file.read_bytes())) if file.exists() else {}
    return {name: re.sub(r"build: [^\n]*", "build: ...", text) for name, text in said.items()}


def write(group, said):
    RECORDED.mkdir(exist_ok=True)
    text = "{\n" + ",\n".join(f"{json.dumps(name)}: {json.dumps(said[name])}" for name in sorted(said)) + "\n}\n"
    recorded_file(group).write_bytes(gzip.compress(text.encode(), 9, mtime=0))


def differing(before, now):
    """A case that is new says nothing otherwise than before; --accept records it with the others."""
    return [name for name in sorted(before) if before[name] != now.get(name)]


def shown(name, before, now):
    """Both, from a little before the first letter in which they differ."""
    at = next((i for i, (x, y) in enumerate(zip(before, now)) if x != y), min(len(before), len(now)))
    start = max(0, at - 100)
    return f"{name}\n  was: ...{before[start:at + 200]!r}\n  is:  ...{now[start:at + 200]!r}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build/release/stiction", type=Path)
    parser.add_argument("--show", type=int, default=5)
    parser.add_argument("--accept", metavar="REASON")
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=list(GROUPS))
    options = parser.parse_args()
    program_path = options.program.resolve()
    if not os.access(program_path, os.X_OK):
        sys.exit(f"golden.py: {options.program}: expected the program, which ./run builds")
    found, start = {}, time.monotonic()
    scratch = tempfile.mkdtemp(prefix="stiction-golden-")
    try:
        program = Program(program_path, scratch)
        for group in options.only:
            before, now = read(group), say(program, group, scratch)
            found[group] = names = differing(before, now)
            new = now.keys() - before.keys()
            print(f"{group}: {len(now)} cases, {len(names)} differ, {len(new)} are new")
            for name in names[:options.show]:
                print(shown(f"{group}: {name}", before.get(name, ""), now.get(name, "")))
            if options.accept and (names or new):
                write(group, now)
    finally:
        shutil.rmtree(scratch)
    different = sum(map(len, found.values()))
    if options.accept and different:
        lines = [f"\n## {options.accept}\n"]
        lines += [f"* {group}: {len(names)} cases, such as {', '.join(f'`{name}`' for name in names[:3])}"
                  for group, names in found.items() if names]
        CHANGES.write_text((CHANGES.read_text() if CHANGES.exists() else "# What was said otherwise since, and why\n")
                           + "\n".join(lines) + "\n")
    print(f"golden: {different} cases differ, {time.monotonic() - start:.0f} s")
    return 1 if different and not options.accept else 0


if __name__ == "__main__":
    sys.exit(main())
