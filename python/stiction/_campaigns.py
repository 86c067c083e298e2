# SPDX-License-Identifier: Apache-2.0
"""Campaigns and their stores."""
from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from typing import Any, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _stiction
from ._given import Path, exact_text, integer, listed, path_text, real, required, shortened
from ._methods import Certificate
from ._problem import Problem, parsed, wrapped

Table = dict[str, NDArray[Any]]


@dataclass(frozen=True, repr=False)
class Finding:
    """A group of problems that a campaign met `count` times, and the first of them, which stands for all.

    `problem` is that one as it was found: number `index` of unit `unit` of the campaign with `seed`. `outcome` is
    that of exact arithmetic, `inexact_outcome` that of doubles. What follows is there once it is `finished`:
    `minimized` is a smaller problem of the same group; `policies` counts how `problem` ends under all planar
    readings, if it has at most four contacts. `sentence` is what is proved of its loop, empty of what is none: that a
    state recurs, or in space that the run never leaves a box. `certificate` speaks of the minimized problem where there is one,
    otherwise of the problem; so does `existence`, that there is a solution or that there is none.
    """

    signature: str
    kind: str
    count: int
    outcome: str
    inexact_outcome: str
    generator: str
    contacts: int
    policy: str
    seed: int
    unit: int
    index: int
    finished: bool
    problem: Problem
    minimized: Problem | None
    certificate: Certificate | None
    existence: Certificate | None
    policies: dict[str, int]
    sentence: str
    facts: dict[str, Any]  # all that the store says of it besides

    def __repr__(self) -> str:
        return f"<stiction.Finding {shortened(self.signature)!r}, {self.contacts} contacts, met {self.count} times>"


def _certificate(text: str) -> Certificate | None:
    return Certificate(json.loads(text)["claim"], text) if text else None


def _finding(row: Mapping[str, Any], seed: int) -> Finding:
    facts = json.loads(row["facts"]) if row["facts"] else {}
    problem = parsed(row["problem"], row["signature"])
    minimized = parsed(row["minimized"], row["signature"]) if row["minimized"] else None
    of = "minimized_" if minimized is not None else ""
    return Finding(
        row["signature"], row["kind"], row["count"], row["exact_outcome"], row["inexact_outcome"], row["generator"],
        row["contacts"], row["policy"], seed, row["unit"], row["idx"], bool(row["done"]), problem, minimized,
        _certificate(row[of + "certificate"]), _certificate(row[of + "existence"]),
        facts.get("found", {}).get("grid", {}), row["sentence"], facts)


def _column(cells: Sequence[Any], is_text: bool) -> NDArray[Any]:
    if is_text:
        return np.array([cell or "" for cell in cells], dtype=str)
    empty = [cell is None for cell in cells]
    numbers = np.array([cell or 0 for cell in cells], dtype=np.int64)
    masked: NDArray[Any] = np.ma.masked_array(numbers, empty)  # type: ignore[no-untyped-call]
    return masked if any(empty) else numbers


@dataclass(frozen=True, repr=False)
class Best:
    """The worst problem for the algorithm that a search with an objective found, confirmed by exact arithmetic.

    `value` is that of the objective; None where it has none, as of a search for loops that found none.
    """

    value: float | None
    generator: str
    contacts: int
    problem: Problem

    def __repr__(self) -> str:
        return f"<stiction.Best {self.value} of {self.generator}, {self.contacts} contacts>"


class Store:
    """What a campaign has left in a file, as it is at this moment; nothing is written to it.

    A file that cannot be opened is an OSError, one that is no sound store a ValueError that names the row.
    """

    def __init__(self, path: Path) -> None:
        file = path_text(path)
        with open(file, "rb"):  # OSError where it cannot be opened
            pass
        self._store = _stiction.Store(file)
        self._file = os.path.abspath(file)
        self._tables: dict[str, Table] = {}

    def __repr__(self) -> str:
        return f"<stiction.Store {self._file!r}>"

    def __reduce__(self) -> tuple[Any, ...]:  # for pickle and copy: the file is read again
        return Store, (self._file,)

    @property
    def campaign(self) -> dict[str, Any]:
        """As a campaign file has it, with its seed and its policies."""
        campaign: dict[str, Any] = json.loads(self._store.campaign())
        return campaign

    @property
    def findings(self) -> list[Finding]:
        """Those of which a problem was kept, in the order of signature; all groups stand in the table `findings`."""
        seed = self.campaign["seed"]
        return [_finding(row, seed) for row in self._store.findings()]

    @property
    def best(self) -> list[Best]:
        """Of a search with an objective the best of each generator and number of contacts, the best first."""
        return [Best(row["value"], row["generator"], row["contacts"], parsed(row["problem"], "best"))
                for row in self._store.best()]

    @property
    def tables(self) -> dict[str, Table]:
        """The tables of `stiction report` by name, as statistics, verdicts or strata; of each its columns by name.

        Numbers are int64, masked where a cell is empty; all else is text. Left out are the columns of `findings`
        that name files of a report's folder. `frame` has one for pandas.
        """
        if not self._tables:
            for name, (texts, written) in self._store.tables().items():
                table = json.loads(written)
                self._tables[name] = {column: _column([row[i] for row in table["rows"]], column in texts)
                                      for i, column in enumerate(table["columns"]) if not column.endswith("_file")}
        return dict(self._tables)

    def frame(self, name: str = "statistics") -> Any:
        """A table by name as a pandas.DataFrame; an empty cell is NaN, as of any column of numbers that has one."""
        tables = self.tables
        if name not in tables:
            raise ValueError(f"frame: found {name}, expected one of {', '.join(tables)}")
        columns: dict[str, Any] = {}
        for of, column in tables[name].items():
            masked: Any = column
            columns[of] = masked.astype(float).filled(np.nan) if isinstance(column, np.ma.MaskedArray) else column
        return required("pandas").DataFrame(columns)

    def statistics(self) -> Table:
        """A row per generator, contacts, policy, method and arithmetic: problems, outcomes, all counters."""
        return self.tables["statistics"]


def _campaign(campaign: Path | Mapping[str, Any] | None, changes: Mapping[str, Any]) -> str:
    """The text of a campaign file: of a file or a dictionary, or the usual one, with changes."""
    if campaign is None:
        fields: dict[str, Any] = {"format": "stiction-campaign", "version": 1}
    elif isinstance(campaign, Mapping):
        fields = dict(campaign)
    else:
        with open(campaign, encoding="utf-8") as file:
            fields = json.load(file)
        if not isinstance(fields, dict):
            raise ValueError(f"{os.fspath(campaign)}: expected an object")
    fields.update({key: value for key, value in changes.items() if value is not None})
    for key in ("generators", "contacts", "mu", "policies"):
        if key in fields and fields[key] != "*":
            fields[key] = listed(fields[key], key)
    if "mu" in fields:
        fields["mu"] = [exact_text(x, "mu") for x in fields["mu"]]
    if "contacts" in fields:
        fields["contacts"] = [integer("contacts", x) for x in fields["contacts"]]
    return json.dumps(fields)


def draw(generator: str, contacts: int, count: int, seed: int = 1, *, mu: Any = None, first: int = 0) -> list[Problem]:
    """Problems of a generator that `stiction search --help` describes, without a search: those of the numbers `first`
    to `first + count - 1`. Each is a function of generator, contacts, mu, seed and its number."""
    text = _campaign(None, {"generators": generator, "contacts": contacts, "mu": mu, "seed": seed})
    for name, value in (("count", count), ("first", first)):
        if integer(name, value) < 0:
            raise ValueError(f"draw: {name}: found {value}, expected a number of at least 0")
    return [wrapped(problem) for problem in _stiction.draw(text, count, first)]


def interval(count: int, of: int | None = None) -> tuple[float, float]:
    """The exact interval at 95 % of a share, found `count` times in `of` trials; without `of`, of an expected number of
    events of which `count` were seen. What the program prints in brackets."""
    if integer("count", count) < 0 or (of is not None and integer("of", of) < max(count, 1)):
        raise ValueError(f"interval: found {count} of {of}, expected 0 or more of at least as many")
    return _stiction.interval(count, of)


def search(generator: str | Sequence[str] | None = None, contacts: int | Sequence[int] | None = None,
           mu: Any = None, problems: int | None = None, seed: int | None = None, *,
           policy: str | Sequence[str] | None = None, campaign: Path | Mapping[str, Any] | None = None,
           store: Path | None = None, minutes: float | None = None, threads: int | None = None,
           finishing: float | None = None, **fields: Any) -> Iterator[Finding]:
    """The findings of a campaign, in the order of signature: what `stiction search` of it leaves in its store.

    `campaign` is a campaign file, or a dictionary like one; what else is given of generator, contacts, mu, seed,
    policy ('*': all of the plane) and `fields`, other fields of such a file as audit_every, stands in its place.
    The search runs when the first finding is asked for, and ends after `problems`, rounded up to whole units, or so
    many minutes; one, if neither is given. Findings come after it: until then another problem can take the place of
    one, and how often a group was met is not known.

    It runs on all cores, or so many threads, without the interpreter's lock. `finishing`: the most processor time,
    in percent, that certifying and minimizing may take; 100 leaves no finding unfinished, and can take longer than
    the search. With `store` it goes on where that stopped. Ctrl-C is a KeyboardInterrupt after at most about a
    second; what was done until then stays in the store, if one is named.
    """
    text = _campaign(campaign, {"generators": generator, "contacts": contacts, "mu": mu, "seed": seed,
                                "policies": policy, **fields})
    if problems is None and minutes is None:
        minutes = 1.0
    for name, value, least in (("problems", problems, 1), ("threads", threads, 1), ("minutes", minutes, 0),
                               ("finishing", finishing, 0)):
        if value is None:
            continue
        if least == 1:
            integer(name, value)
        if not least <= real(name, value) < float("inf"):
            raise ValueError(f"search: {name}: found {value}, expected a number of at least {least}")
    if finishing is not None and finishing > 100:
        raise ValueError(f"search: finishing: found {finishing}, expected 0 to 100 percent")
    share = None if finishing is None else finishing / 100
    return _search(text, store, problems, minutes, threads or os.cpu_count() or 1, share)


def _search(campaign: str, store: Path | None, problems: int | None, minutes: float | None,
            threads: int, finishing: float | None) -> Iterator[Finding]:
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        file = path_text(store) if store is not None else os.path.join(folder, "search.store")
        _stiction.search(campaign, file, problems, minutes, threads, finishing)
        findings = Store(file).findings
    yield from findings
