#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Closes the records under idle contacts and direct sums, by hand: no record is beaten by others put side by side.

  tests/setup/close_records.py STICTION [FOLDER]      FOLDER: corpus/records by default, which is written

Of n contacts it tries the record of n - 1 with a contact that is never touched, and of every n = k + m both records side
by side, either first. What such a problem reaches is asked of `stiction records --add`. A record that is made so says
in its `what` that its parts are not coupled.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

COUNTED = ("descents", "give-ups", "period", "pieces", "steps", "zero-run")
APART = ", not coupled"
IDLE = {"contacts": [{"kind": "static", "mu": "1"}], "A": [["1", "0"], ["0", "1"]], "b": ["1", "0"]}


def beside(left, right, name):
    n, m = len(left["b"]), len(right["b"])
    return {"format": "stiction-problem", "version": 1, "name": name, "dimension": 2,
            "contacts": left["contacts"] + right["contacts"],
            "A": [row + ["0"] * m for row in left["A"]] + [["0"] * n + row for row in right["A"]],
            "b": left["b"] + right["b"]}


def made(program, folder, record, problem, parts):
    """The record of a problem, in a folder of its own; None where it has no value."""
    file = folder / "problem.json"
    file.write_text(json.dumps(problem))
    (folder / "out").mkdir(exist_ok=True)
    random = record["random"]
    words = ["--frontier", record["frontier"], "--what", record["what"].removesuffix(APART) + APART,
             "--objective", record["objective"], "--command", f"tests/setup/close_records.py: {' and '.join(parts)}",
             "--seconds", "0", "--random-evaluations", str(random["evaluations"]), "--random-command", random["command"]]
    if random["value"] is not None:
        words += ["--random", random["value"]]
    done = subprocess.run([program, "records", "--folder", folder / "out", "--add", file, *words], capture_output=True)
    text = (folder / "out" / f"{record['frontier']}.json").read_text() if done.returncode == 0 else None
    return text and (int(json.loads(text)["value"]), text)


def close(program, folder, objective):
    records = {n: folder / f"{objective}-{n}-contacts.json" for n in range(2, 9)}
    for n in range(3, 9):
        record = json.loads(records[n].read_text())
        best, text = int(record["value"]), None
        parts = {k: json.loads(records[k].read_text())["problem"] for k in range(2, n)}
        tries = [((parts[n - 1], f"{objective}-{n - 1}-contacts"), (IDLE, "an idle contact"))]
        tries += [((parts[k], f"{objective}-{k}-contacts"), (parts[n - k], f"{objective}-{n - k}-contacts"))
                  for k in range(2, n - 1)]
        for (left, of_left), (right, of_right) in tries:
            with tempfile.TemporaryDirectory() as made_in:
                found = made(program, Path(made_in), record, beside(left, right, record["problem"]["name"]),
                             (of_left, of_right))
            if found and found[0] > best:
                best, text = found
                print(f"{record['frontier']}: {record['value']} -> {best}: {of_left} and {of_right}", flush=True)
        if text:
            records[n].write_text(text)


if __name__ == "__main__":
    for name in COUNTED:
        close(sys.argv[1], Path(sys.argv[2] if len(sys.argv) > 2 else "corpus/records"), name)
