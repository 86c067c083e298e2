# SPDX-License-Identifier: Apache-2.0
"""What is done with a problem: solved, replayed, certified."""
from __future__ import annotations

import html
import json
import math
import shlex
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _stiction
from ._given import Number, Vector, integer, real, require_text, shortened
from ._problem import Problem, compiled


def _number(value: Any) -> Number:
    return Fraction(value) if isinstance(value, str) else value


def _nearest(value: Any) -> float:
    if not isinstance(value, str):
        return float(value)
    try:
        return float(Fraction(value))
    except OverflowError:
        return -math.inf if value.startswith("-") else math.inf
    except ValueError:  # inf, nan
        return float(value)


def _array(values: Sequence[Any]) -> Vector:
    array: Vector = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


class _Forces:
    """Forces and accelerations of what is told as JSON."""

    json: dict[str, Any]

    def __getstate__(self) -> dict[str, Any]:  # arrays are made again
        return {name: value for name, value in self.__dict__.items() if name not in ("f", "a")}

    def _of(self, name: str) -> list[Any]:
        return self.json.get(name) or []

    def _nearest_doubles(self, name: str) -> Vector:
        bounds = self._bounds(name)
        return _array([_nearest(x) for x in self._of(name)]) if bounds is None else _array(bounds.mean(axis=1))

    def _exactly(self, name: str) -> tuple[Fraction, ...]:
        if self._bounds(name) is not None:
            raise ValueError(f"exact_{name}: found bounds, expected exact or floating-point arithmetic: {name}_bounds")
        return tuple(Fraction(x) for x in self._of(name))

    def _bounds(self, name: str) -> Vector | None:
        values = self._of(name)
        if not values or not isinstance(values[0], list):
            return None
        return _array([[_nearest(x) for x in pair] for pair in values])

    @cached_property
    def f(self) -> Vector:
        """Forces in N by row, at their nearest doubles, which cannot be written to; over enclosures midpoints."""
        return self._nearest_doubles("f")

    @cached_property
    def a(self) -> Vector:
        """Accelerations in m/s^2, likewise."""
        return self._nearest_doubles("a")

    @property
    def exact_f(self) -> tuple[Fraction, ...]:
        """Forces themselves: of floating-point arithmetic each number is the rational that it is."""
        return self._exactly("f")

    @property
    def exact_a(self) -> tuple[Fraction, ...]:
        """Accelerations, likewise."""
        return self._exactly("a")

    @property
    def f_bounds(self) -> Vector | None:
        """Over enclosures the least and the largest force of every row, rows x 2; otherwise None."""
        return self._bounds("f")

    @property
    def a_bounds(self) -> Vector | None:
        """Accelerations, likewise."""
        return self._bounds("a")


@dataclass(frozen=True, repr=False)
class Answer(_Forces):
    """What a method says of a problem, with forces and accelerations where it ended; without any they are empty."""

    outcome: str
    method: str
    arithmetic: str
    reason: str
    statistics: dict[str, int]
    json: dict[str, Any]  # all that `stiction solve --json` says of the answer itself

    def __repr__(self) -> str:
        why = f": {shortened(self.reason)}" if self.reason else ""
        return f"<stiction.Answer {self.outcome!r} by {self.method}, {self.arithmetic}, {len(self._of('f'))} rows{why}>"


@dataclass(frozen=True, repr=False)
class Pivot(_Forces):
    """A step of a run, and the forces and accelerations after it."""

    drive: int
    step: Number | None
    json: dict[str, Any]  # all that `stiction replay --json --step` says of it, the sets too

    def __repr__(self) -> str:
        return f"<stiction.Pivot of drive {self.drive}, step {shortened(str(self.step))}>"


@dataclass(frozen=True, repr=False)
class Replay:
    """A run of `problem`: of a loop, the state after `start` drives recurs `period` drives later, in space over rounded
    numbers; `json["over_intervals"]` has what is proved there, which may be that the run never leaves a box.

    A notebook shows it as a page in which to step through it, beside complete driving.
    """

    outcome: str
    start: int
    period: int
    pivots: list[Pivot]
    json: dict[str, Any]
    problem: Problem
    asked: dict[str, Any]  # policy, method, arithmetic, sides, budgets

    @property
    def before(self) -> Vector:
        """Forces in N by row before the first step: zero but for bilateral contacts."""
        return _array([_nearest(x) for x in self.json["initial"]["f"]])

    def page(self) -> str:
        """The page that `stiction replay --html` writes: HTML that needs nothing else, to step through the run."""
        words = ["stiction", "replay", f"{self.problem.name}.json"]
        usual = {"policy": "paper", "method": "baraff", "arithmetic": "", "sides": 8}
        asked = self.asked
        for name, value in [*((name, asked[name]) for name in usual if asked[name] != usual[name]),
                            *asked["numbers"].items()]:
            words += [f"--{name.replace('_', '-')}", str(value)]
        return _stiction.replay_page(compiled(self.problem, "page"), asked["policy"], asked["method"],
                                     asked["arithmetic"], asked["sides"], asked["numbers"],
                                     f"{shlex.join(words)} --html OUT")

    def _repr_html_(self) -> str:  # a notebook shows the player
        return (f'<iframe srcdoc="{html.escape(self.page())}" style="width: 100%; height: 45em; border: 0" '
                f'title="{html.escape(self.problem.name)}, step by step"></iframe>')

    def __repr__(self) -> str:
        loop = f", start {self.start}, period {self.period}" if self.period else ""
        return f"<stiction.Replay {self.outcome!r}{loop}, {len(self.pivots)} pivots>"


@dataclass(frozen=True, repr=False)
class Certificate:
    """A claim with an exact witness; `text` is the certificate file."""

    kind: str
    text: str

    def __repr__(self) -> str:
        named = len(self.policies()) if self.kind in ("cycle", "counterexample", "endless", "ray") else 0
        of = f" of {named:,} {'policy' if named == 1 else 'policies'}" if named else ""
        return f"<stiction.Certificate {self.kind!r}{of}, {len(self.text)} characters>"

    def policies(self) -> list[str]:
        """The policies of which it speaks, if it speaks of runs of the published algorithm."""
        witness = self.to_json()["witness"]
        if "policy" in witness:
            return [witness["policy"]]
        return [policy for run in witness.get("runs", []) for policy in run["policies"]]

    def to_json(self) -> dict[str, Any]:
        """The certificate as dictionaries and lists."""
        fields: dict[str, Any] = json.loads(self.text)
        return fields


@dataclass(frozen=True, repr=False)
class Decision:
    """What is known of a claim: `state` is 'proved', 'disproved' or 'not decided'.

    `certificate` is of the claim, of its negation, or, where the claim holds under some of the policies asked for, of
    those; None where there is none. `reason` says in words what is not in it: the run that ends otherwise, the budget
    that was spent. `policies` counts them: `asked`, `so`, `certified`, and of the others, `otherwise`, how they end.
    """

    claim: str
    state: str
    certificate: Certificate | None
    reason: str
    policies: dict[str, Any]

    def __repr__(self) -> str:
        kind = self.certificate.kind if self.certificate else self.claim
        proof = f", {kind}" if kind != self.claim else ""
        return f"<stiction.Decision {self.claim!r} {self.state}{proof}{f': {self.reason}' if self.reason else ''}>"


# ---- Solving, replaying, certifying ----

def chosen(**values: float | None) -> dict[str, float]:
    """Those of budgets and tolerances that are given: budgets are whole numbers."""
    return {name: integer(name, value) if name.startswith("max_") else real(name, value)
            for name, value in values.items() if value is not None}


def solve(problem: Problem, method: str = "auto", arithmetic: str = "", policy: str = "paper", *,
          law: str = "", sides: int = 8, residual: float = 0, seconds: float = 0,
          max_drives: int | None = None, max_pivots: int | None = None, max_bits: int | None = None,
          acceleration_tolerance: float | None = None, force_tolerance: float | None = None,
          pivot_tolerance: float | None = None, loop_grain: float | None = None) -> Answer:
    """Solves a problem. All that can be chosen is what `stiction solve --help` says, with its defaults.

    After `seconds`, if they are not 0, and after Ctrl-C, the run ends where its method next looks: with an answer
    that is undecided, or KeyboardInterrupt.
    """
    given = compiled(problem, "solve")
    require_text(method=method, arithmetic=arithmetic, policy=policy, law=law)
    said = _stiction.solve(given, method, arithmetic, policy, law, integer("sides", sides),
                           real("residual", residual), real("seconds", seconds),
                           chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits,
                                   acceleration_tolerance=acceleration_tolerance, force_tolerance=force_tolerance,
                                   pivot_tolerance=pivot_tolerance, loop_grain=loop_grain))
    return Answer(said["outcome"], said["method"], said["arithmetic"], said.get("reason", ""),
                  said.get("statistics", {}), said)


def solve_all(problems: Sequence[Problem], method: str = "auto", arithmetic: str = "", policy: str = "paper", *,
              law: str = "", sides: int = 8, max_drives: int | None = None, max_pivots: int | None = None,
              max_bits: int | None = None, confirm: bool = True,
              judge: Sequence[Problem] | None = None) -> dict[str, NDArray[Any]]:
    """How a method ends on each of many problems, in one call: columns with a number for each problem.

    `outcome`, `seconds` of processor time on numbers that are in memory, and the counters of the method by name, as
    `solve` has them in `statistics`; `decided_on` of filtered runs: double, double-double or exact. With `judge`, as many
    problems, `residual` is the largest error of forces that are called solved on these, over rationals, NaN of others.
    Without `confirm` a suspicion of doubles is told as it is. Forces are not kept: `solve` gives those of one. Ctrl-C as
    in `solve`.
    """
    require_text(method=method, arithmetic=arithmetic, policy=policy, law=law)
    if isinstance(problems, Problem):
        raise TypeError("solve_all: problems: found one stiction.Problem, expected a sequence of them; solve takes one")
    if judge is not None and len(judge) != len(problems):
        raise ValueError(f"solve_all: judge: found {len(judge)} problems, expected {len(problems)}")
    outcomes, seconds, counters, decided_on, residuals = _stiction.solve_all(
        [compiled(problem, "solve_all") for problem in problems], method, arithmetic, policy, law,
        integer("sides", sides), chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits), confirm,
        [compiled(problem, "solve_all") for problem in judge or ()])
    columns = {"outcome": np.array(outcomes, dtype=str), "seconds": np.array(seconds, dtype=np.float64),
               **{name: np.array(column, dtype=np.int64) for name, column in counters.items()}}
    if any(decided_on):
        columns["decided_on"] = np.array(decided_on, dtype=str)
    if judge is not None:
        columns["residual"] = np.array(residuals, dtype=np.float64)
    return columns


def replay(problem: Problem, policy: str = "paper", method: str = "baraff", *, arithmetic: str = "",
           sides: int = 8, max_drives: int | None = None, max_pivots: int | None = None,
           max_bits: int | None = None) -> Replay:
    """Runs a path method step by step; by default exactly where it is built so. Ctrl-C as in `solve`."""
    given = compiled(problem, "replay")
    require_text(policy=policy, method=method, arithmetic=arithmetic)
    numbers = chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits)
    said = _stiction.replay(given, policy, method, arithmetic, integer("sides", sides), numbers)
    pivots = [Pivot(p.get("drive", 0), _number(p.get("step")), p) for p in said["pivots"]]
    return Replay(said["outcome"], said["start"], said["period"], pivots, said, problem,
                  {"policy": policy, "method": method, "arithmetic": arithmetic, "sides": sides, "numbers": numbers})


def ends(problem: Problem, *, arithmetic: str = "", sides: int = 8, max_drives: int | None = None,
         max_pivots: int | None = None, max_bits: int | None = None) -> dict[str, dict[str, Any]]:
    """How the published algorithm ends under every policy, by its name: what `stiction replay --all-policies` says.

    In the plane all are run exactly; in space those that are built there, by default over doubles.
    """
    require_text(arithmetic=arithmetic)
    said: dict[str, dict[str, Any]] = _stiction.ends(
        compiled(problem, "ends"), arithmetic, integer("sides", sides),
        chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits))
    return said


def certify(problem: Problem, claim: str = "existence", policy: str = "paper", *, law: str = "",
            max_drives: int | None = None, max_pivots: int | None = None,
            max_bits: int | None = None) -> Certificate | None:
    """The certificate of `decide`: of a claim, of its negation, or of those of the policies under which it holds.

    None where there is none: the claim is not decided, or a run shows that it is false, which `decide` tells.
    """
    return decide(problem, claim, policy, law=law, max_drives=max_drives, max_pivots=max_pivots,
                  max_bits=max_bits).certificate


def decide(problem: Problem, claim: str = "existence", policy: str = "paper", *, law: str = "",
           max_drives: int | None = None, max_pivots: int | None = None,
           max_bits: int | None = None) -> Decision:
    """Whether a claim that `stiction certify --claim` knows is proved, disproved or not decided.

    It is not decided where a budget is spent, which are of runs of a method, or a sign cannot be told. Policy '*' is
    the whole planar grid, and the claim then is made of every policy. A law is chosen of the claim 'existence' in
    space: Coulomb's, unless it is 'baraff'.
    """
    given = compiled(problem, "certify")
    require_text(claim=claim, policy=policy, law=law)
    said = _stiction.certify(given, claim, policy, law,
                             chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits))
    text = said["certificate"]
    return Decision(claim, said["state"], None if text is None else Certificate(json.loads(text)["claim"], text),
                    said.get("reason", ""), said.get("policies", {}))


def check(problem: Problem, certificate: Certificate | str) -> bool:
    """True of a certificate, or its text, that is right and speaks of this problem; otherwise ValueError, why."""
    given = compiled(problem, "check")
    text = certificate.text if isinstance(certificate, Certificate) else certificate
    if not isinstance(text, str):
        raise TypeError(f"certificate: found {shortened(repr(text))}, expected a stiction.Certificate or its text; "
                        "certify gives None where it could show neither a claim nor its negation")
    accepted, _, reason = _stiction.check(given, text)
    if not accepted:
        raise ValueError(reason)
    return True
