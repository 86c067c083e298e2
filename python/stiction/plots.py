# SPDX-License-Identifier: Apache-2.0
"""Plots by matplotlib: `cone`, forces within their cones; `path`, forces along a run; `rates`, what a search counted.

Each draws into `axes`, or axes of its own, and returns them. Nothing is imported before the first one is drawn.
"""
from __future__ import annotations

from typing import Any

import numpy as np

from ._campaigns import Store, interval
from ._given import required
from ._methods import Answer, Pivot, Replay
from ._problem import Problem

__all__ = ["cone", "path", "rates"]


def _axes(axes: Any) -> Any:
    return required("matplotlib.pyplot").subplots()[1] if axes is None else axes


def _first_rows(problem: Problem) -> list[int]:
    """The normal row of each contact."""
    rows, at = [], 0
    for kind in problem.kinds:
        rows.append(at)
        at += problem.dimension if kind in ("static", "sliding") else 1
    return rows


def _names(problem: Problem) -> list[str]:
    """Of the rows: N1, F1; in space F1x, F1y."""
    names = []
    for i, kind in enumerate(problem.kinds, 1):
        axes = [""] if problem.dimension == 2 else ["x", "y"]
        names += [f"N{i}"] + [f"F{i}{axis}" for axis in axes if kind in ("static", "sliding")]
    return names


def cone(problem: Problem, answer: Answer | Pivot, axes: Any = None) -> Any:
    """Normal and friction force of each contact in N, in space the length of friction, within |friction| = mu normal.

    Contacts are numbered as in the program. An answer without forces is a ValueError.
    """
    f = answer.f
    if len(f) != len(problem.b):
        raise ValueError(f"cone: found {len(f)} forces, expected {len(problem.b)}, one for each row of the problem")
    axes = _axes(axes)
    normal = np.array([f[row] for row in _first_rows(problem)])
    friction = np.zeros(len(normal))
    has_friction = [kind in ("static", "sliding") for kind in problem.kinds]
    for i, row in enumerate(_first_rows(problem)):
        if has_friction[i]:
            tangential = f[row + 1:row + problem.dimension]
            friction[i] = tangential[0] if problem.dimension == 2 else np.linalg.norm(tangential)
    top = 1.15 * max(normal.max(initial=0.0), 1e-300)
    for mu in sorted({float(mu) for mu, has in zip(problem.mu, has_friction) if has}):
        line, = axes.plot([0, mu * top], [0, top], label=f"mu = {mu:g}")
        if problem.dimension == 2:
            axes.plot([0, -mu * top], [0, top], color=line.get_color())
    axes.plot(friction, normal, "ko")
    for i, at in enumerate(zip(friction, normal), 1):
        axes.annotate(str(i), at, xytext=(5, 5), textcoords="offset points")
    axes.set(xlabel="friction force, N" if problem.dimension == 2 else "length of the friction force, N",
             ylabel="normal force, N", title=problem.name)
    axes.legend()
    return axes


def path(run: Replay, axes: Any = None) -> Any:
    """Forces in N after each step of a run, a line for each row; steps of the period of a loop stand on grey."""
    axes = _axes(axes)
    f = np.array([run.before, *(pivot.f for pivot in run.pivots)])
    for row, name in enumerate(_names(run.problem)):
        axes.plot(f[:, row], marker=".", label=name)
    if run.outcome == "cycle":
        first = sum(pivot.drive <= run.start for pivot in run.pivots)
        axes.axvspan(first, len(run.pivots), color="0.9", zorder=0)
    axes.set(xlabel="step", ylabel="force, N", title=f"{run.problem.name}: {run.outcome}")
    axes.legend()
    return axes


def rates(store: Store, outcome: str = "cycle", axes: Any = None) -> Any:
    """Of a million runs of a search how many ended so in exact arithmetic, by number of contacts, a line for each
    generator; all policies together. Bars are exact intervals at 95 %."""
    if outcome == "solved":  # of which suspicions alone are decided exactly
        raise ValueError("rates: found solved, expected another outcome, as cycle, ray or singular")
    runs, ends = store.tables["statistics"], store.tables["verdicts"]
    axes = _axes(axes)
    for generator in dict.fromkeys(runs["generator"].tolist()):
        points = []
        for contacts in np.unique(runs["contacts"][runs["generator"] == generator]).tolist():
            of, met = ((table["generator"] == generator) & (table["contacts"] == contacts)
                       & (table["method"] == "baraff") for table in (runs, ends))
            count = int(ends["count"][met & (ends["exact_outcome"] == outcome)].sum())
            problems = int(runs["problems"][of].sum())
            if problems:
                low, high = interval(count, problems)
                share = count / problems
                points.append((contacts, 1e6 * share, 1e6 * max(share - low, 0), 1e6 * max(high - share, 0)))
        if points:
            x, y, below, above = np.array(points).T
            axes.errorbar(x, y, [below, above], marker="o", capsize=3, label=generator)
    axes.set(xlabel="contacts", ylabel=f"{outcome}: runs in a million")
    axes.legend()
    return axes
