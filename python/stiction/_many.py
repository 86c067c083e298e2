# SPDX-License-Identifier: Apache-2.0
"""Many problems of the same contacts, as arrays, on all cores."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _stiction
from ._given import Vector, doubles, integer, require_text, unmasked
from ._methods import chosen
from ._problem import Problem, compiled


@dataclass(frozen=True, repr=False, eq=False)
class Answers:
    """How a method ends on each of n problems. All arrays have n rows, in the order of the problems.

    `outcome` is text, as of an `Answer`. `f`, n x rows, has forces in N, `a` accelerations in m/s^2, NaN where a run
    has none. Of a loop the state after `start` drives recurs `period` drives later; of others both are 0. `statistics`
    has the method's counters by name, int64. `seconds` is the processor time that the library itself took, all threads
    together: what else passed is Python's.
    """

    outcome: NDArray[np.str_]
    f: NDArray[np.float64]
    a: NDArray[np.float64]
    start: NDArray[np.int64]
    period: NDArray[np.int64]
    statistics: dict[str, NDArray[np.int64]]
    seconds: float

    def __len__(self) -> int:
        return len(self.outcome)

    def __repr__(self) -> str:
        names, counts = np.unique(self.outcome, return_counts=True)
        ends = ", ".join(f"{count} {name}" for name, count in zip(names, counts)) or "none"
        return f"<stiction.Answers of {len(self)} problems, {self.f.shape[1]} rows: {ends}>"


def _numbers(name: str, values: Any, by: str) -> Vector:
    array = doubles(np.asarray(unmasked(values, name)))
    if array is None:
        raise ValueError(f"{by}: {name}: found numbers that are no doubles, expected doubles; Problem takes any")
    wrong = ~np.isfinite(array) if name != "mu" else ~(np.isfinite(array) & (array >= 0))
    if wrong.any():
        at = tuple(int(i) for i in np.argwhere(wrong)[0])
        place = name + "".join(f"[{i}]" for i in at)
        expected = "a finite number" if name != "mu" else "a finite number of at least 0"
        raise ValueError(f"{by}: {place}: found {array[at]}, expected {expected}")
    return array


def _stacked(array: Vector, name: str, shape: tuple[int, ...], count: int | None, by: str) -> Vector:
    """n of this shape; one stands for all."""
    if array.shape == shape:
        return np.broadcast_to(array, (1 if count is None else count, *shape))
    if array.shape[1:] == shape and (count is None or array.shape[0] == count):
        return array
    found, expected = (" x ".join(map(str, of)) or "a number" for of in (array.shape, shape))
    raise ValueError(f"{by}: {name}: found {found}, expected {expected}, or {'n' if count is None else count} of these")


def _run(by: str, A: Any, b: Any, mu: Any, kinds: Sequence[str] | None, dimension: int, method: str, arithmetic: str,
         policy: str, law: str, sides: int, numbers: dict[str, float], threads: int | None) -> Answers:
    require_text(method=method, arithmetic=arithmetic, policy=policy, law=law)
    A, b, mu = (_numbers(name, x, by) for name, x in (("A", A), ("b", b), ("mu", mu)))
    if A.ndim not in (2, 3) or b.ndim not in (1, 2) or mu.ndim > 2:
        raise ValueError(f"{by}: found A with {A.ndim}, b with {b.ndim} and mu with {mu.ndim} dimensions, expected "
                         "n x rows x rows, n x rows and n x contacts, or one that stands for all")
    rows = A.shape[-1]
    contacts = len(kinds) if kinds is not None else mu.shape[-1] if mu.ndim else rows // max(dimension, 1)
    counts = [x.shape[0] for x, of_many in ((A, 3), (b, 2), (mu, 2)) if x.ndim == of_many]
    count = counts[0] if counts else None
    A, b = _stacked(A, "A", (rows, rows), count, by), _stacked(b, "b", (rows,), count, by)
    mu = _stacked(np.broadcast_to(mu, (contacts,)) if mu.ndim == 0 else mu, "mu", (contacts,), count, by)
    one = (A[0], b[0], mu[0]) if len(A) else (np.zeros((rows, rows)), np.zeros(rows), np.zeros(contacts))
    like = Problem(*one, kinds, dimension)
    if "sliding" in like.kinds:
        raise ValueError(f"{by}: kinds: found sliding, expected contacts that do not slide; solve_all takes problems")
    rough = np.array([kind == "static" for kind in like.kinds], dtype=bool)
    cores = integer("threads", threads) if threads is not None else os.cpu_count() or 1
    if cores < 1:
        raise ValueError(f"{by}: threads: found {threads}, expected at least 1")
    said = _stiction.solve_many(compiled(like, by), A, b, np.where(rough, mu, 0.0), method, arithmetic, policy, law,
                                integer("sides", sides), numbers, by == "replay_many", min(cores, max(len(A), 1)))
    return Answers(np.array(said["outcomes"], dtype=str)[said["outcome"]], said["f"], said["a"], said["start"],
                   said["period"], said["statistics"], said["seconds"])


def solve_many(A: Any, b: Any, mu: Any, kinds: Sequence[str] | None = None, dimension: int = 2, method: str = "auto",
               arithmetic: str = "double", policy: str = "paper", *, law: str = "", sides: int = 8,
               max_drives: int | None = None, max_pivots: int | None = None, max_bits: int | None = None,
               threads: int | None = None) -> Answers:
    """Solves n problems of the same kinds of contacts: of each what `solve` says of `Problem(A[i], b[i], mu[i])`.

    A is n x rows x rows in 1/kg, b n x rows in m/s^2, mu n x contacts; one of A, one of b and one number or one list of
    mu stand for all n. Arrays of doubles are read where they lie. Over doubles, unless another arithmetic is asked for;
    'fast' takes least time. 'auto' takes up to twenty times as long: where doubles leave open whether some contacts can
    rest while others move, it decides by an exact linear program. On all cores, or so many threads,
    without the interpreter's lock; answers do not depend on how many. Ctrl-C is a KeyboardInterrupt. ValueError names
    the first problem that is refused.
    """
    return _run("solve_many", A, b, mu, kinds, dimension, method, arithmetic, policy, law, sides,
                chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits), threads)


def replay_many(A: Any, b: Any, mu: Any, kinds: Sequence[str] | None = None, dimension: int = 2, policy: str = "paper",
                method: str = "baraff", *, arithmetic: str = "", sides: int = 8, max_drives: int | None = None,
                max_pivots: int | None = None, max_bits: int | None = None, threads: int | None = None) -> Answers:
    """Runs a path method on n problems, by default the published algorithm, exactly: how `replay` ends on each.

    Arrays as of `solve_many`. Steps are not kept: `replay` tells those of one.
    """
    return _run("replay_many", A, b, mu, kinds, dimension, method, arithmetic, policy, "", sides,
                chosen(max_drives=max_drives, max_pivots=max_pivots, max_bits=max_bits), threads)
