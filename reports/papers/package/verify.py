#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Verifies this folder: its checksums, its manifest, and every certificate, with Python's standard library alone.

  python3 verify.py

First every file must have the checksum that stands in SHA256SUMS, and no other file may lie here. Then the
manifest: each finding's files exist, each problem has the digest that is stated, each certificate the claim, and
speaks of the problem that it is said to. Then every certificate is checked by the programs in checkers/, in exact
arithmetic: of loops the published algorithm is run again from f = 0. What a checksum cannot tell, a certificate
that was altered with its sum, this does.

Says what is wrong, a line for each. Exit: 0 all verified, 1 something is wrong.
"""

import hashlib
import json
import os
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is to be left here
HERE = Path(__file__).resolve().parent
SUMS, MANIFEST = "SHA256SUMS", "manifest.json"
UNLISTED = {SUMS, ".stiction-files"}  # the list of sums itself, and what `stiction report` replaces the folder by
LOOPS = ("cycle", "stall", "safe-cycle")
MOST_SHOWN = 100


class Wrong(Exception):
    """Something does not hold; the text says where, what was found and what was expected."""


# --- Checksums -----------------------------------------------------------------------

def stated_sums():
    """File -> checksum, as SHA256SUMS has them."""
    try:
        lines = (HERE / SUMS).read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError) as error:
        raise Wrong(f"{SUMS}: unreadable: {error}") from None
    sums = {}
    for number, line in enumerate(lines, 1):
        match = re.fullmatch(r"([0-9a-f]{64})  (.+)", line)
        if not match or match[2] in sums:
            raise Wrong(f"{SUMS}:{number}: found {line[:100]!r}, expected a checksum, two blanks and a name, each name once")
        sums[match[2]] = match[1]
    return sums


def files_here():
    """The names of all files, and of links, which are none."""
    names = set()
    for folder, folders, files in os.walk(HERE):
        links = [name for name in folders if (Path(folder) / name).is_symlink()]
        names |= {(Path(folder) / name).relative_to(HERE).as_posix() for name in [*files, *links]}
    return names - UNLISTED


def check_sums(sums):
    present = files_here()
    for name in sorted(sums.keys() - present):
        yield f"{name}: missing"
    for name in sorted(present - sums.keys()):
        yield f"{name}: found a file that {SUMS} does not name"
    for name in sorted(sums.keys() & present):
        path = HERE / name
        if path.is_symlink() or not path.is_file():
            yield f"{name}: found no plain file"
            continue
        found = hashlib.sha256(path.read_bytes()).hexdigest()
        if found != sums[name]:
            yield f"{name}: checksum is {found}, expected {sums[name]}"


# --- The manifest and the certificates -------------------------------------------------

def entry(value, place, **kinds):
    """The object `value`, each key of which must be there and of its kind."""
    if type(value) is not dict:
        raise Wrong(f"{MANIFEST}: {place}: expected an object")
    for key, kind in kinds.items():
        if type(value.get(key)) is not kind:
            raise Wrong(f"{MANIFEST}: {place}.{key}: found {str(value.get(key))[:100]!r}, expected {kind.__name__}")
    return [value[key] for key in kinds]


def listed(name, sums):
    if name not in sums:
        raise Wrong(f"{MANIFEST}: names {name[:200]!r}, which {SUMS} does not")
    return HERE / name


def check_problems(reader, problems, place, sums):
    """File -> digest, computed here."""
    digests = {}
    for i, problem in enumerate(problems):
        name, stated = entry(problem, f"{place}.problems[{i}]", file=str, digest=str)
        try:
            found = reader.digest(reader.read_problem_file(listed(name, sums)))
        except (OSError, ValueError, RecursionError, reader.Rejected) as error:
            raise Wrong(f"{name}: no problem: {error}") from None
        if found != stated:
            raise Wrong(f"{name}: digest is {found}, expected {stated}")
        digests[name] = found
    return digests


def check_certificate(reader, claims, certificate, place, digests, sums):
    """The name of the file that was checked."""
    name, claim, of = entry(certificate, place, file=str, claim=str, problem=str)
    if of not in digests:
        raise Wrong(f"{MANIFEST}: {place}.problem: found {of[:200]!r}, expected a problem of the same finding")
    try:
        value = reader.load(listed(name, sums))
        found = value.get("claim") if type(value) is dict else None
        if found != claim:
            raise Wrong(f"{name}: claim is {found!r}, expected {claim!r}")
        reader.check(value, claims, digests[of])
    except (OSError, ValueError, RecursionError) as error:
        raise Wrong(f"{name}: unreadable: {error}") from None
    except reader.Rejected as reason:
        raise Wrong(f"{name}: REJECTED: {reason}") from None
    return name


class Verified:
    def __init__(self):
        self.findings = self.certificates = self.loops = self.proved = 0
        self.named = set()  # files that the manifest accounts for
        self.wrong = []


def check_finding(reader, claims, finding, place, sums, verified):
    signature, kind, problems, certificates = entry(finding, place, signature=str, kind=str, problems=list,
                                                    certificates=list)
    verified.findings += 1
    digests = check_problems(reader, problems, place, sums)
    verified.named |= digests.keys()
    proofs = set()
    for i, certificate in enumerate(certificates):
        try:
            verified.named.add(check_certificate(reader, claims, certificate, f"{place}.certificates[{i}]", digests, sums))
            verified.certificates += 1
            proofs.add(certificate["claim"])
        except Wrong as wrong:
            verified.wrong.append(str(wrong))
    if kind in LOOPS:
        verified.loops += 1
        verified.proved += bool(proofs & {"cycle", "counterexample"})


def check_manifest(sums):
    sys.path.insert(0, str(HERE / "checkers"))
    import certificate_reader as reader  # their checksums are right
    from check_certificate import CLAIMS

    verified = Verified()
    try:
        manifest = json.loads((HERE / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise Wrong(f"{MANIFEST}: unreadable: {error}") from None
    form, version, findings = entry(manifest, "$", format=str, version=int, findings=list)
    if (form, version) != ("stiction-package", 1):
        raise Wrong(f"{MANIFEST}: found {form!r}, version {version}, expected 'stiction-package', version 1")
    for i, finding in enumerate(findings):
        try:
            check_finding(reader, CLAIMS, finding, f"$.findings[{i}]", sums, verified)
        except Wrong as wrong:
            verified.wrong.append(str(wrong))
        if sys.stderr.isatty():
            print(f"\r{i + 1} of {len(findings)} findings", end="", file=sys.stderr)
    if sys.stderr.isatty():
        print(file=sys.stderr)
    for name in sorted(sums):
        if name.startswith("findings/") and name not in verified.named and not verified.wrong:
            verified.wrong.append(f"{name}: no finding of {MANIFEST} names it")
    return verified


# --- All of it -------------------------------------------------------------------------

def tell(wrong):
    for line in wrong[:MOST_SHOWN]:
        print("WRONG: " + line)
    if len(wrong) > MOST_SHOWN:
        print(f"WRONG: and {len(wrong) - MOST_SHOWN} more")
    return 1


def main():
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    if len(sys.argv) > 1:
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 1
    try:
        sums = stated_sums()
        if wrong := list(check_sums(sums)):
            return tell(wrong)
        verified = check_manifest(sums)
    except Wrong as wrong:
        return tell([str(wrong)])
    if verified.wrong:
        return tell(verified.wrong)
    print(f"verified: {len(sums)} files, {verified.findings} findings, {verified.certificates} certificates; "
          f"{verified.proved} of {verified.loops} kinds of loops are proved here")
    return 0


if __name__ == "__main__":
    sys.exit(main())
