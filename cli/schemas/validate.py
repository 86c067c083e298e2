#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds answers of --json against the schemas beside this file.

  stiction solve FILE --json | cli/schemas/validate.py solve
  cli/schemas/validate.py             [[VERB, TEXT], ...] on standard input, as the tests have it

Needs jsonschema (Debian: python3-jsonschema). Exit 1, and what is wrong on standard error, if an answer does not fit.
"""
import json
import sys
from pathlib import Path

try:
    import jsonschema
except ImportError:
    sys.exit("expected jsonschema: apt-get install python3-jsonschema")

HERE = Path(__file__).resolve().parent


def refuse(place, found):
    raise ValueError(f"{place}: found {found}")


def validators():
    """By verb. References are to files beside this one."""
    read = {}
    for file in HERE.glob("*.schema.json"):
        schema = json.loads(file.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        resolver = jsonschema.RefResolver(file.as_uri(), schema)
        read[file.name.split(".")[0]] = jsonschema.Draft202012Validator(schema, resolver=resolver)
    del read["shared"]
    return read


def main():
    text = sys.stdin.read()
    answers = [[sys.argv[1], text]] if len(sys.argv) > 1 else json.loads(text)
    read, wrong = validators(), []
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
        sys.exit("\n".join(dict.fromkeys(wrong)))


if __name__ == "__main__":
    main()
