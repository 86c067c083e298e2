# SPDX-License-Identifier: Apache-2.0
"""plots_test.py PROGRAM SOURCES: plots show the numbers that they are of; what is not installed is named."""
import functools
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import stiction


os.environ["MPLBACKEND"] = "agg"
os.environ.setdefault("MPLCONFIGDIR", tempfile.mkdtemp(prefix="stiction-matplotlib-"))
try:
    import matplotlib
except ImportError:
    matplotlib = None
try:
    import pandas
except ImportError:
    pandas = None

plots = stiction.plots  # there without an import of its own
SOURCES = Path(sys.argv[2])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"


FOLDER = tempfile.TemporaryDirectory()
unittest.addModuleCleanup(FOLDER.cleanup)


@functools.cache
def store():
    file = Path(FOLDER.name) / "a.store"
    list(stiction.search(generator=["integers", "bodies"], contacts=[2, 3], mu=1, problems=20000, store=file,
                         finishing=0))
    return stiction.Store(file)


@unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
class Plots(unittest.TestCase):
    def drawn(self, axes):
        with tempfile.TemporaryDirectory() as folder:
            axes.figure.savefig(Path(folder) / "plot.png")
            self.assertGreater((Path(folder) / "plot.png").stat().st_size, 5000)

    def test_cones_hold_the_forces(self):
        problem = stiction.load(LOOP)
        axes = plots.cone(problem, stiction.solve(problem))
        x, y = axes.lines[-1].get_data()
        np.testing.assert_allclose([*x, *y], [1 / 3, 2 / 3, 1 / 3, 2 / 3])
        self.assertEqual([text.get_text() for text in axes.texts], ["1", "2"])
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("friction force, N", "normal force, N"))
        self.drawn(axes)
        space = stiction.load(SOURCES / "corpus/space/three-sliding-contacts.json")
        answer = stiction.solve(space, arithmetic="double", method="fast")
        x, y = plots.cone(space, answer).lines[-1].get_data()
        self.assertTrue((x >= 0).all())
        np.testing.assert_allclose(y, answer.f[0::3])
        with self.assertRaisesRegex(ValueError, "cone: found 4 forces, expected 9"):
            plots.cone(space, stiction.solve(problem))

    def test_paths_have_every_step(self):
        run = stiction.replay(stiction.load(LOOP))
        axes = plots.path(run)
        self.assertEqual([line.get_label() for line in axes.lines], ["N1", "F1", "N2", "F2"])
        for row, line in enumerate(axes.lines):
            np.testing.assert_array_equal(line.get_ydata(), [0, *(pivot.f[row] for pivot in run.pivots)])
        self.assertEqual(len(axes.patches), 1)
        # Where it begins, the state is that where the run was ended.
        first = int(axes.patches[0].get_xy()[0][0])
        np.testing.assert_array_equal(run.pivots[first - 1].f, run.pivots[-1].f)
        self.drawn(axes)

    def test_rates_are_counts_by_runs(self):
        axes = plots.rates(store())
        table, ends = store().statistics(), store().tables["verdicts"]
        for bars, label in zip(axes.containers, axes.get_legend_handles_labels()[1]):
            for contacts, rate in zip(*bars.lines[0].get_data()):
                runs = table["problems"][(table["generator"] == label) & (table["contacts"] == contacts)].sum()
                loops = ends["count"][(ends["generator"] == label) & (ends["contacts"] == contacts)
                                      & (ends["exact_outcome"] == "cycle")].sum()
                self.assertAlmostEqual(rate, 1e6 * loops / runs)
        self.assertEqual(len(axes.containers), 2)
        self.drawn(axes)


    def test_rates_are_those_of_exact_arithmetic(self):
        of = mock.Mock(tables={
            "statistics": {"generator": np.array(["g", "g"]), "contacts": np.array([2, 3]),
                           "problems": np.array([100, 50]), "method": np.array(["baraff", "baraff"])},
            "verdicts": {"generator": np.array(["g", "g"]), "contacts": np.array([2, 2]), "count": np.array([3, 4]),
                         "method": np.array(["baraff", "baraff"]), "exact_outcome": np.array(["cycle", "solved"]),
                         "inexact_outcome": np.array(["ray", "cycle"])}})
        np.testing.assert_allclose(plots.rates(of).containers[0].lines[0].get_data(), [[2, 3], [30000, 0]])
        with self.assertRaisesRegex(ValueError, "rates: found solved, expected"):
            plots.rates(of, "solved")


class Frames(unittest.TestCase):
    @unittest.skipUnless(pandas, "python3-pandas is not installed")
    def test_frames_are_the_tables(self):
        masked = 0
        for name, table in store().tables.items():
            frame = store().frame(name)
            self.assertEqual((list(frame.columns), len(frame)), (list(table), len(next(iter(table.values())))))
            for column, values in table.items():
                empty = np.ma.getmaskarray(values)
                masked += int(empty.sum())
                self.assertEqual(frame[column].isna().tolist(), empty.tolist())
                self.assertEqual(frame[column][~empty].tolist(), np.ma.compressed(values).tolist())
        self.assertGreater(masked, 0)
        with self.assertRaisesRegex(ValueError, "frame: found rates, expected one of statistics"):
            store().frame("rates")

    def test_what_is_not_installed_is_named(self):
        for name in ("matplotlib", "pandas"):
            hidden = {module: None for module in (name, f"{name}.pyplot")}
            with mock.patch.dict(sys.modules, hidden):
                with self.assertRaisesRegex(ImportError, f"found no {name}.*python3-{name}.*pip install {name}"):
                    plots.path(stiction.replay(stiction.load(LOOP))) if name == "matplotlib" else store().frame()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
