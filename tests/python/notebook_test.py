# SPDX-License-Identifier: Apache-2.0
"""notebook_test.py [PROGRAM] SOURCES: the cells of headline.ipynb give the outputs that are stored with them.

Instead of SOURCES the notebook itself can be named, where there is nothing else of them.
"""
import ast
import contextlib
import io
import json
import sys
import unittest
from pathlib import Path

NOTEBOOK = Path(sys.argv[-1])
if NOTEBOOK.is_dir():
    NOTEBOOK /= "python/headline.ipynb"


def run(source, names):
    """What a cell shows: what it prints, then its last expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    shown = io.StringIO()
    with contextlib.redirect_stdout(shown):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
    return shown.getvalue() + ("" if value is None else repr(value))


class Notebook(unittest.TestCase):
    def test_its_cells_give_what_is_stored(self):
        notebook = json.loads(NOTEBOOK.read_text())
        names = {}
        cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        for count, cell in enumerate(cells, 1):
            stored = "".join(line for output in cell["outputs"]
                             for line in output.get("text", output.get("data", {}).get("text/plain", [])))
            with self.subTest(cell=count):
                self.assertEqual(run("".join(cell["source"]), names), stored)
                self.assertEqual(cell["execution_count"], count)
        self.assertLessEqual(sum(len(cell["source"]) for cell in cells), 12)
        self.assertIn("'cycle'", NOTEBOOK.read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
