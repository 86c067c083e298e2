#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""join.py NAME OUT FILE.d: writes the page of src/NAME.html, with its script and its style sheet inside, as OUT; and that
FILE depends on what it was made of, as a Makefile does.

A module becomes a scope within the script, after those that it imports; README.md has the forms that are understood.
Filled in are {{script}}, {{style}}, {{policy}}, {{notices}}, {{solver}}, {{commit}} and \\( TeX \\); other marks, {{title}},
{{data}} and such, are left to the program (reports/html/html.h)."""

import base64
import hashlib
import json
import re
import sys
from pathlib import Path

WEB = Path(__file__).resolve().parent
IMPORT = re.compile(r"^import (?:\* as (?P<all>\w+)|(?P<names>\{[^}]*\})) from '(?P<path>\.[\w./-]+)';", re.M)
EXPORT = re.compile(r"^export (?:(?=(?:const|class|function|async function) (?P<name>\w+))|\{(?P<names>[^}]*)\};)", re.M)
SHEET = re.compile(r"^@import '(?P<path>\.[\w./-]+)';\n", re.M)


def fail(file, text, at, why):
    sys.exit(f"{file}:{text.count(chr(10), 0, at) + 1}: {why}")


def refuse_stray(file, text, names, all):
    """What a module imports as `* as all` is all.name there; what it declares, or takes, is its own."""
    code = re.sub(r"'(?:[^'\\\n]|\\.)*'", "''", re.sub(r"//.*", "", text))
    for name in filter(str.isidentifier, names):
        used = re.search(rf"(?<![\w.$]){name}\s*\(|\.\.\.{name}\b", code)
        if used and not re.search(rf"\b(?:const|let|var|function|class)\s+{name}\b|\b{name}\s*=>|"
                                  rf"[\[{{(,]\s*{name}\s*(?:[,=\]}}]|\)[^;]*?=)", code):
            fail(file, code, used.start(), f"{name} is {all}.{name} here")


class Joined:
    """A script or a style sheet as one `text`; `inputs`: the files of it."""

    def __init__(self, file):
        self.inputs, self.exports, self.before = [], {}, ""  # `before`: the modules that are whole
        body = self.module(file) if file.suffix == ".js" else self.sheet(file)
        self.text = self.before + body
        if end := re.search(r"</script|</style|<!--", self.text, re.I):
            sys.exit(f"{file}: found {end[0]} in what is joined, which would end it")

    def read(self, file):
        self.inputs.append(file)
        return file.read_text()

    def sheet(self, file):
        def take(found):
            other = (file.parent / found["path"]).resolve()
            return "" if other in self.inputs else self.sheet(other)

        return SHEET.sub(take, self.read(file))

    def module(self, file):
        """Its text, with imports and exports taken out."""
        text, exports = self.read(file), {}
        for word in re.finditer(r"^(import|export)\b", text, re.M):
            if not (IMPORT.match(text, word.start()) or EXPORT.match(text, word.start())):
                fail(file, text, word.start(), f"expected a form of {word[1]} that README.md has")

        def take(found):
            other = (file.parent / found["path"]).resolve()
            scope = "$" + re.sub(r"\W", "_", f"{other.parent.name}_{other.stem}")
            if not other.is_file():
                fail(file, text, found.start(), f"found no {found['path']}")
            if other not in self.inputs and other.suffix == ".json":
                value = json.loads(self.read(other))
                self.exports[other] = {name: name for name in value}
                self.before += f"const {scope} = {json.dumps(value)};\n"
            elif other not in self.inputs:
                body = self.module(other)
                given = ", ".join(f"{name}: {own}" for name, own in self.exports[other].items())
                self.before += f"const {scope} = (() => {{\n{body}return {{{given}}};\n}})();\n"
            if other not in self.exports:
                fail(file, text, found.start(), f"found a circle: {found['path']} imports this file")
            for name in re.findall(r"(\w+)(?: as \w+)?\s*[,}]", found["names"] or ""):
                if name not in self.exports[other]:
                    fail(file, text, found.start(), f"{found['path']} does not export {name}")
            if found["all"]:
                refuse_stray(file, text, self.exports[other], found["all"])
            return f"const {found['all'] or found['names'].replace(' as ', ': ')} = {scope};"

        def give(found):
            names = re.findall(r"([\w$]+)(?: as (\w+))?", found["name"] or found["names"])
            exports.update({name or own: own for own, name in names})
            return ""

        body = EXPORT.sub(give, IMPORT.sub(take, text))
        self.exports[file] = exports
        return body


def page(name, web=WEB):
    """The text of a page, and the files that it was made of."""
    file, formulas, solver = web / f"src/{name}.html", web / "src/formulas.json", web / "solver/solver.wasm.gz"
    source, mathml = file.read_text(), json.loads(formulas.read_text())
    script, style = Joined(file.with_suffix(".js")), Joined(file.with_suffix(".css"))
    inputs = [Path(__file__), file, formulas, *script.inputs, *style.inputs]
    notices = [one.with_suffix(".LICENSES.txt") for one in script.inputs if one.parent.name == "vendor"]
    parts, compiles, threads = {"script": script.text, "style": style.text}, "", ""
    if "{{solver}}" in source:
        worker, commit = Joined(web / "src/worker.js"), solver.with_name("commit.txt")
        parts["script"] = f"const WORKER_SOURCE = {json.dumps(worker.text)};\n{script.text}"
        parts |= {"solver": base64.b64encode(solver.read_bytes()).decode(), "commit": commit.read_text().strip()}
        inputs += [*worker.inputs, solver, commit]
        notices.append(solver.with_name("LICENSES.txt"))
        compiles, threads = " 'wasm-unsafe-eval'", " worker-src blob:;"  # README.md has why
    held = "\n\n".join(one.read_text().strip() for one in notices).replace("--", "- -")  # no end of a comment
    parts["notices"] = f"It holds parts of:\n\n{held}" if held else "It holds no code but stiction's own."
    own, sheet = ("'sha256-" + base64.b64encode(hashlib.sha256(parts[one].encode()).digest()).decode() + "'"
                  for one in ("script", "style"))
    parts["policy"] = (f"default-src 'none'; script-src {own}{compiles};{threads} style-src {sheet}; base-uri 'none'; "
                       "form-action 'none'")

    def formula(found):
        return mathml.get(found[1]) or fail(file, source, found.start(), f"{formulas.name} has no MathML of {found[0]}")

    marked = re.sub(r"\\\((.+?)\\\)", formula, source)
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts.get(found[1], found[0]), marked), inputs + notices


if __name__ == "__main__":
    text, made_of = page(sys.argv[1])
    Path(sys.argv[2]).write_text(text)
    files = (str(one).replace(" ", "\\ ") for one in (sys.argv[3].removesuffix(".d"), *made_of))
    Path(sys.argv[3]).write_text(": ".join([next(files), " ".join(files)]) + "\n")
