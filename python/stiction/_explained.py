# SPDX-License-Identifier: Apache-2.0
"""A problem in words; methods and policies as data."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import _stiction
from ._given import integer
from ._methods import chosen
from ._problem import Problem, compiled


@dataclass(frozen=True, repr=False)
class Explanation:
    """What `stiction explain` says of a problem: `text` in words, as `print` shows it, `json` as data."""

    text: str
    json: dict[str, Any]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<stiction.Explanation of {self.json['file']!r}, {len(self.text.splitlines())} lines>"


def explain(problem: Problem, *, columns: int = 80, max_drives: int | None = None, max_pivots: int | None = None,
            max_bits: int | None = None) -> Explanation:
    """What a problem is, whether it has a solution, what the methods do on it, what can be certified.

    Commands name the file NAME.json, as which `problem.save` may write it. Lines have at most so many columns, but for
    commands. Ctrl-C as in `solve`.
    """
    if not 40 <= integer("columns", columns) <= 200:
        raise ValueError(f"explain: columns: found {columns}, expected 40 to 200")
    found, text = _stiction.explain(compiled(problem, "explain"), f"{problem.name}.json", columns,
                                    chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits))
    return Explanation(text, found)


def methods() -> list[dict[str, Any]]:
    """A row for each method: `name`, `title`, `source`, `ends` (what its end proves), `path` (whether `replay` follows
    it), and the arithmetics in which it is built, `plane` and `space`. pandas.DataFrame takes it."""
    rows: list[dict[str, Any]] = _stiction.methods()
    return rows


def policies() -> list[dict[str, Any]]:
    """A row for each switch of a policy: `switch`, `question` (what the paper leaves open), `reads` (its sentence),
    `planar`, and its `values`, each with its `meaning`; the first one is that of policy 'paper'."""
    rows: list[dict[str, Any]] = _stiction.policies()
    return rows
