# SPDX-License-Identifier: Apache-2.0
"""notebook_test.py [PROGRAM] SOURCES: the cells of the notebooks give the outputs that are stored with them.

Instead of SOURCES a notebook itself can be named, where there is nothing else of them. `--write` NOTEBOOK stores them.
"""
import ast
import contextlib
import importlib.util
import io
import json
import sys
import unittest
from pathlib import Path

GIVEN = Path(sys.argv[-1])
NOTEBOOKS = sorted((GIVEN / "python").glob("*.ipynb")) if GIVEN.is_dir() else [GIVEN]


def run(source, names):
    """What a cell shows: what it prints, then its last expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    shown = io.StringIO()
    with contextlib.redirect_stdout(shown):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
    return shown.getvalue() + ("" if value is None else repr(value))


def code_cells(notebook):
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


class Notebook(unittest.TestCase):
    def test_their_cells_give_what_is_stored(self):
        for file in NOTEBOOKS:
            text = file.read_text()
            if "scipy" in text and not importlib.util.find_spec("scipy"):
                continue
            names, cells = {}, code_cells(json.loads(text))
            for count, cell in enumerate(cells, 1):
                stored = "".join(line for output in cell["outputs"]
                                 for line in output.get("text", output.get("data", {}).get("text/plain", [])))
                with self.subTest(file=file.name, cell=count):
                    self.assertEqual(run("".join(cell["source"]), names), stored)
                    self.assertEqual(cell["execution_count"], count)
            self.assertLessEqual(sum(len(cell["source"]) for cell in cells), 30)
            self.assertGreaterEqual(sum(bool(cell["outputs"]) for cell in cells), 2)

    def test_they_show_what_they_are_for(self):
        says = {"headline.ipynb": "'cycle'", "study.ipynb": "in a million", "engine_step.ipynb": "needed 98.20, engine 3"}
        for file in NOTEBOOKS:
            self.assertIn(says[file.name], file.read_text())


def write(file):
    """Runs the cells, and stores what each shows: what it prints, or its last expression."""
    notebook, names = json.loads(file.read_text()), {}
    for count, cell in enumerate(code_cells(notebook), 1):
        shown = run("".join(cell["source"]), names)
        prints = "print(" in "".join(cell["source"])
        output = {"output_type": "stream", "name": "stdout", "text": shown.splitlines(True)} if prints else {
            "output_type": "execute_result", "execution_count": count, "data": {"text/plain": [shown]}, "metadata": {}}
        cell.update(execution_count=count, outputs=[output] if shown else [])
    file.write_text(json.dumps(notebook, indent=1) + "\n")


if __name__ == "__main__":
    if "--write" in sys.argv:
        write(GIVEN)
    else:
        unittest.main(argv=sys.argv[:1])
