# SPDX-License-Identifier: Apache-2.0
"""The program under test, its problems and its stores. Used by the tests beside this file."""

import base64
import hashlib
import json
import os
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.environ["COLUMNS"] = "200"  # sentences stay on one line; terminal_test.py is about narrower ones
SHORT = os.environ.get("STICTION_TESTS") == "short"  # builds of the matrix but the first
ALL = os.environ.get("STICTION_TESTS") == "all"  # its first, and at night
PATIENCE = 120  # seconds until what should happen has happened, on a machine with other work
# What is compared of two stores; `work` is another in every run.
TABLES = {
    "campaign": "key",
    "blocks": "shards, shard, block",
    "units": "unit",
    "findings": "signature",
    "elites": "unit",
}

# Cycles under the reference policy, solved under others.
REFERENCE = {
    "format": "stiction-problem", "version": 1, "name": "two-contact-cycle", "dimension": 2,
    "contacts": [{"kind": "static", "mu": "1"}, {"kind": "static", "mu": "1"}],
    "A": [["7", "-2", "-6", "0"], ["-2", "9", "-1", "-7"], ["-6", "-1", "7", "3"], ["0", "-7", "3", "7"]],
    "b": ["2", "-1", "-2", "2"],
}
PERIOD = ["6/5", "0", "39/290", "791/310", "0", "3/62", "19/310", "1/10", "1/9", "65/63"]

# One contact that comes to rest: f = (1/2, -1/3).
SOLVED = {
    "format": "stiction-problem", "version": 1, "name": "one-contact", "dimension": 2,
    "contacts": [{"kind": "static", "mu": "1"}],
    "A": [["2", "0"], ["0", "3"]], "b": ["-1", "1"],
}

program = ""  # set by main()
answers = []  # what --json printed, with the verb: main() holds it against the schemas


class Run:
    """What one call of the program left behind."""

    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err

    def json(self):
        return json.loads(self.out)


def share(cases, n):
    """Every n-th of the cases; all of them in the first build of the matrix."""
    return list(cases) if ALL else list(cases)[::n]


def run(*arguments, cwd=None, timeout=600):
    done = subprocess.run([program, *map(str, arguments)], cwd=cwd, timeout=timeout, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if "--json" in arguments and done.stdout:
        answers.append([arguments[0], done.stdout])
    return Run(done.returncode, done.stdout, done.stderr)


def refused_by_schemas():
    """What is wrong with the answers of --json so far. Debian's Python has jsonschema, the one that runs this may not."""
    if not answers:
        return ""
    done = subprocess.run(["/usr/bin/python3", ROOT / "cli/validate.py", program], input=json.dumps(answers), text=True,
                          capture_output=True)
    return "".join(dict.fromkeys(done.stderr.splitlines(keepends=True))) if done.returncode else ""


def unwrapped(text):
    """The words of a text. Where its lines break depends on the lengths of the paths in it."""
    return " ".join(text.split())


def unpacked(text):
    """What pages pack (reports/html/packed.h), as bytes."""
    return zlib.decompress(base64.b64decode(text))


def animation(page):
    """The data of an animation (reports/web/data.md), `frames` unpacked: with the `forces` of each, {bodies, kind, mu, f}."""
    data = json.loads(re.search(r'id="data">(.*?)</script>', page.read_text(), re.S)[1])
    data["frames"] = json.loads(unpacked(data["frames"]))
    packed, at, before = unpacked(data.pop("forces")), 0, []
    for frame in data["frames"]:
        (count,), found, at = struct.unpack_from("<h", packed, at), [], at + 2
        while len(found) < count:
            same, new = struct.unpack_from("<hh", packed, at)
            at += 4
            found += before[len(found):len(found) + same]
            for _ in range(new):
                contact = data["contacts"][struct.unpack_from("<h", packed, at)[0]]
                found.append({**contact, "f": struct.unpack_from(f"<{contact['rows']}f", packed, at + 10)})
                at += 10 + 4 * contact["rows"]
        frame["forces"] = before = found
    return data


def content(store):
    """Every row of every table of a store, in order."""
    db = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
    try:
        return {table: db.execute(f"SELECT * FROM {table} ORDER BY {order}").fetchall()
                for table, order in TABLES.items()}
    finally:
        db.close()


# The columns that the seal of a row is of, in order (corpus/store/store_rows.h).
SEALED = {
    "blocks": "shards, shard, block, record",
    "units": "unit, shards, shard, block, record",
    "findings": "signature, kind, unit, idx, generator, contacts, policy, inexact_outcome, exact_outcome, problem, done, "
                "certificate, minimized, minimized_certificate, existence, minimized_existence, facts",
    "elites": "unit, elites",
    "work": "shards, shard, block, unit, builds, time",
}


def seal(table, columns):
    parts = [table.encode()] + [x if isinstance(x, bytes) else str(x).encode() for x in columns]
    return hashlib.sha256(b"".join(b"%d:%s\n" % (len(part), part) for part in parts)).hexdigest()


def change(store, sql, parameters=(), reseal=True):
    """Changes rows of a store; sealed anew, as if a program had written them so. Returns how many."""
    db = sqlite3.connect(store)
    with db:
        changed = db.execute(sql, parameters).rowcount
        if reseal:
            for table, columns in SEALED.items():
                key = TABLES.get(table, "shards, shard, block, unit").split(", ")
                for row in db.execute(f"SELECT {', '.join(key)}, {columns} FROM {table}").fetchall():
                    where = " AND ".join(f"{name} = ?" for name in key)
                    db.execute(f"UPDATE {table} SET seal = ? WHERE {where}",
                               [seal(table, row[len(key):]), *row[:len(key)]])
            rows = dict(db.execute("SELECT key, value FROM campaign WHERE key != 'seal'"))
            db.execute("UPDATE campaign SET value = ? WHERE key = 'seal'",
                       [seal("campaign", [x for key in sorted(rows) for x in (key, rows[key])])])
    db.close()
    return changed


def total(store):
    """The sum of all records of a store, added here and not by the program."""
    db = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
    tallies, signatures = {}, {}
    for (text,) in db.execute("SELECT record FROM blocks UNION ALL SELECT record FROM units"):
        record = json.loads(text)
        for tally in record["tallies"]:
            key = tuple(tally.pop(name) for name in ("generator", "contacts", "policy", "method", "arithmetic"))
            tally["strata"] = {tuple(stratum[:2]): stratum[2:] for stratum in tally["strata"]}
            tallies[key] = add(tallies[key], tally) if key in tallies else tally
        for signature, count in record["signatures"].items():
            signatures[signature] = signatures.get(signature, 0) + count
    db.close()
    return tallies, signatures


def add(left, right, plus=lambda a, b: a + b):
    if isinstance(left, dict):
        both = {key: add(left[key], right[key], max if key == "maxima" else plus) for key in left.keys() & right.keys()}
        return {**left, **right, **both}
    if isinstance(left, list):
        longer, shorter = sorted((left, right), key=len, reverse=True)
        return [add(a, b, plus) for a, b in zip(longer, shorter)] + longer[len(shorter):]
    return plus(left, right)


class TestCase(unittest.TestCase):
    """Tests in a folder of their own."""

    maxDiff = 2000

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="stiction-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def file(self, name, value):
        """Writes text, or a value as JSON."""
        path = self.folder / name
        path.write_text(value if isinstance(value, str) else json.dumps(value))
        return path

    def wait_until(self, holds):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if holds():
                return
            time.sleep(0.05)
        self.fail("it does not get on")

    def succeeds(self, *arguments, code=0, **options):
        done = run(*arguments, **options)
        self.assertEqual(done.code, code, f"{arguments}\n{done.out}\n{done.err}")
        self.assertPlain(done)
        return done

    def refuses(self, *arguments, says=(), **options):
        """Bad usage or input: exit 2, a message on standard error, nothing on standard output."""
        done = run(*arguments, **options)
        self.assertEqual(done.code, 2, f"{arguments}\n{done.out}\n{done.err}")
        self.assertEqual(done.out, "")
        self.assertNotEqual(done.err.strip(), "")
        self.assertPlain(done)
        for text in says if isinstance(says, (list, tuple)) else [says]:
            self.assertIn(str(text), done.err)
        return done

    def assertPlain(self, done):
        """No colour and no cursor movement: nothing here is a terminal."""
        for stream in (done.out, done.err):
            self.assertNotIn("\x1b", stream)
            self.assertNotIn("\r", stream)

    def assertSameContent(self, left, right, tables=tuple(TABLES)):
        left, right = content(left), content(right)
        for table in tables:
            self.assertEqual(len(left[table]), len(right[table]), table)
            for mine, theirs in zip(left[table], right[table]):
                self.assertEqual(mine, theirs, table)


def main():
    """Runs the tests of the calling script: NAME.py PATH_TO_STICTION [SOURCES] [unittest arguments]."""
    global program, ROOT
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PATH_TO_STICTION")
    program = os.path.abspath(sys.argv[1])
    rest = sys.argv[2:]
    if rest and os.path.isdir(rest[0]):
        ROOT = Path(rest.pop(0)).resolve()
    tests = unittest.main(argv=[sys.argv[0], *rest], exit=False)
    refused = refused_by_schemas()
    sys.exit(refused or not tests.result.wasSuccessful())
