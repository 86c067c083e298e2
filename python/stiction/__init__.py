# SPDX-License-Identifier: Apache-2.0
"""stiction: contact forces with friction by pivoting, from Python.

Names are those of the command line. Bad input, a place to write that is none among it, is a ValueError with the
program's one line; a file that cannot be opened, and a full disk, an OSError. Exact numbers are fractions.Fraction,
those of floating point float.
"""
from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from os import PathLike
from typing import Any, Sequence, Union

import numpy as np

from . import _stiction

__all__ = ["Answer", "Certificate", "Pivot", "Problem", "Replay", "certify", "check", "load", "replay", "solve"]

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


class Problem:
    """a = A f + b with contacts: rows are the normal of a contact, then its friction if it is static.

    A is rows x rows in 1/kg, b rows in m/s^2, mu one coefficient for each contact (0 where it has none) or one for
    all, kinds 'static', 'frictionless' or 'bilateral', by default all static. Arrays of doubles are read where they
    lie, and each double is the rational that it is; all else is taken exactly. A problem holds rationals.
    """

    def __init__(self, A: Any, b: Any, mu: Any, kinds: Sequence[str] | None = None, dimension: int = 2,
                 name: str = "problem") -> None:
        A, b = (x if isinstance(x, np.ndarray) else np.array(x, dtype=object) for x in (A, b))
        if A.ndim != 2 or b.ndim != 1:
            raise ValueError(f"Problem: found A with {A.ndim} and b with {b.ndim} dimensions, expected 2 and 1")
        if np.ndim(mu) == 0:
            contacts = len(kinds) if kinds is not None else len(b) // dimension
            mu = [mu] * contacts
        kinds = ["static"] * len(mu) if kinds is None else list(kinds)
        coefficients = [_text(x) for x in mu]
        if A.dtype == np.float64 and b.dtype == np.float64:
            self._problem = _stiction.Problem.from_doubles(A, b, coefficients, kinds, dimension, name)
        else:
            self._problem = _stiction.Problem.from_texts([[_text(x) for x in row] for row in A], [_text(x) for x in b],
                                                         coefficients, kinds, dimension, name)

    @property
    def name(self) -> str:
        """Of the problem file."""
        return self._problem.name

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._problem.dimension

    @property
    def A(self) -> np.ndarray:
        """At its nearest doubles: a view of the problem's memory, which cannot be written to."""
        return self._problem.A

    @property
    def b(self) -> np.ndarray:
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
        return json.loads(self.text)


def solve(problem: Problem, method: str = "complete", arithmetic: str = "", policy: str = "paper") -> Answer:
    """Solves a problem. `arithmetic`: by default that of the command line."""
    said = _stiction.solve(problem._problem, method, arithmetic, policy)
    return Answer(said["outcome"], said["method"], said["arithmetic"], _numbers(said.get("f") or ()),
                  _numbers(said.get("a") or ()), said.get("reason", ""), said.get("statistics", {}), said)


def replay(problem: Problem, policy: str = "paper", method: str = "baraff") -> Replay:
    """Runs a path method step by step, exactly where it is built so."""
    said = _stiction.replay(problem._problem, policy, method)
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
