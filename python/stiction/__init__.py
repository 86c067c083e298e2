# SPDX-License-Identifier: Apache-2.0
"""stiction: contact forces with friction by pivoting, from Python.

Names are those of the command line. Bad input, a place to write that is none among it, is a ValueError with the
program's one line; a file that cannot be opened, and a full disk, an OSError. Exact numbers are fractions.Fraction,
those of floating point float.
"""
from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from fractions import Fraction
from os import PathLike
from typing import Any, Iterator, Mapping, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _stiction

__all__ = ["Answer", "Certificate", "Finding", "Pivot", "Problem", "Replay", "Store", "certify", "check", "load",
           "replay", "search", "solve"]

Number = Union[Fraction, float]


def _number(value: Any) -> Number:
    return Fraction(value) if isinstance(value, str) else value


def _numbers(values: Sequence[Any]) -> tuple[Number, ...]:
    return tuple(_number(value) for value in values)


def _text(value: Any) -> str:
    """An exact number as stiction reads it: of an int, Fraction, float or text."""
    if isinstance(value, np.generic):
        value = value.item()
    try:
        return str(Fraction(value))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"Problem: found {value!r}, expected a finite number or a fraction as text") from None


def _list(value: Any) -> list[Any]:
    return [value] if isinstance(value, (str, int, float, Fraction, np.generic)) else list(value)


class Problem:
    """a = A f + b with contacts: rows are the normal of a contact, then its friction if it is static.

    A is rows x rows in 1/kg, b rows in m/s^2, mu one coefficient for each contact (0 where it has none) or one for
    all, kinds 'static', 'sliding', 'frictionless' or 'bilateral', by default all static. Of each contact that slides,
    slips has the direction: 1 or -1 in the plane, in space a unit vector of two exact numbers, as ('3/5', '4/5');
    of the others None. Arrays of doubles are read where they lie, and each double is the rational that it is; all
    else is taken exactly. A problem holds rationals.
    """

    def __init__(self, A: Any, b: Any, mu: Any, kinds: Sequence[str] | None = None, dimension: int = 2,
                 name: str = "problem", slips: Sequence[Any] | None = None) -> None:
        A, b = (x if isinstance(x, np.ndarray) else np.array(x, dtype=object) for x in (A, b))
        if A.ndim != 2 or b.ndim != 1:
            raise ValueError(f"Problem: found A with {A.ndim} and b with {b.ndim} dimensions, expected 2 and 1")
        if np.ndim(mu) == 0:
            count = len(kinds) if kinds is not None else len(b) // dimension
            mu = [mu] * count
        kinds = ["static"] * len(mu) if kinds is None else list(kinds)
        slips = [None] * len(kinds) if slips is None else list(slips)
        for of, found in (("mu", len(mu)), ("slips", len(slips))):
            if found != len(kinds):
                raise ValueError(f"Problem: {of}: found {found}, expected {len(kinds)}, one for each contact")
        contacts = [(kind, _text(x), [] if slip is None else [_text(y) for y in _list(slip)])
                    for kind, x, slip in zip(kinds, mu, slips)]
        if A.dtype == np.float64 and b.dtype == np.float64:
            self._problem = _stiction.Problem.from_doubles(A, b, contacts, dimension, name)
        else:
            self._problem = _stiction.Problem.from_texts([[_text(x) for x in row] for row in A], [_text(x) for x in b],
                                                         contacts, dimension, name)

    @property
    def name(self) -> str:
        """Of the problem file."""
        return self._problem.name

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._problem.dimension

    @property
    def A(self) -> NDArray[np.float64]:
        """At its nearest doubles: a view of the problem's memory, which cannot be written to."""
        return self._problem.A

    @property
    def b(self) -> NDArray[np.float64]:
        """Likewise."""
        return self._problem.b

    @property
    def exact_A(self) -> list[list[Fraction]]:
        """A itself; a copy."""
        return [[Fraction(x) for x in row] for row in self._problem.exact_A()]

    @property
    def exact_b(self) -> list[Fraction]:
        """b itself; a copy."""
        return [Fraction(x) for x in self._problem.exact_b()]

    @property
    def mu(self) -> list[Fraction]:
        """Of each contact, exactly."""
        return [Fraction(x) for x in self._problem.exact_mu()]

    @property
    def kinds(self) -> list[str]:
        """Of each contact."""
        return self._problem.kinds()

    @property
    def slips(self) -> list[tuple[Fraction, ...] | None]:
        """Of each contact that slides its direction, of one component in the plane and two in space."""
        return [tuple(Fraction(x) for x in slip) or None for slip in self._problem.exact_slips()]

    @property
    def digest(self) -> str:
        """Of all that is exact in it, as certificates name it."""
        return self._problem.digest()

    def save(self, path: str | PathLike[str]) -> None:
        """Writes a problem file, whole or not at all."""
        self._problem.save(str(path))


def load(path: str | PathLike[str]) -> Problem:
    """The problem of a problem file."""
    with open(path, "rb"):  # OSError where it cannot be opened
        pass
    problem = Problem.__new__(Problem)
    problem._problem = _stiction.Problem.read(str(path))
    return problem


def _parsed(text: str, source: str) -> Problem | None:
    """The problem of a problem file's text; None where there is none."""
    if not text:
        return None
    problem = Problem.__new__(Problem)
    problem._problem = _stiction.Problem.parse(text, source)
    return problem


@dataclass(frozen=True)
class Answer:
    """What a method says of a problem: forces f in N and accelerations a in m/s^2 where it ended."""

    outcome: str
    method: str
    arithmetic: str
    f: tuple[Number, ...]
    a: tuple[Number, ...]
    reason: str
    statistics: dict[str, int]
    json: dict[str, Any]  # all that `stiction solve --json` says of the answer itself


@dataclass(frozen=True)
class Pivot:
    """A step of a run, and the forces and accelerations after it."""

    drive: int
    step: Number | None
    f: tuple[Number, ...]
    a: tuple[Number, ...]
    json: dict[str, Any]  # all that `stiction replay --json --step` says of it, the sets too


@dataclass(frozen=True)
class Replay:
    """A run: of a loop, the state after `start` drives stands again `period` drives later."""

    outcome: str
    start: int
    period: int
    pivots: list[Pivot]
    json: dict[str, Any]


@dataclass(frozen=True)
class Certificate:
    """A claim with an exact witness; `text` is the certificate file."""

    kind: str
    text: str

    def to_json(self) -> dict[str, Any]:
        """The certificate as dictionaries and lists."""
        fields: dict[str, Any] = json.loads(self.text)
        return fields


def _given(**numbers: float | None) -> dict[str, float]:
    return {name: value for name, value in numbers.items() if value is not None}


def solve(problem: Problem, method: str = "complete", arithmetic: str = "", policy: str = "paper", *,
          law: str = "baraff", sides: int = 8, residual: float = 0, seconds: float = 0,
          max_drives: int | None = None, max_pivots: int | None = None, max_bits: int | None = None,
          acceleration_tolerance: float | None = None, force_tolerance: float | None = None,
          pivot_tolerance: float | None = None, loop_grain: float | None = None) -> Answer:
    """Solves a problem. All that can be chosen is what `stiction solve --help` says, with its defaults.

    But `method`, which is 'auto' there. After `seconds`, if they are not 0, and after Ctrl-C, the run ends where its
    method next looks: with an answer that is undecided, or KeyboardInterrupt.
    """
    numbers = _given(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits,
                     acceleration_tolerance=acceleration_tolerance, force_tolerance=force_tolerance,
                     pivot_tolerance=pivot_tolerance, loop_grain=loop_grain)
    said = _stiction.solve(problem._problem, method, arithmetic, policy, law, sides, residual, seconds, numbers)
    return Answer(said["outcome"], said["method"], said["arithmetic"], _numbers(said.get("f") or ()),
                  _numbers(said.get("a") or ()), said.get("reason", ""), said.get("statistics", {}), said)


def replay(problem: Problem, policy: str = "paper", method: str = "baraff", *, arithmetic: str = "",
           sides: int = 8, max_drives: int | None = None, max_pivots: int | None = None,
           max_bits: int | None = None) -> Replay:
    """Runs a path method step by step; by default exactly where it is built so. Ctrl-C as in `solve`."""
    numbers = _given(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits)
    said = _stiction.replay(problem._problem, policy, method, arithmetic, sides, numbers)
    pivots = [Pivot(p.get("drive", 0), _number(p.get("step")), _numbers(p.get("f", ())), _numbers(p.get("a", ())), p)
              for p in said["pivots"]]
    return Replay(said["outcome"], said["start"], said["period"], pivots, said)


def certify(problem: Problem, claim: str = "solution-exists", policy: str = "paper") -> Certificate | None:
    """A certificate of a claim that `stiction certify --claim` knows, or of its negation.

    None where nothing that was run shows either.
    """
    text = _stiction.certify(problem._problem, claim, policy)
    return None if text is None else Certificate(json.loads(text)["claim"], text)


def check(problem: Problem, certificate: Certificate | str) -> bool:
    """True of a certificate, or its text, that is right and speaks of this problem; otherwise ValueError, why."""
    text = certificate.text if isinstance(certificate, Certificate) else certificate
    accepted, _, reason = _stiction.check(problem._problem, text)
    if not accepted:
        raise ValueError(reason)
    return True


# ---- Campaigns and their stores ----

_TEXTS = frozenset(("generator", "policy", "method", "arithmetic", "inexact_outcome", "exact_outcome", "friction",
                    "or_more", "counted", "signature", "kind", "outcome", "state", "whole_grid", "every_policy_loops",
                    "words_exact"))
_YES_OR_NO_OF_FINDINGS = frozenset(("safe", "minimized_safe"))

Table = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Finding:
    """A group of problems that a campaign met `count` times, and the first of them, which stands for all.

    `problem` is that one as it was found: number `index` of unit `unit` of the campaign with `seed`. `outcome` is
    that of exact arithmetic, `inexact_outcome` that of doubles. What follows is there once it is `finished`:
    `minimized` is a smaller problem of the same group; `policies` counts how `problem` ends under all planar
    readings, if it has at most four contacts. `certificate` speaks of the minimized problem where there is one,
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
    facts: dict[str, Any]  # all that the store says of it besides


def _certificate(text: str) -> Certificate | None:
    return Certificate(json.loads(text)["claim"], text) if text else None


def _finding(row: Mapping[str, Any], seed: int) -> Finding:
    facts = json.loads(row["facts"]) if row["facts"] else {}
    problem, minimized = (_parsed(row[key], row["signature"]) for key in ("problem", "minimized"))
    assert problem is not None
    of = "minimized_" if minimized is not None else ""
    return Finding(
        row["signature"], row["kind"], row["count"], row["exact_outcome"], row["inexact_outcome"], row["generator"],
        row["contacts"], row["policy"], seed, row["unit"], row["index"], row["finished"], problem, minimized,
        _certificate(row[of + "certificate"]), _certificate(row[of + "existence"]),
        facts.get("found", {}).get("grid", {}), facts)


def _column(table: str, name: str, cells: Sequence[str]) -> NDArray[Any]:
    if name in _TEXTS or (table == "findings" and name in _YES_OR_NO_OF_FINDINGS):
        return np.array(cells, dtype=str)
    empty = [cell == "" for cell in cells]
    numbers = np.array([int(cell or 0) for cell in cells], dtype=np.int64)
    masked: NDArray[Any] = np.ma.masked_array(numbers, empty)  # type: ignore[no-untyped-call]
    return masked if any(empty) else numbers


class Store:
    """What a campaign has left in a file, as it is at this moment; nothing is written to it.

    A file that cannot be opened is an OSError, one that is no sound store a ValueError that names the row.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        with open(path, "rb"):  # OSError where it cannot be opened
            pass
        self._store = _stiction.Store(os.fspath(path))
        self._tables: dict[str, Table] = {}

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
    def tables(self) -> dict[str, Table]:
        """The tables of `stiction report` by name, as statistics, verdicts or strata; of each its columns by name.

        Numbers are int64, masked where a cell is empty; all else is text. Left out are the columns of `findings`
        that name files of a report's folder. `pandas.DataFrame(table)` takes one as it is.
        """
        if not self._tables:
            for name, (names, *rows) in self._store.tables().items():
                self._tables[name] = {column: _column(name, column, [row[i] for row in rows])
                                      for i, column in enumerate(names) if not column.endswith("_file")}
        return dict(self._tables)

    def statistics(self) -> Table:
        """A row per generator, contacts, policy, method and arithmetic: problems, outcomes, all counters."""
        return self.tables["statistics"]


def _campaign(campaign: str | PathLike[str] | Mapping[str, Any] | None, changes: Mapping[str, Any]) -> str:
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
            fields[key] = _list(fields[key])
    if "mu" in fields:
        fields["mu"] = [_text(x) for x in fields["mu"]]
    if "contacts" in fields:
        fields["contacts"] = [int(x) for x in fields["contacts"]]
    return json.dumps(fields)


def search(generator: str | Sequence[str] | None = None, contacts: int | Sequence[int] | None = None,
           mu: Any = None, problems: int | None = None, seed: int | None = None, *,
           policy: str | Sequence[str] | None = None, campaign: str | PathLike[str] | Mapping[str, Any] | None = None,
           store: str | PathLike[str] | None = None, minutes: float | None = None, threads: int | None = None,
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
        if value is not None and not least <= value < float("inf"):
            raise ValueError(f"search: {name}: found {value}, expected a number of at least {least}")
    if finishing is not None and finishing > 100:
        raise ValueError(f"search: finishing: found {finishing}, expected 0 to 100 percent")
    share = None if finishing is None else finishing / 100
    return _search(text, store, problems, minutes, threads or os.cpu_count() or 1, share)


def _search(campaign: str, store: str | PathLike[str] | None, problems: int | None, minutes: float | None,
            threads: int, finishing: float | None) -> Iterator[Finding]:
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        file = os.fspath(store) if store is not None else os.path.join(folder, "search.store")
        _stiction.search(campaign, file, problems, minutes, threads, finishing)
        findings = Store(file).findings
    yield from findings
