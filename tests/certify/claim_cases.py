# SPDX-License-Identifier: Apache-2.0
"""True and false claims, and every checker must accept the first and refuse the others.

What the tests of claims have in common: `true` and `false` note certificates, `main` shows them to the checkers.

  TEST STICTION SOURCES                   `stiction check`, and every certify/check_*.py
  TEST STICTION SOURCES CHECKER...        these programs instead, as `CHECKER FILE...`
  TEST --write FOLDER                     the certificates, for checkers elsewhere

A certificate here meets the whole form of its claim; what is wrong is one condition. Beside the false ones stand
certificates that are true, so that a checker that refuses everything fails. A checker prints `FILE: accepted...`
or `FILE: REJECTED...`. One that accepts no true certificate of a claim, or a part of it only, does not know it, and
is not asked; every claim must be known to `stiction check` and to a program in certify. Python standard library only.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

# --- Problems and certificates -----------------------------------------------------


def contact(law):
    """None: frictionless; a number: static; (mu, slip): sliding; "hold": bilateral."""
    if law is None:
        return {"kind": "frictionless"}
    if law == "hold":
        return {"kind": "bilateral"}
    if isinstance(law, tuple):
        return {"kind": "sliding", "mu": law[0], "slip": law[1]}
    return {"kind": "static", "mu": str(law)}


def texts(value):
    """Numbers as exact texts, in lists of any depth."""
    return [texts(item) for item in value] if isinstance(value, (list, tuple)) else str(value)


def problem(laws, A, b, dimension=2):
    return {"format": "stiction-problem", "version": 1, "dimension": dimension,
            "contacts": [contact(law) for law in laws], "A": texts(A), "b": texts(b)}


def certificate(claim, of, witness):
    return {"format": "stiction-certificate", "version": 1, "claim": claim, "problem": of, "witness": witness}


TRUE, FALSE = [], []  # (name, certificate)


def true(claim, what, of, **witness):
    TRUE.append((f"{claim}: {what}", certificate(claim, of, witness)))


def false(claim, what, of, **witness):
    FALSE.append((f"{claim}: {what}", certificate(claim, of, witness)))


# --- Checkers ----------------------------------------------------------------------


def write(folder, cases):
    files = []
    for number, (_, content) in enumerate(cases):
        files.append(folder / f"{number:03}.json")
        files[-1].write_text(json.dumps(content, indent=1))
    return files


def verdicts(command, files):
    """Of each file: True if it was accepted, False if it was refused, otherwise what was printed instead."""
    result = subprocess.run([*command, *files], capture_output=True, text=True)
    lines = result.stdout.splitlines()
    said = {}
    for file in files:
        own = [line[len(str(file)) + 2:] for line in lines if line.startswith(f"{file}: ")]
        if len(own) == 1 and own[0].startswith(("accepted", "REJECTED")):
            said[file] = own[0].startswith("accepted") and "its runs only" not in own[0]
    if len(said) == len(files) or len(files) == 1:
        return [said.get(file, f"exit {result.returncode}, {result.stderr.strip()[:200]}") for file in files]
    return [verdict for file in files for verdict in verdicts(command, [file])]


def claim_of(name):
    return name.split(":")[0]


def judge(name, command, folder, failures):
    """Returns the claims that this checker knows."""
    judged = list(zip(TRUE, verdicts(command, write(folder, TRUE))))
    known = {claim_of(case) for (case, _), verdict in judged if verdict is True}
    failures += [f"{name}: {case}: {verdict}, expected accepted" for (case, _), verdict in judged
                 if verdict is not True and (verdict is not False or claim_of(case) in known)]
    asked = [case for case in FALSE if claim_of(case[0]) in known | {"form"}]
    refused = verdicts(command, write(folder, asked))
    failures += [f"{name}: {case}: {'accepted' if verdict is True else verdict}, expected a refusal"
                 for (case, _), verdict in zip(asked, refused) if verdict is not False]
    print(f"{name}: {len(asked)} false claims of {len(known)} kinds")
    return known


def checkers_of(stiction, sources):
    """The programs: what they import is none."""
    scripts = [script for script in sorted((Path(sources) / "certify").glob("check_*.py")) if "__main__" in script.read_text()]
    return [("stiction check", [stiction, "check"]), *((script.name, [sys.executable, script]) for script in scripts)]


def main(stiction, sources, *programs):
    if stiction == "--write":
        Path(sources).mkdir(parents=True, exist_ok=True)
        write(Path(sources), TRUE + FALSE)
        return 0
    checkers = [(program, [program]) for program in programs] or checkers_of(stiction, sources)
    failures, known = [], []
    with tempfile.TemporaryDirectory() as folder:
        for name, command in checkers:
            known.append(judge(name, command, Path(folder), failures))
            if failures:
                break
    claims = {claim_of(name) for name, _ in TRUE}
    if not programs and not failures:
        failures += [f"no checker in certify knows {claim}" for claim in claims - set().union(*known[1:])]
        failures += [f"stiction check does not know {claim}" for claim in claims - known[0]]
    for failure in failures:
        print("FAILED:", failure)
    print(f"{len(failures)} failures")
    return 1 if failures else 0
