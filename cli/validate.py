#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds answers of --json against the schemas of the program that gave them.

  stiction solve FILE --json | cli/validate.py stiction solve
  cli/validate.py stiction            [[VERB, TEXT], ...] on standard input, as the tests have it

Needs jsonschema (Debian: python3-jsonschema). Exit 1, and what is wrong on standard error, if an answer does not fit.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import jsonschema
except ImportError:
    sys.exit("expected jsonschema: apt-get install python3-jsonschema")

def refuse(place, found):
    raise ValueError(f"{place}: found {found}")


def validators(program):
    """By verb."""
    read = {}
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "manual", "--schemas", folder], check=True)
        for file in Path(folder).glob("*.schema.json"):
            schema = json.loads(file.read_text())
            jsonschema.Draft202012Validator.check_schema(schema)
            read[file.name.split(".")[0]] = jsonschema.Draft202012Validator(schema)
    return read


def main():
    text = sys.stdin.read()
    answers = [[sys.argv[2], text]] if len(sys.argv) > 2 else json.loads(text)
    read, wrong = validators(sys.argv[1]), []
    for verb, answer in answers:
        if verb not in read:
            wrong.append(f"{verb}: has no schema")
            continue
        try:
            value = json.loads(answer, parse_constant=lambda word: refuse(verb, word))
        except ValueError as error:
            wrong.append(f"{verb}: {error}: {answer[:200]}")
            continue
        error = jsonschema.exceptions.best_match(read[verb].iter_errors(value))
        if error is not None:
            wrong.append(f"{verb}: {error.json_path}: {error.message[-300:]}")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
